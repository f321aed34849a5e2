//! What sharing of bright samples stores: [`super::bright`] does it.
mod found;
mod replays;
mod thresholds;

pub use self::{
    found::{BrightSample, Found},
    replays::Replays,
    thresholds::{Thresholds, brightness},
};
