//! The data of outlier reuse: see [`super::outlier_reuse`].
mod buffers;
mod replays;
mod thresholds;

pub use self::{
    buffers::{Outlier, OutlierBuffers},
    replays::Replays,
    thresholds::{Thresholds, brightness},
};
