//! Fifth stage: tests which light samples are visible.
//!
//! A sample counts if the first surface along its ray is the light that it was sampled from, or if the ray reaches its lamp without
//! surface. There is no tolerance: no distance is compared with that of a surface of the light.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, add},
    interaction::emission_texture,
    media::transmittance,
    records::Shadow,
    work::Work,
};
use crate::{
    geometry::{Nearest, PrimitiveRef},
    math::{Lanes, M, Pick, U, V},
};

#[simd]
pub(super) fn shadow<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { shadows, radiance, .. } = batch;
    for at in shadows.registers(l) {
        let shadow = Shadow::read(l, &shadows.shadows, at.start);
        let media = if work.has_media() { shadows.media(l, at) } else { l.u(0) };
        let (seen, light) = arriving(l, work, at.live, &shadow, media);
        add(radiance, seen, shadow.slot, light);
    }
    batch.rays += shadows.len() as u64;
    shadows.clear();
}

/// The visible light samples in the lanes of `live`, and their radiance after the transmittance of `media`, in which they start,
/// and the textures of their lights.
#[inline(always)]
pub(super) fn arriving<L: Lanes>(l: L, work: &Work, live: M<L>, shadow: &Shadow<L>, media: U<L>) -> (M<L>, V<L>) {
    let scene = work.scene;
    let time = work.time(l, shadow.slot);
    let mut nearest = scene.shapes.closest(l, live, shadow.o, shadow.d, time);
    let seen = live & scene.lights.arrives(l, shadow.target, shadow.o, &mut nearest);
    let Nearest { t, primitive, element } = nearest;
    let mut light = shadow.radiance;
    if work.has_media() {
        light = light * transmittance(l, work, media, t);
    }
    if scene.lights.emitters.vary() {
        let emits = seen & scene.lights.emitters.emits(primitive);
        let primitive = emits.pick(primitive, l.u(0));
        let place = PrimitiveRef { primitive, element: emits.pick(element, l.u(0)), time };
        let point = scene.shapes.surface_point(l, &place, shadow.o + shadow.d * t);
        light = light * emission_texture(l, scene, emits, place, point);
    }
    (seen, light)
}
