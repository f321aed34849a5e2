//! Shading of camera paths: samples lights, connects the vertices with those of light paths, and samples the next
//! directions.
use fearless_simd_macros::simd;

use super::{
    connect::{Connector, finish_connections},
    observer::{Observer, PathStart},
    radius::merged_paths,
    scatter::{Evaluated, are_self_lit, depth, evaluate, media_towards, scatter, transmits},
};
use crate::integrator::{
    batch::Batch,
    interrupted::Interrupted,
    light_paths::{
        partial::{CompetingStrategies, cosine},
        path_state::PathVertex,
        paths::LightPaths,
        records::DirectSample,
    },
    light_sample::call_sample_light,
    queue::{Queue, Register},
    queues::HitQueues,
    records::{MediumStack, Path},
    roulette::survive,
    work::Work,
};
use noisefall_base::math::{Lanes, Pick};
use noisefall_scene::{light::ReferencePoint, material::Stage, sampling::Dimension};

/// Vertices that are connected before the next look at whether to stop, a multiple of all numbers of lanes.
const UNINTERRUPTED: usize = 256;

/// Runs the stage. With many connections it takes milliseconds, so it can be interrupted, too.
#[simd]
pub(super) fn shade_camera_paths<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    batch: &mut Batch,
    state: &mut LightPaths,
    interrupted: &dyn Fn() -> bool,
    observer: &mut O,
) -> Result<(), Interrupted> {
    let Batch { paths, hits, bounce, radiance, rays, .. } = batch;
    let reflection = *bounce + 1;
    let next = &mut paths[(reflection & 1) as usize];
    next.clear();
    let connects = work.settings.estimator.connects();
    let only_caustics = work.settings.estimator.traces_only_caustics();
    // Only light paths sample the first surface.
    let is_joined = !connects && !only_caustics && *bounce == 0;
    let others = match *bounce {
        _ if connects => CompetingStrategies::All,
        0 if only_caustics => CompetingStrategies::All,
        _ if only_caustics => CompetingStrategies::AfterDelta,
        _ => CompetingStrategies::None,
    };
    let is_connected = connects && reflection < work.settings.last_bounce();
    let merged = merged_paths(work);
    for stage in &work.scene.surfaces.stages {
        let hits = &hits[*stage as usize];
        for at in hits.registers(l) {
            if connects && at.start % UNINTERRUPTED == 0 && interrupted() {
                return Err(Interrupted);
            }
            let vertex = state.camera_subpath.read(l, hits, at);
            if stage.sees_lights() && !is_joined {
                queue_light_sample(l, work, *stage, hits, at, &vertex, reflection, merged, &mut state.direct);
            }
            if stage.sees_lights() && connects {
                let connector = Connector { work, stage: *stage, hits, at, vertex: &vertex, reflection, merged };
                // Before connections, which are added in registers: so the sum has one order.
                if merged > 0.0 {
                    connector.merge(l, state, radiance);
                }
                if is_connected {
                    connector.connect(l, state, radiance, rays, observer);
                }
            }
            let scattered = scatter(l, work, *stage, hits, at, vertex.back, reflection);
            let throughput = vertex.hit.throughput * scattered.weight;
            let survival =
                survive(l, work.settings.roulette, reflection, scattered.roulette, throughput, scattered.roulette_scale);
            let mut keep = at.live & survival.alive & scattered.consistent & survival.throughput.max_component().above(0.0);
            if is_joined {
                keep = keep & scattered.delta;
            }
            observer.scattered(PathStart::Camera, keep, &scattered);
            let cos = cosine(scattered.d, vertex.hit.n);
            let pdfs = [scattered.pdf, scattered.reverse];
            let mut partial = vertex.partial.scatter(scattered.delta, pdfs, cos, others, merged);
            let is_only_strategy = scattered.delta & !scattered.reversible;
            partial.c = is_only_strategy.pick(l.f(0.0), partial.c);
            let slot = vertex.hit.slot;
            let end = &mut state.camera_subpath;
            end.put_partial(keep, slot, partial);
            end.put_before(keep, slot, vertex.hit.n, transmits(l, *stage), are_self_lit(l, *stage, hits, at));
            Path { o: scattered.o, d: scattered.d, throughput: survival.throughput, slot }.push(keep, &mut next.paths);
            if work.has_media() {
                MediumStack { media: scattered.media }.push(keep, &mut next.media);
            }
        }
    }
    finish_connections(l, work, reflection, state, radiance, rays, observer);
    Ok(())
}

/// Samples lights, and queues the samples that would contribute if they are visible.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn queue_light_sample<L: Lanes>(
    l: L,
    work: &Work,
    stage: Stage,
    hits: &HitQueues,
    at: Register<L>,
    PathVertex { live, hit, back, partial }: &PathVertex<L>,
    reflection: u32,
    merged: f32,
    queue: &mut Queue,
) {
    let point = ReferencePoint { p: hit.p, n: hit.n, transmits: transmits(l, stage), lobe: None };
    let stream = work.stream(l, hit.slot);
    let is_read = work.scene.lights.have_even_sky();
    let direction = if is_read { stream.two(Dimension::direction(reflection)) } else { (l.f(0.0), l.f(0.0)) };
    let sample = call_sample_light(l, work, &point, &stream, direction, hit.slot, reflection);
    let Evaluated { f_cos, pdf: bsdf_pdf, reverse } = evaluate(l, work, stage, hits, at, [*back, sample.wi]);
    let radiance = hit.throughput * f_cos * sample.radiance * (1.0 / sample.pdf);
    let allowed = *live & (work.scene.lights.are_punctual(sample.target) | !are_self_lit(l, stage, hits, at));
    let keep = allowed & sample.pdf.above(0.0) & radiance.max_component().above(0.0);
    let height = sample.wi.dot(hit.n);
    let o = height.above(0.0).pick(hit.p, hit.p - hit.n * depth(l, stage, hits, at));
    let partial = if work.settings.estimator.connects() { partial.sum(height.abs(), reverse, merged) } else { l.f(0.0) };
    let (d, target, slot, pdf) = (sample.wi, sample.target, hit.slot, sample.pdf);
    let media = media_towards(l, work, stage, hits, at, d);
    DirectSample { o, d, radiance, target, slot, pdf, bsdf_pdf, partial, media }.push(keep, queue);
}
