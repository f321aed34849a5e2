//! Numbers, vectors and frames in lanes, and colour: mathematics without light transport.
pub mod colour;
pub mod erf;
pub mod exp;
pub mod frame;
pub mod lanes;
pub mod level;
pub mod number;
mod one;
pub mod round;
pub mod simd;
pub mod temperature;
#[cfg(test)]
mod tests;
pub mod trig;
pub mod vector;

pub use self::level::{in_few_lanes, in_lanes};
pub use self::{
    frame::Frame,
    lanes::{F, Lanes, M, MAX_LANES, One, U},
    level::SimdLevel,
    number::Pick,
    vector::V,
};
