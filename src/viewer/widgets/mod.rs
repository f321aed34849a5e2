//! Widgets, layout and colours that panels, dialogs and instruments share.
pub mod kinds;
pub mod number;
pub mod palette;
pub mod path_field;
pub mod style;
