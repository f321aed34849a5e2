//! What every kind of reflection can do, in lanes.
use serde::Serialize;

use crate::math::{F, Lanes, M, One, Pick, V};

/// A bsdf with its parameters at some surface points, one point a lane.
///
/// Directions are unit, point away from the surface and are in the local frame, z along the shading normal on the side of the
/// viewer: `wo.z` > 0; `wi.z` < 0 is transmission. Densities are per solid angle.
pub trait Bsdf<L: Lanes>: Copy {
    /// f(ω_o, ω_i) |cos θ_i| of the lobes that are not delta, and the density with which [`Bsdf::sample`] draws `wi` from them,
    /// the probability of choosing them included.
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>);

    /// Draws the next direction from the point `u` of the unit square; `lobe` in (0, 1) chooses between lobes.
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L>;
}

/// The lobe that a direction was sampled from, for a reader.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChosenLobe {
    pub name: &'static str,
    /// Probability of choosing it.
    pub probability: f32,
}

/// Tells which lobe a direction comes from. The renderer has no use for that, so one lane is enough.
pub trait Lobes: Bsdf<One> {
    /// The lobe that [`Bsdf::sample`] draws from, given the same.
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe;
}

impl ChosenLobe {
    pub(super) fn only(name: &'static str) -> ChosenLobe {
        ChosenLobe { name, probability: 1.0 }
    }

    /// The first lobe where `lobe` is below its probability, else the second.
    pub(super) fn of_two(names: [&'static str; 2], probability: f32, lobe: F<One>) -> ChosenLobe {
        if lobe.0 < probability {
            ChosenLobe { name: names[0], probability }
        } else {
            ChosenLobe { name: names[1], probability: 1.0 - probability }
        }
    }
}

/// A next direction at a surface.
pub struct BsdfSample<L: Lanes> {
    pub wi: V<L>,
    /// f(ω_o, ω_i) |cos θ_i| / p(ω_i); for a delta lobe its reflectance over the probability of choosing it. Zero where no
    /// direction exists.
    pub weight: V<L>,
    /// Density of `wi` as [`Bsdf::eval`] gives it; of no meaning where `delta`.
    pub pdf: F<L>,
    /// The direction comes from a delta lobe: no other way of sampling can find it.
    pub delta: M<L>,
}

impl<L: Lanes> BsdfSample<L> {
    /// A direction of lobes that are not delta, from what [`Bsdf::eval`] says of it.
    #[inline(always)]
    pub(super) fn of(wi: V<L>, f: V<L>, pdf: F<L>) -> Self {
        let exists = pdf.above(0.0);
        let scale = exists.pick(1.0 / pdf, pdf.splat(0.0));
        BsdfSample { wi, weight: f * scale, pdf, delta: pdf.below(0.0) }
    }
}
