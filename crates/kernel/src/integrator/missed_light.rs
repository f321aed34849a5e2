//! Light samples whose rays miss their light by rounding.
//!
//! A direction is rounded to some 2⁻²⁵, so a ray that was sampled towards a light may pass beside it: as good as never if the light is large
//! in the view, and half of the time if it is 10⁻⁷ of its distance wide. Such a sample arrives if its ray meets nothing before the light. A
//! ray that something stops in front of the light ends there, so no sample arrives that the light itself would not let arrive.
use fearless_simd_macros::simd;

use super::{records::Shadow, work::Work};
use noisefall_base::math::{F, Lanes, M, Pick, U};
use noisefall_scene::geometry::{MISS, Nearest};

/// The rounding error of distances, relative to them.
const ROUNDING: f32 = 1.0 / (1 << 19) as f32;

/// Lanes of `live` whose rays pass their light, since they meet nothing before it, given the first surfaces on their way; and the light in
/// their place. A triangle or a face also counts as passed if the ray meets its neighbour, where it borders on it.
#[simd]
pub(super) fn passes_light<L: Lanes>(
    l: L,
    work: &Work,
    live: M<L>,
    shadow: &Shadow<L>,
    time: F<L>,
    nearest: &Nearest<L>,
) -> (M<L>, Nearest<L>) {
    let scene = work.scene;
    let lost = live & shadow.target.below(scene.lights.surface_count());
    if !lost.any() {
        return (lost, Nearest { ..*nearest });
    }
    let place = scene.lights.place(l, lost.pick(shadow.target, l.u(0)), time);
    let t = scene.shapes.pass_distance(l, &place, shadow.o, shadow.d);
    let beyond = nearest.t.ge(t * (1.0 + ROUNDING));
    let border = (nearest.t - t).abs().lt(t * ROUNDING) & same_object(l, work, nearest.primitive, place.primitive);
    let passes = lost & t.above(0.0) & (beyond | border);
    let light = Nearest {
        t: passes.pick(t, nearest.t),
        primitive: passes.pick(place.primitive, nearest.primitive),
        element: passes.pick(place.element, nearest.element),
    };
    (passes, light)
}

/// Lanes whose two primitives, of which the first may be [`MISS`], belong to the same object.
fn same_object<L: Lanes>(l: L, work: &Work, a: U<L>, b: U<L>) -> M<L> {
    let owner = |primitive: u32| work.scene.owners.get(primitive as usize).map_or(MISS, |owner| *owner);
    let owners = |primitives: U<L>| l.load(&primitives.to_array().map(|primitive| f32::from_bits(owner(primitive)))).bits();
    owners(a).equals(owners(b))
}
