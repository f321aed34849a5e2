//! First stage of light paths: samples a light, a point and a direction for every slot.
use fearless_simd_macros::simd;

use super::observer::Observer;
use crate::integrator::{
    batch::Batch,
    interaction::emission_texture,
    light_paths::{partial::Partial, paths::LightPaths},
    records::{MediumStack, Path},
    shared::put,
    work::Work,
};
use noisefall_base::math::{Lanes, V};
use noisefall_scene::{
    light::{LightRays, RayCoordinates},
    sampling::Dimension,
};

#[simd]
pub(super) fn emit<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    observer: &mut O,
) {
    batch.bounce = 0;
    batch.paths[0].clear();
    state.vertices.clear();
    let scene = work.scene;
    for start in (0..work.slots()).step_by(L::N) {
        let slot = l.iota() + start;
        let inside = work.inside(work.pixel(l, slot));
        let stream = work.stream(l, slot);
        let coordinates = RayCoordinates {
            choice: stream.two(Dimension::LIGHT_TABLE),
            place: stream.two(Dimension::LIGHT_PLACE),
            direction: stream.two(Dimension::LIGHT_DIRECTION),
            cell: stream.two(Dimension::LIGHT_CELL),
            side: stream.one(Dimension::LIGHT_SIDE),
        };
        let ray = rays.sample(l, &scene.lights, &scene.shapes, work.time(l, slot), &coordinates);
        let mut flux = ray.flux;
        if scene.lights.emitters.vary() && ray.on_surface.any() {
            flux = flux * emission_texture(l, scene, ray.on_surface, ray.place, ray.point);
        }
        let starts = inside & ray.inverse_density.above(0.0) & flux.max_component().above(0.0);
        observer.emitted(starts, &ray);
        let end = &mut state.light_subpath;
        put(starts, slot, flux, ray.inverse_density, &mut state.fluxes);
        let (x, y, z) = (ray.light.as_real_bits(), ray.place.primitive.as_real_bits(), ray.place.element.as_real_bits());
        put(starts, slot, V { x, y, z }, l.f(0.0), &mut state.sources);
        end.put_partial(starts, slot, Partial { v: l.f(0.0), c: l.f(0.0) });
        Path { o: ray.o, d: ray.d, throughput: V::splat(l, [1.0; 3]), slot }.push(starts, &mut batch.paths[0].paths);
        if work.has_media() {
            MediumStack { media: ray.media }.push(starts, &mut batch.paths[0].media);
        }
    }
}
