//! Error metrics between pictures, and exact solutions that pictures are held against.
mod error;
pub mod exact;

pub use error::{Comparison, REL_MSE_FLOOR, compare};
