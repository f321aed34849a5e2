//! Third stage: adds emission and background, and sorts the paths at reflecting surfaces by BSDF type.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, add},
    media::transmittance,
    normal_mapping::shading_normal,
    queue::Queue,
    records::{Detail, Hit, Inside, Path, PreviousLobe, PreviousVertex},
    weight::emitter_hit_weight,
    work::Work,
};
use crate::{
    geometry::{Coordinates, MISS, PrimitiveRef, SurfacePoint},
    light::Lobe,
    material::Stage,
    math::{F, Lanes, M, Pick, U, V},
    scene::{
        Scene,
        surface::{self, FLIPPED, FRONT, ONE_SIDED, SCATTERS_WHERE_BLACK, SQUARED, is_set},
    },
    texture::TextureCoordinates,
};

/// Minimum height of the viewer over a shading normal; below it, the geometric normal is used.
const GRAZING: f32 = 1e-3;

/// Runs the stage. `last`: this is the last bounce, and nothing is reflected. `VARIED` is compiled for scenes whose surfaces are
/// not all plain.
#[simd]
pub(super) fn surfaces<L: Lanes, const VARIED: bool>(l: L, work: &Work, batch: &mut Batch, last: bool) {
    let scene = work.scene;
    let Batch {
        paths,
        previous_vertices,
        previous_lobes,
        path_media,
        hits,
        details,
        t,
        primitive,
        element,
        radiance,
        shared,
        bounce,
        ..
    } = batch;
    hits.iter_mut().chain(details.iter_mut()).for_each(Queue::clear);
    let current = (*bounce & 1) as usize;
    let (paths, previous_vertices, path_media) =
        (&paths[current], (&previous_vertices[current], &previous_lobes[current]), &path_media[current]);
    let weighted = *bounce > 0 && work.samples_lights();
    let shares = *bounce == 1 && work.shares();
    for start in (0..paths.len()).step_by(L::N) {
        let live = l.first(paths.len() - start);
        let mut path = Path::read(l, paths, start);
        let primitive = l.load(&primitive[start..]).bits();
        let miss = primitive.is(MISS);
        let t = l.load(&t[start..]);
        let mut media = l.u(0);
        if VARIED && work.has_media() {
            // Lanes past the end may say anything, even media of an earlier scene.
            media = live.pick(Inside::read(l, path_media, start).media, l.u(0));
            path.throughput = path.throughput * transmittance(l, work, media, t);
        }
        let shared_throughput = path.throughput;
        let mut sharing = l.first(0);
        if shares {
            let (first, albedo) = shared.first(l, path.slot);
            sharing = live & first;
            path.throughput = sharing.pick(path.throughput * albedo, path.throughput);
        }
        if let Some(background) = &scene.lights.background {
            let sky = live & miss;
            if sky.any() {
                let mut light = path.throughput * background.radiance(l, path.d);
                if weighted {
                    light = light * weight(l, work, previous_vertices, start, &path, PrimitiveRef::of(l, primitive));
                }
                add(radiance, sky, path.slot, light);
            }
        }
        let hit = live & !miss;
        if !hit.any() {
            continue;
        }

        let interaction = interact::<L, VARIED>(l, work, &path, hit, t, primitive, &element[start..]);
        let SurfaceInteraction { place, point, cos } = interaction;
        let primitive = place.primitive;
        if !scene.lights.emitters.is_empty() {
            let emits = hit & scene.lights.emitters.emits(primitive);
            if emits.any() {
                let (le, seen) = emitted::<L, VARIED>(l, scene, emits, &interaction);
                let mut light = path.throughput * le;
                if weighted {
                    light = light * weight(l, work, previous_vertices, start, &path, place);
                }
                add(radiance, seen, path.slot, light);
            }
        }
        if last {
            continue;
        }

        let [x, y, z, word] = l.rows(&scene.surfaces.rows, primitive);
        let colour = V { x, y, z };
        let n = point.n_geometric * l.f(1.0).copysign(cos);
        let record = Hit { p: point.p + n * point.error, n, colour, throughput: path.throughput, slot: path.slot };
        let mut plain = record;
        if shares {
            let kept = sharing & hit & surface::stage(word.bits()).is(Stage::Plain as u32);
            plain.throughput = kept.pick(shared_throughput, plain.throughput);
            shared.keep_second(kept, &place, &mut plain);
        }
        if VARIED {
            let incident = IncidentPaths { d: path.d, interaction, media, word: word.bits(), plain };
            sort(l, work, hits, details, &incident, record, hit);
        } else {
            plain.push(hit & colour.max_component().above(0.0), &mut hits[Stage::Plain as usize]);
        }
    }
}

