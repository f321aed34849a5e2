//! Widgets, layout and colours that panels, dialogs and instruments share.
pub mod arithmetic;
pub mod colour_edit;
pub mod committed_text;
pub mod counted;
pub mod decimals;
pub mod explained;
pub mod given_up;
pub mod hex;
pub mod kinds;
pub mod number;
pub mod palette;
pub mod path_field;
pub mod quotation;
pub mod refusal;
pub mod split;
pub mod style;
pub mod typed_number;
