//! The interface of all BSDFs, in lanes.
use serde::Serialize;

use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// A BSDF with its parameters at surface points, one point per lane.
///
/// Directions are unit vectors that point away from the surface, in the local frame with z along the shading normal on the side
/// of the viewer: `wo.z` > 0; `wi.z` < 0 is transmission. Pdfs are per solid angle.
pub trait Bsdf<L: Lanes>: Copy {
    /// f(ω_o, ω_i) |cos θ_i| of the lobes that are not delta, and the pdf with which [`Bsdf::sample`] samples `wi` from them,
    /// including the probability of choosing them. By default all lobes are delta.
    #[inline(always)]
    fn eval(&self, wo: V<L>, _wi: V<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        (V { x: zero, y: zero, z: zero }, zero)
    }

    /// Samples the next direction with the point `u` of the unit square; `lobe` in (0, 1) chooses between lobes.
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L>;
}

/// The lobe that a direction was sampled from, for display.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChosenLobe {
    /// Its name in the path inspector.
    pub name: &'static str,
    /// Probability of choosing it.
    pub probability: f32,
}

/// Reports the lobe of a direction. The renderer does not need it, so one lane is enough.
pub trait Lobes: Bsdf<One> {
    /// The lobe that [`Bsdf::sample`] uses for the same arguments.
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe;
}

impl ChosenLobe {
    pub(super) fn only(name: &'static str) -> ChosenLobe {
        ChosenLobe { name, probability: 1.0 }
    }

    /// The first lobe if `lobe` is below its probability, else the second.
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
    /// The sampled direction ω_i.
    pub wi: V<L>,
    /// f(ω_o, ω_i) |cos θ_i| / p(ω_i); for a delta lobe, its reflectance over the probability of choosing it. Zero if there is no
    /// direction.
    pub weight: V<L>,
    /// Pdf of `wi` as returned by [`Bsdf::eval`]; meaningless if `delta`.
    pub pdf: F<L>,
    /// Whether the direction comes from a delta lobe, which no other sampling strategy can find.
    pub delta: M<L>,
}

impl<L: Lanes> BsdfSample<L> {
    /// Builds a sample of lobes that are not delta, from the result of [`Bsdf::eval`].
    #[inline(always)]
    pub(super) fn of(wi: V<L>, f: V<L>, pdf: F<L>) -> Self {
        let exists = pdf.above(0.0);
        let scale = exists.pick(1.0 / pdf, pdf.splat(0.0));
        BsdfSample { wi, weight: f * scale, pdf, delta: pdf.below(0.0) }
    }
}
