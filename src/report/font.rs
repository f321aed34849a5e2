//! The font of labels.
use std::sync::Once;

use plotters::style::{FontStyle, register_font};

/// Makes the font known to plots. What cannot be drawn without it says so.
pub fn register() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let _ = register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}