/// Surface interactions of paths.
#[derive(Clone, Copy)]
pub(super) struct SurfaceInteraction<L: Lanes> {
    pub place: PrimitiveRef<L>,
    pub point: SurfacePoint<L>,
    /// Cosine between the front normal and the direction to the viewer.
    pub cos: F<L>,
}

/// The interactions of the paths in the lanes of `hit` with their primitives at distance `t`. The other lanes use primitive 0 and
/// must be masked.
#[inline(always)]
pub(super) fn interact<L: Lanes, const VARIED: bool>(
    l: L,
    work: &Work,
    path: &Path<L>,
    hit: M<L>,
    t: F<L>,
    primitive: U<L>,
    element: &[f32],
) -> SurfaceInteraction<L> {
    let shapes = &work.scene.shapes;
    let mut place = PrimitiveRef::of(l, hit.pick(primitive, l.u(0)));
    if VARIED {
        place.time = work.time(l, path.slot);
    }
    if VARIED && shapes.have_elements() {
        place.element = hit.pick(l.load(element).bits(), l.u(0));
    }
    let p = path.o + path.d * hit.pick(t, l.f(0.0));
    let point = if VARIED { shapes.surface_point(l, &place, p) } else { shapes.simple_point(l, place.primitive, p) };
    SurfaceInteraction { place, point, cos: -point.n_geometric.dot(path.d) }
}

/// The radiance emitted towards the viewer in the lanes of `emits`, and the mask of those that see an emitting side.
#[inline(always)]
pub(super) fn emitted<L: Lanes, const VARIED: bool>(
    l: L,
    scene: &Scene,
    emits: M<L>,
    interaction: &SurfaceInteraction<L>,
) -> (V<L>, M<L>) {
    let emitters = &scene.lights.emitters;
    let (mut le, seen) = emitters.radiance(l, emits, interaction.place.primitive, interaction.cos);
    if VARIED && emitters.vary() {
        le = le * emission_texture(l, scene, emits, &interaction.place, &interaction.point);
    }
    (le, seen)
}

/// The MIS weight of emitter hits of the paths of a register, read from `start` on; see [`emitter_hit_weight`].
///
/// The place is passed by value; otherwise it would be kept in memory even for scenes that do not need it.
#[inline(always)]
pub(super) fn weight<L: Lanes>(
    l: L,
    work: &Work,
    (previous_vertices, previous_lobes): (&Queue, &Queue),
    start: usize,
    path: &Path<L>,
    place: PrimitiveRef<L>,
) -> F<L> {
    let previous = PreviousVertex::read(l, previous_vertices, start);
    let lobe = if work.heeds_lobes() {
        let PreviousLobe { wo, alpha } = PreviousLobe::read(l, previous_lobes, start);
        Some(Lobe { wo, alpha })
    } else {
        None
    };
    emitter_hit_weight(l, work, &previous, lobe, path.o, path.d, &place)
}

/// The factor of textured emission at a point.
#[inline(always)]
pub(super) fn emission_texture<L: Lanes>(
    l: L,
    scene: &Scene,
    emits: M<L>,
    place: &PrimitiveRef<L>,
    point: &SurfacePoint<L>,
) -> V<L> {
    let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
    let at = TextureCoordinates { u, v, p: point.p };
    scene.lights.emitters.variation(l, &scene.textures, emits, place.primitive, &at)
}

