//! The data that reuse of outliers stores. [`super::outlier_reuse`] does the path reuse.
mod buffers;
mod replays;
mod thresholds;

pub use self::{
    buffers::{Outlier, OutlierBuffers},
    replays::Replays,
    thresholds::{Thresholds, brightness},
};
