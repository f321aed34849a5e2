//! The part of next-event estimation that does not depend on the BSDF.
use fearless_simd_macros::simd;

use super::Stream;
use super::work::Work;
use noisefall_base::math::{F, Lanes, U};
use noisefall_scene::{
    light::{LightCoordinates, LightSample, ReferencePoint},
    sampling::{Dimension, warp::opposite},
};

/// [`sample_light`] as a call. It is compiled once per SIMD level, and not once more for each shading stage; the most frequent
/// stage is faster without the call.
#[simd]
pub(super) fn call_sample_light<L: Lanes>(
    l: L,
    work: &Work,
    at: &ReferencePoint<L>,
    stream: &Stream<L>,
    direction: (F<L>, F<L>),
    slot: U<L>,
    reflection: u32,
) -> LightSample<L> {
    sample_light(l, work, at, stream, direction, slot, reflection)
}

/// Samples a light at the `reflection`-th reflection of the paths in some slots, and a direction towards it. `direction` selects the next
/// direction of the path.
///
/// A sky of one radiance is sampled like a diffuse surface, opposite to the next direction of the path. So the two cannot be near each other,
/// and their sum is less noisy than that of independent ones.
#[inline(always)]
pub(super) fn sample_light<L: Lanes>(
    l: L,
    work: &Work,
    at: &ReferencePoint<L>,
    stream: &Stream<L>,
    direction: (F<L>, F<L>),
    slot: U<L>,
    reflection: u32,
) -> LightSample<L> {
    let lights = &work.scene.lights;
    let unused = l.f(0.0);
    let has_place = !lights.have_even_sky() || lights.are_several();
    let place = if has_place { stream.two(Dimension::light(reflection)) } else { (unused, unused) };
    let coordinates = LightCoordinates {
        choice: if lights.are_several() { stream.one(Dimension::light_choice(reflection)) } else { unused },
        cell: if lights.have_cells() { stream.two(Dimension::cell(reflection)) } else { (unused, unused) },
        place,
        sky: if lights.have_even_sky() { opposite(direction) } else { place },
    };
    if work.settings.estimator.samples_lights() {
        lights.sample(l, &work.scene.shapes, at, work.time(l, slot), &coordinates)
    } else {
        lights.sample_punctual(l, *at, coordinates)
    }
}
