//! Materials: how a surface reflects.
mod bsdf;
pub mod fresnel;
pub mod ggx;
mod lambertian;

pub use self::{
    bsdf::{Bsdf, BsdfSample},
    lambertian::Lambertian,
};
use crate::math::{F, Lanes, M, U, V};

/// What a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Reflectances in [0, 1] of red, green and blue. Zero is black: paths end there.
    Lambertian { albedo: [f32; 3] },
}

/// How much a metal reflects, channel by channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance {
    /// The same at every angle.
    Constant([f32; 3]),
    /// Schlick's approximation from the reflectance at normal incidence.
    Schlick([f32; 3]),
    /// Fresnel's equations with the complex index η + ik relative to the outside.
    Index { eta: [f32; 3], k: [f32; 3] },
}

#[derive(Default)]
pub struct Materials;

pub struct Local<L: Lanes> {
    pub material: U<L>,
    pub colour: V<L>,
    pub alpha: F<L>,
    pub front: M<L>,
}
