//! Connects the vertices of camera paths with those of the light path of the same sample.
use fearless_simd_macros::simd;

use super::{
    observer::{Observer, Term},
    radius::merged_paths,
    scatter::{Evaluated, depth, evaluate, media_towards},
    strategy::weight_of,
};
use crate::integrator::{
    batch::add,
    light_paths::{partial::cosine, path_state::PathVertex, paths::LightPaths, records::Connection, vertices::LightVertex},
    media::transmittance,
    queue::Register,
    queues::HitQueues,
    slots::SLOTS,
    visible_fraction::{Segment, visible_fraction},
    work::Work,
};
use noisefall_base::math::{Lanes, MAX_LANES, Pick};
use noisefall_scene::{material::Stage, scene::surface};

/// Connections of a path that are finished together. Queues are emptied only between that many, and the sum of a pixel has the same order
/// for any number of lanes.
const TOGETHER: usize = 32;

/// A register of vertices of camera paths.
pub(super) struct Connector<'a, 'w, L: Lanes> {
    pub work: &'a Work<'w>,
    pub stage: Stage,
    pub hits: &'a HitQueues,
    pub at: Register<L>,
    pub vertex: &'a PathVertex<L>,
    pub reflection: u32,
    /// See [`merged_paths`].
    pub merged: f32,
}

impl<L: Lanes> Connector<'_, '_, L> {
    /// Queues the connections with all vertices of the light paths.
    #[inline(always)]
    pub fn connect<O: Observer<L>>(
        &self,
        l: L,
        state: &mut LightPaths,
        radiance: &mut [[f32; 4]],
        rays: &mut u64,
        observer: &mut O,
    ) {
        let PathVertex { live, hit, .. } = self.vertex;
        let most = self.work.settings.last_bounce() - self.reflection;
        let mut next = live.pick(state.vertices.last(l, hit.slot), l.u(0));
        for count in 0.. {
            let is_full = || state.connections.iter().any(|(queue, _)| queue.len() + TOGETHER * MAX_LANES > SLOTS);
            if count % TOGETHER == 0 && (count > 0 || is_full()) {
                finish_connections(l, self.work, self.reflection, state, radiance, rays, observer);
            }
            let open = !next.is(0);
            if !open.any() {
                return;
            }
            let index = open.pick(next + u32::MAX, l.u(0));
            let light = state.vertices.read(l, index);
            next = open.pick(light.before, l.u(0));
            let allowed = open & light.bounce.below(most);
            if allowed.any() {
                self.queue(l, state, allowed, index, &light);
            }
        }
    }

    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn queue(
        &self,
        l: L,
        state: &mut LightPaths,
        lanes: noisefall_base::math::M<L>,
        index: noisefall_base::math::U<L>,
        light: &LightVertex<L>,
    ) {
        let Connector { work, stage, hits, at, vertex: PathVertex { hit, back, partial, .. }, merged, .. } = self;
        let way = light.p - hit.p;
        let square = way.length_squared();
        let distance = square.sqrt();
        let d = way * (1.0 / distance);
        let Evaluated { f_cos, pdf, reverse } = evaluate(l, work, *stage, hits, *at, [*back, d]);
        let mut contribution = hit.throughput * f_cos;
        if work.has_media() {
            contribution = contribution * transmittance(l, work, media_towards(l, work, *stage, hits, *at, d), distance);
        }
        let keep = lanes & square.above(0.0) & contribution.max_component().above(0.0);
        if !keep.any() {
            return;
        }
        let height = d.dot(hit.n);
        let o = height.above(0.0).pick(hit.p, hit.p - hit.n * depth(l, *stage, hits, *at));
        let record = Connection {
            o,
            d,
            distance,
            cos: height.abs(),
            light: contribution,
            pdf,
            partial: partial.sum(l.f(1.0), reverse, *merged),
            slot: hit.slot,
            vertex: index,
        };
        for stage in &work.scene.surfaces.stages {
            let here = keep & surface::stage(light.word).is(*stage as u32);
            if !here.any() {
                continue;
            }
            let (queue, hits) = &mut state.connections[*stage as usize];
            record.push(here, queue);
            state.vertices.queue_hits(l, work, *stage, here, index, light, hit.slot, hits);
        }
    }
}

/// Finishes all connections.
#[inline(always)]
pub(super) fn finish_connections<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    reflection: u32,
    state: &mut LightPaths,
    radiance: &mut [[f32; 4]],
    rays: &mut u64,
    observer: &mut O,
) {
    for stage in &work.scene.surfaces.stages {
        finish(l, work, *stage, reflection, state, radiance, rays, observer);
    }
}

/// Evaluates the BSDFs at the vertices of lights of a stage, tests which connections are visible, and weights them.
#[simd]
#[allow(clippy::too_many_arguments)]
fn finish<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    stage: Stage,
    reflection: u32,
    state: &mut LightPaths,
    radiance: &mut [[f32; 4]],
    rays: &mut u64,
    observer: &mut O,
) {
    let LightPaths { connections, vertices, .. } = state;
    let (queue, hits) = &mut connections[stage as usize];
    let merged = merged_paths(work);
    for at in queue.registers(l) {
        let connection = Connection::read(l, queue, at.start);
        let Connection { o, d, distance, cos, .. } = connection;
        let index = at.live.pick(connection.vertex, l.u(0));
        let light = vertices.read(l, index);
        let end = vertices.read_end(l, index);
        let Evaluated { f_cos, pdf, reverse } = evaluate(l, work, stage, hits, at, [-d, end.back]);
        let (leaving, arriving) = (d.dot(light.n).abs(), cosine(end.back, light.n));
        let per_area = 1.0 / (distance * distance);
        let contribution = connection.light * end.light * f_cos * (leaving / arriving * per_area);
        let faces = at.live & contribution.max_component().above(0.0);
        if !faces.any() {
            continue;
        }
        *rays += faces.count() as u64;
        let segment = Segment { o, d, distance, end: Some([end.primitive, end.element]), slot: connection.slot };
        let fraction = visible_fraction(l, work, faces, &segment, reflection, rays);
        let seen = fraction.above(0.0);
        let contribution = seen.pick(contribution * fraction, contribution);
        let from_camera = end.partial.sum(connection.pdf * leaving * per_area, pdf, merged);
        let from_light = connection.partial * (reverse * cos * per_area);
        let weight = 1.0 / (1.0 + from_camera + from_light);
        let (s, t) = (light.bounce + 2, reflection + 1);
        let weight = weight_of(work, s, t, weight);
        observer.found(faces, &Term { s, t, light: contribution, weight, seen, light_pdf: l.f(1.0) });
        add(radiance, seen, connection.slot, contribution * weight);
    }
    queue.clear();
    hits.clear();
}
