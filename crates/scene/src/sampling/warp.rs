//! Warps of the unit square to directions, with their pdfs.
//!
//! Directions are in the local frame with z along the normal; pdfs are per solid angle.
use std::f32::consts::{FRAC_1_PI, TAU};

use serde::{Deserialize, Serialize};

use noisefall_base::math::{F, Lanes, Pick, V, trig::sin_cos_eighth};

noisefall_base::declare::words! {
    /// How the next direction is sampled over the hemisphere at a diffuse vertex.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Directions {
        Uniform: "uniform", "Uniform", "p(ω_i) = 1 / 2π: uniform over the hemisphere.";
        Cosine: "cosine", "Cosine", "p(ω_i) = cos θ / π: cancels the cosine of the equation, so there is less noise.";
        #[default]
        Bsdf: "bsdf", "BSDF", "p(ω_i) in proportion to f cos θ, which at a diffuse surface is the cosine.";
    }
}

impl Directions {
    /// A unit direction with z > 0.
    #[inline(always)]
    pub fn sample<L: Lanes>(self, u: (F<L>, F<L>)) -> V<L> {
        match self {
            Directions::Uniform => cap(u.0.splat(1.0), u),
            Directions::Cosine | Directions::Bsdf => cosine_hemisphere(u),
        }
    }

    /// Pdf per solid angle of a direction with the cosine `cos > 0` to the normal.
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

/// The point half of the unit square away in both coordinates, around its edges. By [`cosine_hemisphere`] the two are on opposite sides of
/// the normal, and the nearer one is to it the farther is the other.
#[inline(always)]
pub fn opposite<L: Lanes>((u, v): (F<L>, F<L>)) -> (F<L>, F<L>) {
    let shifted = |x: F<L>| x.lt(x.splat(0.5)).pick(x + 0.5, x - 0.5);
    (shifted(u), shifted(v))
}

/// Uniform over the unit disk: x, y and the squared radius.
///
/// Maps squares around the centre to circles, so that neighbours stay neighbours and strata stay compact (P. Shirley and K. Chiu,
/// "A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3), 1997). No sampler returns a coordinate of
/// exactly ½, so there is no division by zero at the centre.
#[inline(always)]
pub fn disk<L: Lanes>((u, v): (F<L>, F<L>)) -> (F<L>, F<L>, F<L>) {
    let (a, b) = (u * 2.0 - 1.0, v * 2.0 - 1.0);
    let wide = b.abs().lt(a.abs());
    let r = wide.pick(a, b);
    let (sin, cos) = sin_cos_eighth(wide.pick(b, a) / r);
    (r * wide.pick(cos, sin), r * wide.pick(sin, cos), r * r)
}

/// Uniform over the triangle u, v ≥ 0, u + v ≤ 1, by a map that keeps neighbours together (E. Heitz, "A Low-Distortion Map Between
/// Triangle and Square", 2019).
#[inline(always)]
pub fn triangle<L: Lanes>((a, b): (F<L>, F<L>)) -> (F<L>, F<L>) {
    let low = a.lt(b);
    let (s, t) = (a * 0.5, b * 0.5);
    (low.pick(s, a - t), low.pick(b - s, t))
}

/// Uniform over the spherical cap around z with z ≥ 1 − `height`: 1 is the hemisphere, 2 the sphere. By Archimedes' theorem z is
/// uniform.
#[inline(always)]
pub fn cap<L: Lanes>(height: F<L>, u: (F<L>, F<L>)) -> V<L> {
    let (x, y, r2) = disk(u);
    let below = r2 * height;
    // With r² = height fraction, sin θ = √(below (2 − below)), and the disk already points in the right direction.
    let stretch = (height * (2.0 - below)).sqrt();
    V { x: x * stretch, y: y * stretch, z: 1.0 - below }
}

/// Uniform over the disk, projected up to the hemisphere (Malley's method): the pdf is cos θ/π.
#[inline(always)]
pub fn cosine_hemisphere<L: Lanes>(u: (F<L>, F<L>)) -> V<L> {
    let (x, y, r2) = disk(u);
    V { x, y, z: (1.0 - r2).sqrt() }
}
