//! Stage after shading: which light samples are seen.
//!
//! A sample counts if the first surface along its ray is the very light it was drawn from: no distance is compared, so no
//! tolerance is needed.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Inside, Shadow, add},
    media::transmittance,
    surface::emission_texture,
    work::Work,
};
use crate::{
    geometry::{Nearest, Place},
    math::{Lanes, M, Pick, U, V},
};

#[simd]
pub(super) fn shadow<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { shadows, shadow_media, radiance, .. } = batch;
    for start in (0..shadows.len()).step_by(L::N) {
        let live = l.first(shadows.len() - start);
        let shadow = Shadow::read(l, shadows, start);
        let mut media = l.u(0);
        if work.has_media() {
            media = live.pick(Inside::read(l, shadow_media, start).media, l.u(0));
        }
        let (seen, light) = arriving(l, work, live, &shadow, media);
        add(radiance, seen, shadow.slot, light);
    }
    batch.rays += shadows.len() as u64;
    shadows.clear();
    shadow_media.clear();
}

/// The light samples in the lanes of `live` that are seen, and what of their radiance arrives through the `media` they set out in
/// and from the textures of their lights.
#[inline(always)]
pub(super) fn arriving<L: Lanes>(l: L, work: &Work, live: M<L>, shadow: &Shadow<L>, media: U<L>) -> (M<L>, V<L>) {
    let scene = work.scene;
    let time = work.time(l, shadow.slot);
    let Nearest { t, primitive, element } = scene.shapes.closest(l, live, shadow.o, shadow.d, time);
    let seen = live & scene.lights.light_at(l, primitive, element).equals(shadow.target);
    let mut light = shadow.radiance;
    if work.has_media() {
        light = light * transmittance(l, work, media, t);
    }
    if scene.lights.emitters.vary() {
        let emits = seen & scene.lights.emitters.emits(primitive);
        let primitive = emits.pick(primitive, l.u(0));
        let place = Place { primitive, element: emits.pick(element, l.u(0)), time };
        let point = scene.shapes.surface_point(l, &place, shadow.o + shadow.d * t);
        light = light * emission_texture(l, scene, emits, &place, &point);
    }
    (seen, light)
}
