//! Third stage: what paths meet. Adds emission and background; sorts the paths whose surface reflects by kind of bsdf.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Detail, Hit, Inside, Past, Path, Work, add},
    media::transmittance,
    queue::Queue,
    relief::shading_normal,
    weight::weight_of_met_light,
};
use crate::{
    geometry::{MISS, SurfacePoint, sphere_uv},
    math::{F, Lanes, M, Pick, U, V},
    scene::{
        Scene,
        surface::{self, FLIPPED, FRONT, ONE_SIDED, SQUARED, Stage, is_set},
    },
    texture::TextureCoordinates,
};

/// Viewers lower than this over a shading normal see the geometric one instead.
const GRAZING: f32 = 1e-3;

/// `last`: nothing is reflected any more.
#[simd]
pub(super) fn surfaces<L: Lanes>(l: L, work: &Work, batch: &mut Batch, last: bool) {
    let scene = work.scene;
    batch.hits.iter_mut().chain(&mut batch.details).for_each(Queue::clear);
    let weighted = batch.bounce > 0 && work.samples_lights();
    let count = batch.current().len();
    for start in (0..count).step_by(L::N) {
        let live = l.first(count - start);
        let mut path = Path::read(l, batch.current(), start);
        let primitive = l.load(&batch.primitive[start..]).bits();
        let miss = primitive.is(MISS);
        let mut media = l.u(0);
        if work.has_media() {
            media = Inside::read(l, &batch.path_media[(batch.bounce & 1) as usize], start).media;
            path.throughput = path.throughput * transmittance(l, work, media, l.load(&batch.t[start..]));
        }
        if let Some(background) = &scene.lights.background {
            let sky = live & miss;
            if sky.any() {
                let mut light = path.throughput * background.radiance(l, path.d);
                if weighted {
                    let past = Past::read(l, batch.past(), start);
                    light = light * weight_of_met_light(l, work, &past, path.o, path.d, primitive);
                }
                add(&mut batch.radiance, sky, path.slot, light);
            }
        }
        let hit = live & !miss;
        if !hit.any() {
            continue;
        }

        // Lanes without a surface look at primitive 0 and are masked out.
        let primitive = hit.pick(primitive, l.u(0));
        let t = hit.pick(l.load(&batch.t[start..]), l.f(0.0));
        let point = scene.shapes.surface_point(l, primitive, path.o + path.d * t);
        let cos = -point.n_geometric.dot(path.d);
        if !scene.lights.emitters.is_empty() {
            let emits = hit & scene.lights.emitters.emits(primitive);
            if emits.any() {
                let (le, seen) = scene.lights.emitters.radiance(l, emits, primitive, cos);
                let mut light = path.throughput * le;
                if scene.lights.emitters.vary() {
                    let (u, v) = sphere_uv(point.n_geometric);
                    let at = TextureCoordinates { u, v, p: point.p };
                    light = light * scene.lights.emitters.variation(l, &scene.textures, emits, primitive, &at);
                }
                if weighted {
                    let past = Past::read(l, batch.past(), start);
                    light = light * weight_of_met_light(l, work, &past, path.o, path.d, primitive);
                }
                add(&mut batch.radiance, seen, path.slot, light);
            }
        }
        if !last {
            sort(l, work, batch, &Arrival { path, point, cos, primitive, media }, hit);
        }
    }
}

/// Paths at a surface.
struct Arrival<L: Lanes> {
    path: Path<L>,
    point: SurfacePoint<L>,
    /// Between the front normal and the direction to the viewer.
    cos: F<L>,
    primitive: U<L>,
    /// What the paths are in.
    media: U<L>,
}

/// Queues the paths of `hit` whose surface reflects, by shading stage.
#[inline(always)]
fn sort<L: Lanes>(l: L, work: &Work, batch: &mut Batch, arrival: &Arrival<L>, hit: M<L>) {
    let Arrival { path, point, cos, primitive, .. } = arrival;
    let surfaces = &work.scene.surfaces;
    let [x, y, z, word] = l.rows(&surfaces.rows, *primitive);
    let colour = V { x, y, z };
    let n = point.n_geometric * l.f(1.0).copysign(*cos);
    let p = point.p + n * point.error;
    let mut record = Hit { p, n, colour, throughput: path.throughput, slot: path.slot };
    if surfaces.plain {
        record.push(hit & colour.max_component().above(0.0), &mut batch.hits[Stage::Plain as usize]);
        return;
    }

    let word = word.bits();
    let front = cos.above(0.0) ^ is_set(word, FLIPPED);
    let faces = hit & (front | !is_set(word, ONE_SIDED));
    let detail = vary(l, work, arrival, faces, word, &mut record);
    let detail = Detail { surface: word | front.pick(l.u(FRONT), l.u(0)), ..detail };
    let reflects = faces & record.colour.max_component().above(0.0);
    for stage in &surfaces.stages {
        let here = reflects & surface::stage(word).is(*stage as u32);
        record.push(here, &mut batch.hits[*stage as usize]);
        if *stage != Stage::Plain {
            detail.push(here, &mut batch.details[*stage as usize]);
        }
    }
}

/// What varies over the surface: sets the colour of the hit, and returns its details.
#[inline(always)]
fn vary<L: Lanes>(l: L, work: &Work, arrival: &Arrival<L>, mask: M<L>, word: U<L>, hit: &mut Hit<L>) -> Detail<L> {
    let Scene { surfaces, textures, .. } = work.scene;
    let Arrival { path, point, cos, primitive, media } = arrival;
    let [mut alpha, colour_texture, alpha_texture, medium] = l.rows(&surfaces.varying, *primitive);
    let wo = -path.d;
    let mut n = hit.n;
    if surfaces.textured || !surfaces.relief.is_empty() {
        let (u, v) = sphere_uv(point.n_geometric);
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
            alpha = rough.pick(is_set(word, SQUARED).pick(value * value, value), alpha);
        }
        if !surfaces.relief.is_empty() {
            let tilted = shading_normal(l, work.scene, l.rows(&surfaces.relief, *primitive), mask, point.n_geometric, &at);
            let tilted = tilted * l.f(1.0).copysign(*cos);
            // A normal that the viewer could not see is not used.
            n = tilted.dot(wo).above(GRAZING).pick(tilted, n);
        }
    }
    Detail { wo, n, alpha, error: point.error, surface: word, media: *media, medium: medium.bits() }
}
