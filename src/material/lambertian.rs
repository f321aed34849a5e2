//! The ideal diffuse surface: f = ρ/π in all directions of the hemisphere.
use crate::{
    math::{F, Lanes, V},
    sampling::Directions,
};

/// A next direction at a surface.
pub struct BsdfSample<L: Lanes> {
    /// Unit, in the local frame of the surface.
    pub wi: V<L>,
    /// f(ω_o, ω_i) cos θ_i / p(ω_i).
    pub weight: V<L>,
}

/// Draws the next direction. For cosine directions the density cancels f cos θ and the weight is the albedo itself.
#[inline(always)]
pub fn sample<L: Lanes>(albedo: V<L>, directions: Directions, u: (F<L>, F<L>)) -> BsdfSample<L> {
    let wi = directions.sample(u);
    let weight = albedo * directions.lambertian_weight(wi.z);
    BsdfSample { wi, weight }
}
