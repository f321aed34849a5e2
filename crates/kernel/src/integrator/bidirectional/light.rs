//! Shading of light paths: joins their vertices with the camera, keeps them for connections, and samples the next directions.
use fearless_simd_macros::simd;

use super::{
    observer::{Observer, PathStart, Term},
    radius::merged_paths,
    scatter::{Evaluated, are_self_lit, depth, evaluate, media_towards, scatter, transmits},
    strategy::weight_of,
};
use crate::integrator::{
    batch::Batch,
    light_paths::{
        partial::{CompetingStrategies, Partial, cosine},
        path_state::PathVertex,
        paths::LightPaths,
        records::CameraRay,
    },
    media::transmittance,
    queue::{Queue, Register},
    queues::HitQueues,
    records::{MediumStack, Path},
    roulette::survive,
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::{
    geometry::{MISS, PrimitiveRef},
    light::{LightRays, ReferencePoint},
    material::Stage,
    sampling::Dimension,
};

/// Runs the stage.
#[simd]
pub(super) fn shade_light_paths<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    observer: &mut O,
) {
    let Batch { paths, hits, bounce, .. } = batch;
    let next = &mut paths[((*bounce + 1) & 1) as usize];
    next.clear();
    let (connects, only_caustics) = (work.settings.estimator.connects(), work.settings.estimator.traces_only_caustics());
    let merged = merged_paths(work);
    // A merge is at a surface of the camera path, and does not count as one more.
    let is_kept = connects && (merged > 0.0 || *bounce + 2 <= work.settings.last_bounce());
    // Without a surface between, camera paths find the light by light samples.
    let is_joined = !only_caustics || *bounce > 0;
    let others = if connects || only_caustics { CompetingStrategies::All } else { CompetingStrategies::None };
    for stage in &work.scene.surfaces.stages {
        let hits = &hits[*stage as usize];
        for at in hits.registers(l) {
            let mut vertex = state.light_subpath.read(l, hits, at);
            if *bounce == 0 && others == CompetingStrategies::All {
                vertex.partial = at_first_surface(l, work, rays, state, *stage, are_self_lit(l, *stage, hits, at), &vertex);
            }
            let [r, g, b, _] = l.rows(&state.fluxes, vertex.hit.slot);
            let light = vertex.hit.throughput * V { x: r, y: g, z: b };
            if stage.sees_lights() && is_joined {
                queue_join(l, work, *stage, hits, at, &vertex, light, *bounce, merged, &mut state.joins, observer);
                if is_kept {
                    let place = state.light_subpath.place(l, vertex.hit.slot);
                    state.vertices.push(l, work, *stage, hits, at, &vertex, light, place, *bounce);
                }
            }
            let reflection = Dimension::LIGHT_PATH + *bounce + 1;
            let scattered = scatter(l, work, *stage, hits, at, vertex.back, reflection);
            let throughput = vertex.hit.throughput * scattered.adjoint_weight;
            let survival = survive(l, work.settings.roulette, *bounce + 1, scattered.roulette, throughput, l.f(1.0));
            let mut keep = at.live & survival.alive & scattered.consistent & survival.throughput.max_component().above(0.0);
            keep = keep & (scattered.reversible | !scattered.delta);
            if only_caustics {
                keep = keep & scattered.delta;
            }
            observer.scattered(PathStart::Light, keep, &scattered);
            let cos = cosine(scattered.d, vertex.hit.n);
            let pdfs = [scattered.pdf, scattered.reverse];
            let partial = vertex.partial.scatter(scattered.delta, pdfs, cos, others, merged);
            let slot = vertex.hit.slot;
            state.light_subpath.put_partial(keep, slot, partial);
            Path { o: scattered.o, d: scattered.d, throughput: survival.throughput, slot }.push(keep, &mut next.paths);
            if work.has_media() {
                MediumStack { media: scattered.media }.push(keep, &mut next.media);
            }
        }
    }
}

