//! Warps of the unit square to directions, with their densities.
//!
//! Directions are in the local frame, z along the normal; densities are per solid angle.
use std::f32::consts::{FRAC_1_PI, TAU};

use serde::{Deserialize, Serialize};

use crate::math::{F, Lanes, V, trig::sin_cos_turns};

/// How the next direction is drawn over the hemisphere at a diffuse vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Directions {
    /// All directions alike: p(ω) = 1/2π.
    Uniform,
    /// In proportion to the cosine: p(ω) = cos θ/π.
    Cosine,
    /// In proportion to bsdf times cosine, which at a diffuse surface is the cosine.
    #[default]
    Bsdf,
}

impl Directions {
    pub const ALL: [Directions; 3] = [Directions::Uniform, Directions::Cosine, Directions::Bsdf];

    /// What the scene file and the command line call it.
    pub fn name(self) -> &'static str {
        match self {
            Directions::Uniform => "uniform",
            Directions::Cosine => "cosine",
            Directions::Bsdf => "bsdf",
        }
    }

    /// A unit direction with z > 0.
    #[inline(always)]
    pub fn sample<L: Lanes>(self, u: (F<L>, F<L>)) -> V<L> {
        match self {
            Directions::Uniform => uniform_hemisphere(u),
            Directions::Cosine | Directions::Bsdf => cosine_hemisphere(u),
        }
    }

    /// Density of a direction at cosine `cos > 0` to the normal, per solid angle.
    #[inline(always)]
    pub fn pdf<L: Lanes>(self, cos: F<L>) -> F<L> {
        match self {
            Directions::Uniform => cos.splat(1.0 / TAU),
            Directions::Cosine | Directions::Bsdf => cos * FRAC_1_PI,
        }
    }

    /// cos θ / (π p): the weight of a sampled direction at a surface of albedo 1.
    #[inline(always)]
    pub fn lambertian_weight<L: Lanes>(self, cos: F<L>) -> F<L> {
        match self {
            Directions::Uniform => cos * 2.0,
            Directions::Cosine | Directions::Bsdf => cos.splat(1.0),
        }
    }
}

/// Uniform over the hemisphere: the height z is uniform (Archimedes).
#[inline(always)]
fn uniform_hemisphere<L: Lanes>((u, v): (F<L>, F<L>)) -> V<L> {
    let (sin, cos) = sin_cos_turns(v);
    let r = ((1.0 - u) * (1.0 + u)).sqrt();
    V { x: r * cos, y: r * sin, z: u }
}

/// Uniform over the disk, lifted to the hemisphere (Malley): the density is cos θ/π.
#[inline(always)]
pub fn cosine_hemisphere<L: Lanes>((u, v): (F<L>, F<L>)) -> V<L> {
    let (sin, cos) = sin_cos_turns(v);
    let r = u.sqrt();
    V { x: r * cos, y: r * sin, z: (1.0 - u).sqrt() }
}
