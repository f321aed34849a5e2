//! Third stage: adds emission and background, and sorts the paths at reflecting surfaces by BSDF type.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, add},
    interaction::{SurfaceInteraction, emitted, interact},
    media::transmittance,
    normal_mapping::reflecting_normal,
    normal_shadowing::shadowing_of_normals,
    queue::Register,
    queues::{HitQueues, PathQueues},
    records::{Detail, Hit, Path, Transmittance},
    shared::Shared,
    variation::{IncidentPaths, chart, relief, transmittance_of_surface, vary},
    weight::weight_of_hit,
    work::Work,
};
use noisefall_base::math::{Lanes, M, Pick, U, V};
use noisefall_scene::{
    geometry::{MISS, Nearest, PrimitiveRef},
    material::Stage,
    scene::surface::{self, FRONT, SCATTERS_WHERE_BLACK, is_set},
};

/// Runs the stage. `last`: this is the last bounce, and nothing is reflected. `VARIED` is compiled for scenes whose surfaces are
/// not all plain.
#[simd]
pub(super) fn surfaces<L: Lanes, const VARIED: bool>(l: L, work: &Work, batch: &mut Batch, last: bool) {
    let Batch { paths, first_hits, hits, radiance, shared, crossings, bounce, .. } = batch;
    hits.iter_mut().for_each(HitQueues::clear);
    let paths = &paths[(*bounce & 1) as usize];
    let previous = (*bounce > 0 && work.weights_hits()).then_some(paths);
    let shares = *bounce == 1 && work.shares();
    let has_elements = VARIED && work.scene.shapes.have_elements();
    for at in paths.registers(l) {
        let nearest = first_hits.get(l, at.start, has_elements);
        let mut arrival = Arrival::read::<VARIED>(l, work, paths, at, nearest);
        if shares {
            arrival.weigh_by_first_surface(l, shared);
        }
        let miss = arrival.nearest.primitive.is(MISS);
        let (mut live, mut goes_on) = (at.live, at.live);
        if VARIED && work.counts_crossings() {
            let left = crossings.left(l, work, at.live, arrival.path.slot, *bounce);
            (live, goes_on) = (live & !left.below(0.0), live & left.above(0.0));
        }
        add_environment(l, work, previous, &arrival, live & miss, radiance);
        let hit = live & !miss;
        if !hit.any() {
            continue;
        }
        let rows = if VARIED { work.rows_of_blends(l, first_hits, at.start) } else { None };
        let interaction = interact::<L, VARIED>(l, work, &arrival.path, hit, &arrival.nearest, rows);
        add_emission::<L, VARIED>(l, work, previous, &arrival, hit, &interaction, radiance);
        if !last {
            let shared = if shares { Some(&mut *shared) } else { None };
            queue_hits::<L, VARIED>(l, work, &arrival, hit & goes_on, &interaction, shared, hits);
        }
    }
}

/// Paths that arrive at their first surfaces, or leave the scene.
pub(super) struct Arrival<L: Lanes> {
    /// Index of the first path in its queue.
    start: usize,
    /// The paths, with the transmittance of the way in their throughput.
    pub path: Path<L>,
    pub nearest: Nearest<L>,
    /// Media around the paths.
    media: U<L>,
    /// Lanes that share their first surface with other pixels.
    path_reuse: M<L>,
    /// The throughput without the albedo of a first surface that is shared.
    shared_throughput: V<L>,
    /// See [`IncidentPaths::keeps_hidden_normals`].
    keeps_hidden_normals: bool,
}

impl<L: Lanes> Arrival<L> {
    /// Paths that are connected with those from the other end.
    #[inline(always)]
    pub fn from_either_end(l: L, work: &Work, paths: &PathQueues, at: Register<L>, nearest: Nearest<L>) -> Self {
        Arrival { keeps_hidden_normals: true, ..Arrival::read::<true>(l, work, paths, at, nearest) }
    }

    #[inline(always)]
    fn read<const VARIED: bool>(l: L, work: &Work, paths: &PathQueues, at: Register<L>, nearest: Nearest<L>) -> Self {
        let mut path = Path::read(l, &paths.paths, at.start);
        let mut media = l.u(0);
        if VARIED && work.has_media() {
            media = paths.media(l, at);
            path.throughput = path.throughput * transmittance(l, work, media, nearest.t);
        }
        let (path_reuse, shared_throughput) = (l.first(0), path.throughput);
        Arrival { start: at.start, nearest, media, path_reuse, shared_throughput, path, keeps_hidden_normals: false }
    }

    /// Multiplies the throughput by the albedo of first surfaces that are shared.
    #[inline(always)]
    fn weigh_by_first_surface(&mut self, l: L, shared: &Shared) {
        let (path_reuse, albedo) = shared.first(l, self.path.slot);
        self.path_reuse = path_reuse;
        self.path.throughput = path_reuse.pick(self.path.throughput * albedo, self.path.throughput);
    }
}

