//! Tests which light samples are visible, and weights them.
use fearless_simd_macros::simd;

use super::{
    observer::{Observer, Term},
    strategy::weight_of,
};
use crate::integrator::{
    batch::{Batch, add},
    light_paths::{paths::LightPaths, records::DirectSample},
    records::Shadow,
    shadow::{Arriving, arriving},
    work::Work,
};
use noisefall_base::math::{Lanes, Pick};
use noisefall_scene::{geometry::MISS, light::LightRays};

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
    let reflection = batch.bounce + 1;
    for at in state.direct.registers(l) {
        let sample = DirectSample::read(l, &state.direct, at.start);
        let DirectSample { o, d, radiance, target, slot, .. } = sample;
        let media = at.live.pick(sample.media, l.u(0));
        let open = (at.live, l.f(f32::INFINITY));
        let shadow = Shadow { o, d, radiance, target, slot };
        let Arriving { seen, light, t } = arriving(l, work, open, &shadow, media, reflection, &mut batch.rays);
        let mut density = l.f(0.0);
        let mut of_sample = sample.pdf;
        let mut by_direction = sample.bsdf_pdf / sample.pdf;
        let mut light_pdf = sample.pdf;
        let on_surface = seen & target.below(lights.surface_count());
        if on_surface.any() {
            let place = lights.place(l, on_surface.pick(target, l.u(0)), work.time(l, slot));
            let point = scene.shapes.surface_point(l, &place, o + d * on_surface.pick(t, l.f(0.0)));
            density = on_surface.pick(rays.density_at_surface(l, lights, &scene.shapes, on_surface, &place, &point), density);
            light_pdf = on_surface.pick(sample.pdf * (d.dot(point.n_geometric).abs() / (t * t)), light_pdf);
        }
        let sky = seen & target.is(MISS);
        if sky.any() {
            density = sky.pick(rays.density_of_environment(l, lights, d), density);
        }
        let punctual_lights = seen & lights.are_punctual(target);
        if punctual_lights.any() {
            let (of_punctual, far) = rays.density_of_punctual(l, lights, punctual_lights, target);
            density = punctual_lights.pick(of_punctual, density);
            of_sample = punctual_lights.pick(sample.pdf * far.pick(l.f(1.0), t * t), of_sample);
            by_direction = punctual_lights.pick(l.f(0.0), by_direction);
        }
        let weight = 1.0 / (1.0 + by_direction + sample.partial * (density / of_sample));
        let (s, t) = (l.u(1), batch.bounce + 2);
        let weight = weight_of(work, s, t, weight);
        let alone = seen.pick(light, radiance);
        observer.found(at.live, &Term { s, t, light: alone, weight, seen, light_pdf });
        add(&mut batch.radiance, seen, slot, light * weight);
    }
    batch.rays += state.direct.len() as u64;
    state.direct.clear();
}
