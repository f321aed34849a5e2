//! Third stage: what paths meet. Adds emission and background; sorts the paths whose surface reflects by kind of bsdf.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Detail, Hit, Past, Path, Work, add},
    queue::Queue,
    weight::weight_of_met_light,
};
use crate::{
    geometry::{MISS, SurfacePoint},
    math::{F, Lanes, M, Pick, U, V},
    scene::surface::{self, FLIPPED, FRONT, ONE_SIDED, Stage, is_set},
};

/// `last`: nothing is reflected any more.
#[simd]
pub(super) fn surfaces<L: Lanes>(l: L, work: &Work, batch: &mut Batch, last: bool) {
    let scene = work.scene;
    batch.hits.iter_mut().chain(&mut batch.details).for_each(Queue::clear);
    let weighted = batch.bounce > 0 && work.samples_lights();
    let count = batch.current().len();
    for start in (0..count).step_by(L::N) {
        let live = l.first(count - start);
        let path = Path::read(l, batch.current(), start);
        let primitive = l.load(&batch.primitive[start..]).bits();
        let miss = primitive.is(MISS);
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
                if weighted {
                    let past = Past::read(l, batch.past(), start);
                    light = light * weight_of_met_light(l, work, &past, path.o, path.d, primitive);
                }
                add(&mut batch.radiance, seen, path.slot, light);
            }
        }
        if !last {
            sort(l, work, batch, &Arrival { path, point, cos, primitive }, hit);
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
}

/// Queues the paths of `hit` whose surface reflects, by kind of bsdf.
#[inline(always)]
fn sort<L: Lanes>(l: L, work: &Work, batch: &mut Batch, arrival: &Arrival<L>, hit: M<L>) {
    let Arrival { path, point, cos, primitive } = arrival;
    let [x, y, z, word] = l.rows(&work.scene.surfaces, *primitive);
    let colour = V { x, y, z };
    let n = point.n_geometric * l.f(1.0).copysign(*cos);
    let p = point.p + n * point.error;
    let reflects = hit & colour.max_component().above(0.0);
    let record = Hit { p, n, colour, throughput: path.throughput, slot: path.slot };
    if work.scene.is_plain() {
        record.push(reflects, &mut batch.hits[0]);
        return;
    }

    let word = word.bits();
    let front = cos.above(0.0) ^ is_set(word, FLIPPED);
    let reflects = reflects & (front | !is_set(word, ONE_SIDED));
    let [alpha, ..] = l.rows(&work.scene.varying, *primitive);
    let detail = Detail { wo: -path.d, n, alpha, error: point.error, surface: word | front.pick(l.u(FRONT), l.u(0)) };
    for stage in &work.scene.stages {
        let here = reflects & surface::stage(word).is(*stage as u32);
        record.push(here, &mut batch.hits[*stage as usize]);
        if *stage != Stage::Plain {
            detail.push(here, &mut batch.details[*stage as usize]);
        }
    }
}