/// The partial sums at the first surfaces. Light samples there could have found the same lights.
#[inline(always)]
fn at_first_surface<L: Lanes>(
    l: L,
    work: &Work,
    rays: &LightRays,
    state: &LightPaths,
    stage: Stage,
    self_lit: M<L>,
    PathVertex { live, hit, back, .. }: &PathVertex<L>,
) -> Partial<L> {
    let lights = &work.scene.lights;
    let [.., inverse_density] = l.rows(&state.fluxes, hit.slot);
    let [light, primitive, element, _] = l.rows(&state.sources, hit.slot);
    let (light, primitive, element) = (light.bits(), primitive.bits(), element.bits());
    let at = ReferencePoint { p: hit.p, n: hit.n, transmits: transmits(l, stage), lobe: None };
    let punctual_lights = *live & lights.are_punctual(light);
    // Lanes that are not live may hold the source of a path in another scene.
    let on_surface = *live & !punctual_lights & !light.is(MISS);
    let (primitive, element) = (on_surface.pick(primitive, l.u(MISS)), on_surface.pick(element, l.u(0)));
    let place = PrimitiveRef { primitive, element, time: work.time(l, hit.slot) };
    let mut pdf = self_lit.pick(l.f(0.0), lights.pdf(l, &work.scene.shapes, &at, *back, &place));
    let mut finds_light = l.f(1.0);
    if punctual_lights.any() {
        pdf = punctual_lights.pick(pdf_of_punctual(l, work, rays, &at, punctual_lights, light), pdf);
        finds_light = punctual_lights.pick(l.f(0.0), finds_light);
    }
    let cos = cosine(*back, hit.n);
    let v = pdf * inverse_density / cos;
    Partial { v, c: finds_light * inverse_density / cos }
}

/// The pdf of light samples of lights, in the unit of the light density: per area across the ray, or for directional lights none.
#[inline(always)]
fn pdf_of_punctual<L: Lanes>(
    l: L,
    work: &Work,
    rays: &LightRays,
    at: &ReferencePoint<L>,
    punctual_lights: M<L>,
    light: U<L>,
) -> F<L> {
    let lights = &work.scene.lights;
    let (_, far) = rays.density_of_punctual(l, lights, punctual_lights, light);
    let distance = lights.distance_of_punctual(l, punctual_lights, light, at.p);
    lights.probability_of_punctual(l, at, punctual_lights, light) * far.pick(l.f(1.0), distance * distance)
}

/// Queues joins with the camera that would contribute if nothing lies between.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn queue_join<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    stage: Stage,
    hits: &HitQueues,
    at: Register<L>,
    PathVertex { live, hit, back, partial }: &PathVertex<L>,
    light: V<L>,
    bounce: u32,
    merged: f32,
    queue: &mut Queue,
    observer: &mut O,
) {
    let lens = work.stream(l, hit.slot).two(Dimension::light(Dimension::LIGHT_PATH + bounce + 1));
    let join = work.rays.join(l, hit.p, work.time(l, hit.slot), lens);
    let reach = work.rays.filter.reach();
    let [width, height] = work.rays.resolution;
    let shown_across = join.x.above(-reach) & join.x.below(width as f32 + reach);
    let shown = shown_across & join.y.above(-reach) & join.y.below(height as f32 + reach);
    let faces = *live & join.visible & shown;
    if !faces.any() {
        return;
    }
    let distance = join.way.length_squared().sqrt();
    let d = join.way * (1.0 / distance);
    let Evaluated { f_cos, pdf, .. } = evaluate(l, work, stage, hits, at, [d, *back]);
    let (height, cos_in) = (d.dot(hit.n), cosine(*back, hit.n));
    let density = join.density * height.abs();
    let mut light = light * f_cos * (density / cos_in);
    if work.has_media() {
        light = light * transmittance(l, work, media_towards(l, work, stage, hits, at, d), distance);
    }
    let mut weight = l.f(1.0);
    let (s, t) = (l.u(bounce + 2), 1);
    let estimator = work.settings.estimator;
    if estimator.connects() || estimator.traces_only_caustics() {
        let found = density * (1.0 / work.light_paths_of_image());
        weight = weight_of(work, s, t, 1.0 / (1.0 + partial.sum(found, pdf, merged)));
    }
    let o = height.above(0.0).pick(hit.p, hit.p - hit.n * depth(l, stage, hits, at));
    let weighted = light * weight;
    let keep = faces & weighted.max_component().above(0.0);
    observer.found(keep, &Term { s, t, light, weight, seen: keep, light_pdf: l.f(1.0) });
    CameraRay { o, d, distance, slot: hit.slot, x: join.x, y: join.y, light: weighted }.push(keep, queue);
}