/// Paths at a surface.
pub(super) struct IncidentPaths<L: Lanes> {
    pub d: V<L>,
    pub interaction: SurfaceInteraction<L>,
    /// Media around the paths.
    pub media: U<L>,
    /// See [`surface`].
    pub word: U<L>,
    /// The record for plain surfaces.
    pub plain: Hit<L>,
}

impl<L: Lanes> IncidentPaths<L> {
    /// Whether the paths are at the front, and whether the surface reflects on their side.
    #[inline(always)]
    pub fn sides(&self) -> (M<L>, M<L>) {
        let front = self.interaction.cos.above(0.0) ^ is_set(self.word, FLIPPED);
        (front, front | !is_set(self.word, ONE_SIDED))
    }
}

/// Queues the paths of `mask` at reflecting surfaces, by shading stage.
#[inline(always)]
fn sort<L: Lanes>(
    l: L,
    work: &Work,
    hits: &mut [Queue],
    details: &mut [Queue],
    incident: &IncidentPaths<L>,
    mut hit: Hit<L>,
    mask: M<L>,
) {
    let word = incident.word;
    let (front, reflects) = incident.sides();
    let faces = mask & reflects;
    let detail = vary(l, work.scene, incident, faces, &mut hit);
    let detail = Detail { surface: word | front.pick(l.u(FRONT), l.u(0)), ..detail };
    let reflects = faces & (hit.colour.max_component().above(0.0) | is_set(word, SCATTERS_WHERE_BLACK));
    for stage in &work.scene.surfaces.stages {
        let here = reflects & surface::stage(word).is(*stage as u32);
        if *stage == Stage::Plain {
            Hit { colour: hit.colour, ..incident.plain }.push(here, &mut hits[*stage as usize]);
        } else {
            hit.push(here, &mut hits[*stage as usize]);
            detail.push(here, &mut details[*stage as usize]);
        }
    }
}

/// Evaluates textures: sets the colour of the hit, and returns its details.
#[inline(always)]
pub(super) fn vary<L: Lanes>(l: L, scene: &Scene, incident: &IncidentPaths<L>, mask: M<L>, hit: &mut Hit<L>) -> Detail<L> {
    let Scene { surfaces, textures, .. } = scene;
    let IncidentPaths { d, interaction: SurfaceInteraction { place, point, cos }, media, word, .. } = incident;
    let [mut alpha, colour_texture, alpha_texture, medium] = l.rows(&surfaces.varying, place.primitive);
    let wo = -*d;
    let mut n = hit.n;
    if scene.shapes.have_elements() {
        let smooth = scene.shapes.smooth_normal(l, place, point) * l.f(1.0).copysign(*cos);
        n = smooth.dot(wo).above(GRAZING).pick(smooth, n);
    }
    if surfaces.textured || !surfaces.relief.is_empty() {
        let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
        let at = TextureCoordinates { u, v, p: point.p };
        let id = colour_texture.bits();
        let coloured = mask & !id.is(0);
        if coloured.any() {
            hit.colour = coloured.pick(textures.colour(l, id + u32::MAX, coloured, &at), hit.colour);
        }
        let id = alpha_texture.bits();
        let rough = mask & !id.is(0);
        if rough.any() {
            let value = textures.height(l, id + u32::MAX, rough, &at);
            alpha = rough.pick(is_set(*word, SQUARED).pick(value * value, value), alpha);
        }
        if !surfaces.relief.is_empty() {
            let side = l.f(1.0).copysign(*cos);
            let tilted = shading_normal(l, scene, place, mask, point, n * side, &at) * side;
            // A normal that the viewer could not see is not used.
            n = tilted.dot(wo).above(GRAZING).pick(tilted, n);
        }
    }
    Detail { wo, n, alpha, error: point.error, surface: *word, media: *media, medium: medium.bits() }
}
