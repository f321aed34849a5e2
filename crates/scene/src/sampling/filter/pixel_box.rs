//! The mean over the square of the pixel.
use super::Placing;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters},
    math::{F, Lanes},
};

/// The mean over the square of the pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Box;

impl Kind for Box {
    const KIND: Parameter = Parameter::new("box", "The mean over the square of the pixel.");

    fn chosen(&mut self, _: &mut dyn Parameters) {}
}

impl Declare for Box {
    fn parameters(&mut self, _: &mut dyn Parameters) {}
}

impl Placing for Box {
    #[inline(always)]
    fn place<L: Lanes>(self, _: L, u: F<L>) -> F<L> {
        u
    }

    fn density(self, x: f32) -> f32 {
        if (-0.5..0.5).contains(&x) { 1.0 } else { 0.0 }
    }

    fn reach(self) -> f32 {
        0.5
    }

    #[cfg(test)]
    fn distribution(self, x: f64) -> f64 {
        (x + 0.5).clamp(0.0, 1.0)
    }
}
