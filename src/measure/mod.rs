//! Error metrics between pictures, exact solutions that pictures are held against, and what samples say of the means they come from.
mod blocks;
mod error;
pub mod exact;
mod means;
mod moments;

pub use self::{
    blocks::Deviations,
    error::{Comparison, REL_MSE_FLOOR, compare},
    means::{Mean, Measure, Picture, picture},
    moments::{Moments, samples},
};
