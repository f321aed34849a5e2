//! The data that sharing of bright samples stores. [`super::bright`] does the sharing.
mod buffers;
mod replays;
mod thresholds;

pub use self::{
    buffers::{BrightBuffers, BrightSample},
    replays::Replays,
    thresholds::{Thresholds, brightness},
};
