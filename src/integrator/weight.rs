//! Multiple importance sampling: the weight of emitter hits if lights are sampled as well.
use fearless_simd_macros::simd;

use super::{
    records::{DELTA, PreviousVertex, TRANSMITS},
    work::Work,
};
use crate::{
    geometry::PrimitiveRef,
    light::{Lobe, ReferencePoint},
    math::{F, Lanes, Pick, V},
    scene::Estimator,
};

/// The power heuristic with exponent 2 (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, equation 9.14):
/// the weight of a sample with pdf `pdf`, whose pdf by another strategy is `other`.
#[inline(always)]
pub(super) fn power_heuristic<L: Lanes>(pdf: F<L>, other: F<L>) -> F<L> {
    let ratio = other / pdf;
    1.0 / (1.0 + ratio * ratio)
}

/// The weight of the emitter hits of paths from `o` in the direction `d` at `target`, whose primitive may be
/// [`crate::geometry::MISS`].
#[simd]
pub(super) fn emitter_hit_weight<L: Lanes>(
    l: L,
    work: &Work,
    previous: &PreviousVertex<L>,
    lobe: Option<Lobe<L>>,
    o: V<L>,
    d: V<L>,
    target: &PrimitiveRef<L>,
) -> F<L> {
    let delta = !(previous.flags & DELTA).is(0);
    let sampled_too = match work.settings.estimator {
        Estimator::Path => return l.f(1.0),
        Estimator::Light => l.f(0.0),
        Estimator::Mis => {
            let at = ReferencePoint { p: o, n: previous.n, transmits: !(previous.flags & TRANSMITS).is(0), lobe };
            power_heuristic(previous.pdf, work.scene.lights.pdf(l, &work.scene.shapes, &at, d, target))
        }
    };
    delta.pick(l.f(1.0), sampled_too)
}
