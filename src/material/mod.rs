//! Materials: how a surface reflects.
mod bsdf;
mod lambertian;
use crate::math::{F, Lanes, M, U, V};
pub use bsdf::{Bsdf, BsdfSample};
pub use lambertian::Lambertian;

/// What a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Reflectances in [0, 1] of red, green and blue. Zero is black: paths end there.
    Lambertian { albedo: [f32; 3] },
}
#[derive(Default)]
pub struct Materials;
pub struct Local<L: Lanes> {
    pub material: U<L>,
    pub colour: V<L>,
    pub alpha: F<L>,
    pub front: M<L>,
}
