//! The data that sharing of bright samples stores. [`super::bright`] does the sharing.
mod found;
mod replays;
mod thresholds;

pub use self::{
    found::{BrightBuffers, BrightSample},
    replays::Replays,
    thresholds::{Thresholds, brightness},
};
