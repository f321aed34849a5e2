//! The part of next-event estimation that does not depend on the BSDF.
use fearless_simd_macros::simd;

use super::work::Work;
use crate::{
    light::{LightCoordinates, LightSample, ReferencePoint},
    math::{Lanes, U},
    sampling::{Dimension, Stream},
};

/// [`sample_light`] as a call. It is compiled once per SIMD level, and not once more for each shading stage; the most frequent
/// stage is faster without the call.
#[simd]
pub(super) fn call_sample_light<L: Lanes>(
    l: L,
    work: &Work,
    at: &ReferencePoint<L>,
    stream: &Stream<L>,
    slot: U<L>,
    reflection: u32,
) -> LightSample<L> {
    sample_light(l, work, at, stream, slot, reflection)
}

/// Samples a light at the `reflection`-th reflection of the paths in some slots, and a direction towards it.
#[inline(always)]
pub(super) fn sample_light<L: Lanes>(
    l: L,
    work: &Work,
    at: &ReferencePoint<L>,
    stream: &Stream<L>,
    slot: U<L>,
    reflection: u32,
) -> LightSample<L> {
    let lights = &work.scene.lights;
    let unused = l.f(0.0);
    let coordinates = LightCoordinates {
        choice: if lights.are_several() { stream.one(Dimension::light_choice(reflection)) } else { unused },
        cell: if lights.have_cells() { stream.two(Dimension::cell(reflection)) } else { (unused, unused) },
        place: stream.two(Dimension::light(reflection)),
    };
    if work.settings.estimator.samples_lights() {
        lights.sample(l, &work.scene.shapes, at, work.time(l, slot), &coordinates)
    } else {
        lights.sample_lamps(l, *at, coordinates)
    }
}