/// Adds the environment in the lanes of `sky`, weighted by multiple importance sampling if there are `previous` vertices.
#[inline(always)]
fn add_environment<L: Lanes>(
    l: L,
    work: &Work,
    previous: Option<&PathQueues>,
    arrival: &Arrival<L>,
    sky: M<L>,
    radiance: &mut [[f32; 4]],
) {
    let Some(environment) = &work.scene.lights.environment else { return };
    if !sky.any() {
        return;
    }
    let path = &arrival.path;
    let mut light = path.throughput * environment.radiance(l, path.d);
    if let Some(previous) = previous {
        light = light * weight_of_hit(l, work, previous, arrival.start, path, PrimitiveRef::of(l, arrival.nearest.primitive));
    }
    add(radiance, sky, path.slot, light);
}

/// Adds what the surfaces in the lanes of `hit` emit, weighted by multiple importance sampling if there are `previous` vertices.
#[inline(always)]
fn add_emission<L: Lanes, const VARIED: bool>(
    l: L,
    work: &Work,
    previous: Option<&PathQueues>,
    arrival: &Arrival<L>,
    hit: M<L>,
    interaction: &SurfaceInteraction<L>,
    radiance: &mut [[f32; 4]],
) {
    let emitters = &work.scene.lights.emitters;
    if emitters.is_empty() {
        return;
    }
    let emits = hit & emitters.emits(interaction.place.primitive);
    if !emits.any() {
        return;
    }
    let path = &arrival.path;
    let (le, seen) = emitted::<L, VARIED>(l, work.scene, emits, interaction);
    let mut light = path.throughput * le;
    if let Some(previous) = previous {
        light = light * weight_of_hit(l, work, previous, arrival.start, path, interaction.place);
    }
    add(radiance, seen, path.slot, light);
}

/// Queues the paths in the lanes of `hit` at reflecting surfaces. Second surfaces that pixels share are kept in `shared`.
#[inline(always)]
pub(super) fn queue_hits<L: Lanes, const VARIED: bool>(
    l: L,
    work: &Work,
    arrival: &Arrival<L>,
    hit: M<L>,
    interaction: &SurfaceInteraction<L>,
    shared: Option<&mut Shared>,
    queues: &mut [HitQueues],
) {
    let Arrival { path, media, keeps_hidden_normals, .. } = arrival;
    let SurfaceInteraction { place, row, point, cos } = interaction;
    let [x, y, z, word] = l.rows(&work.scene.surfaces.rows, *row);
    let (colour, word) = (V { x, y, z }, word.bits());
    let n = point.n_geometric * l.f(1.0).copysign(*cos);
    let record = Hit { p: point.p + n * point.error, n, colour, throughput: path.throughput, slot: path.slot };
    let mut plain = record;
    if let Some(shared) = shared {
        let kept = arrival.path_reuse & hit & surface::stage(word).is(Stage::Plain as u32);
        plain.throughput = kept.pick(arrival.shared_throughput, plain.throughput);
        shared.keep_second(kept, place, &mut plain);
    }
    if VARIED {
        let incident = IncidentPaths {
            d: path.d,
            interaction: *interaction,
            media: *media,
            word,
            keeps_hidden_normals: *keeps_hidden_normals,
        };
        sort(l, work, queues, &incident, [record, plain], hit);
    } else {
        plain.push(hit & colour.max_component().above(0.0), &mut queues[Stage::Plain as usize].hits);
    }
}

/// Queues the paths of `mask` at reflecting surfaces, by shading stage. The plain stage gets its own record of them.
#[inline(always)]
fn sort<L: Lanes>(
    l: L,
    work: &Work,
    queues: &mut [HitQueues],
    incident: &IncidentPaths<L>,
    [hit, plain]: [Hit<L>; 2],
    mask: M<L>,
) {
    let word = incident.word;
    let (front, reflects) = incident.sides();
    let faces = mask & reflects;
    let (colour, detail, untilted) = vary(l, work.scene, incident, faces, hit.colour, hit.n);
    let detail = Detail { surface: word | front.pick(l.u(FRONT), l.u(0)), ..detail };
    let reflects = faces & (colour.max_component().above(0.0) | is_set(word, SCATTERS_WHERE_BLACK));
    for stage in &work.scene.surfaces.stages {
        let here = reflects & surface::stage(word).is(*stage as u32);
        let queues = &mut queues[*stage as usize];
        if *stage == Stage::Plain {
            Hit { colour, ..plain }.push(here, &mut queues.hits);
        } else {
            Hit { colour, ..hit }.push(here, &mut queues.hits);
            if stage.has_highlights() && incident.bends_normals(work.scene) && here.any() {
                Detail { n: reflecting_normal(l, detail.n, hit.n, detail.wo).0, ..detail }.push(here, &mut queues.details);
            } else {
                detail.push(here, &mut queues.details);
            }
            if work.scene.surfaces.charted && stage.reads_chart() && here.any() {
                chart(l, work.scene, incident).push(here, &mut queues.charts);
            }
            if work.scene.surfaces.normal_shadowing && here.any() {
                let [.., flags] = l.rows(&work.scene.surfaces.relief, incident.interaction.row);
                shadowing_of_normals(l, flags.bits(), untilted, detail.n).push(here, &mut queues.normal_shadowing);
            }
            if incident.keeps_hidden_normals && !work.scene.surfaces.relief.is_empty() && here.any() {
                relief(l, work.scene, incident, here, hit.n, untilted).push(here, &mut queues.relief);
            }
            if stage.has_transmittance() {
                let colour = transmittance_of_surface(l, work.scene, incident, here);
                Transmittance { colour }.push(here, &mut queues.transmittances);
            }
        }
    }
}
