//! The font of labels.
use std::sync::Once;

use plotters::style::{FontStyle, register_font};

/// Registers the font for plots. Drawing fails with an error if this does not succeed.
pub fn register() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let _ = register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}
