//! Tests which light samples are visible, and weights them.
use fearless_simd_macros::simd;

use super::{
    observer::{Observer, Term},
    strategy::weight_of,
};
use crate::{
    geometry::{MISS, Nearest, PrimitiveRef},
    integrator::{
        batch::{Batch, add},
        interaction::emission_texture,
        light_paths::{paths::LightPaths, records::DirectSample},
        media::transmittance,
        work::Work,
    },
    light::LightRays,
    math::{Lanes, Pick},
};

#[simd]
pub(super) fn test_light_samples<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    observer: &mut O,
) {
    let (scene, lights) = (work.scene, &work.scene.lights);
    for at in state.direct.registers(l) {
        let sample = DirectSample::read(l, &state.direct, at.start);
        let time = work.time(l, sample.slot);
        let nearest = scene.shapes.closest(l, at.live, sample.o, sample.d, time);
        let (arrives, Nearest { t, primitive, element }) = lights.arrives(l, sample.target, sample.o, nearest);
        let seen = at.live & arrives;
        let mut light = sample.radiance;
        if work.has_media() {
            light = light * transmittance(l, work, at.live.pick(sample.media, l.u(0)), t);
        }
        let mut density = l.f(0.0);
        let mut of_sample = sample.pdf;
        let mut by_direction = sample.bsdf_pdf / sample.pdf;
        let mut light_pdf = sample.pdf;
        let emits = seen & lights.emitters.emits(primitive);
        if emits.any() {
            let place = PrimitiveRef { primitive: emits.pick(primitive, l.u(0)), element: emits.pick(element, l.u(0)), time };
            let point = scene.shapes.surface_point(l, &place, sample.o + sample.d * emits.pick(t, l.f(0.0)));
            density = emits.pick(rays.density_at_surface(l, lights, &scene.shapes, emits, &place, &point), density);
            light_pdf = emits.pick(sample.pdf * (sample.d.dot(point.n_geometric).abs() / (t * t)), light_pdf);
            if lights.emitters.vary() {
                light = light * emission_texture(l, scene, emits, place, point);
            }
        }
        let sky = seen & sample.target.is(MISS);
        if sky.any() {
            density = sky.pick(rays.density_of_background(l, lights, sample.d), density);
        }
        let lamps = seen & lights.are_lamps(sample.target);
        if lamps.any() {
            let (of_lamps, far) = rays.density_of_lamps(l, lights, lamps, sample.target);
            density = lamps.pick(of_lamps, density);
            of_sample = lamps.pick(sample.pdf * far.pick(l.f(1.0), t * t), of_sample);
            by_direction = lamps.pick(l.f(0.0), by_direction);
        }
        let weight = 1.0 / (1.0 + by_direction + sample.partial * (density / of_sample));
        let (s, t) = (l.u(1), batch.bounce + 2);
        let weight = weight_of(work, s, t, weight);
        observer.found(at.live, &Term { s, t, light, weight, seen, light_pdf });
        add(&mut batch.radiance, seen, sample.slot, light * weight);
    }
    batch.rays += state.direct.len() as u64;
    state.direct.clear();
}
