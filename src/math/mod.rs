//! Numbers, vectors and frames in lanes, and colour: mathematics without light transport.
pub mod colour;
pub mod exp;
pub mod frame;
pub mod lanes;
pub mod level;
pub mod number;
mod one;
pub mod round;
#[cfg(test)]
mod tests;
pub mod trig;
pub mod vector;

pub use self::{
    frame::Frame,
    lanes::{Lanes, MAX_LANES, One},
    level::SimdLevel,
    number::{F, M, Pick, U},
    vector::V,
};
