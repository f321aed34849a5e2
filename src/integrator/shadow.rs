//! Stage after shading: which light samples are seen.
//!
//! A sample counts if the first surface along its ray is the very light it was drawn from: no distance is compared, so no
//! tolerance is needed.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Inside, Shadow, Work, add},
    media::transmittance,
};
use crate::{
    geometry::Coordinates,
    math::{Lanes, Pick},
    texture::TextureCoordinates,
};

#[simd]
pub(super) fn shadow<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { shadows, shadow_media, radiance, .. } = batch;
    let scene = work.scene;
    for start in (0..shadows.len()).step_by(L::N) {
        let live = l.first(shadows.len() - start);
        let shadow = Shadow::read(l, shadows, start);
        let (t, primitive) = scene.shapes.closest(l, shadow.o, shadow.d);
        let seen = live & primitive.equals(shadow.target);
        let mut light = shadow.radiance;
        if work.has_media() {
            let media = live.pick(Inside::read(l, shadow_media, start).media, l.u(0));
            light = light * transmittance(l, work, media, t);
        }
        if scene.lights.emitters.vary() {
            let emits = seen & scene.lights.emitters.emits(primitive);
            let primitive = emits.pick(primitive, l.u(0));
            let point = scene.shapes.surface_point(l, primitive, shadow.o + shadow.d * t);
            let Coordinates { u, v } = scene.shapes.coordinates(l, primitive, &point);
            let at = TextureCoordinates { u, v, p: point.p };
            light = light * scene.lights.emitters.variation(l, &scene.textures, emits, primitive, &at);
        }
        add(radiance, seen, shadow.slot, light);
    }
    batch.rays += shadows.len() as u64;
    shadows.clear();
    shadow_media.clear();
}
