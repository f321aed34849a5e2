//! Multiple importance sampling: the weight of emitter hits if lights are sampled as well.
use fearless_simd_macros::simd;

use super::{
    queues::PathQueues,
    records::{DELTA, Path, PreviousLobe, PreviousVertex, TRANSMITS},
    work::Work,
};
use noisefall_base::math::{F, Lanes, Pick, V};
use noisefall_scene::{
    geometry::PrimitiveRef,
    light::{Lobe, ReferencePoint},
};

/// The weight of emitter hits at `target` of the paths from index `start` of their queue on. `target` may be
/// [`noisefall_scene::geometry::MISS`].
///
/// The target is passed by value; otherwise it would be kept in memory even for scenes that do not need it.
#[inline(always)]
pub(super) fn weight_of_hit<L: Lanes>(
    l: L,
    work: &Work,
    queues: &PathQueues,
    start: usize,
    path: &Path<L>,
    target: PrimitiveRef<L>,
) -> F<L> {
    let previous = PreviousVertex::read(l, &queues.previous_vertices, start);
    let lobe = if work.weights_lights_by_lobe() {
        let PreviousLobe { wo, alpha } = PreviousLobe::read(l, &queues.previous_lobes, start);
        Some(Lobe { wo, alpha })
    } else {
        None
    };
    emitter_hit_weight(l, work, &previous, lobe, path.o, path.d, &target)
}

/// The weight of the emitter hits of paths from `o` in the direction `d` at `target`, whose primitive may be
/// [`noisefall_scene::geometry::MISS`].
#[simd]
fn emitter_hit_weight<L: Lanes>(
    l: L,
    work: &Work,
    previous: &PreviousVertex<L>,
    lobe: Option<Lobe<L>>,
    o: V<L>,
    d: V<L>,
    target: &PrimitiveRef<L>,
) -> F<L> {
    let delta = !(previous.flags & DELTA).is(0);
    let estimator = work.settings.estimator;
    let of_light = if estimator.compares() {
        let at = ReferencePoint { p: o, n: previous.n, transmits: !(previous.flags & TRANSMITS).is(0), lobe };
        work.scene.lights.pdf(l, &work.scene.shapes, &at, d, target)
    } else {
        l.f(0.0)
    };
    delta.pick(l.f(1.0), estimator.hit_weight(l, previous.pdf, of_light))
}
