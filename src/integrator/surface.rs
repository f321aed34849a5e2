//! Third stage: what paths meet. Adds emission and background; keeps the paths whose surface reflects.
use fearless_simd_macros::simd;

use super::batch::{Batch, Hit, Path, Work, add};
use crate::{
    geometry::MISS,
    math::{Lanes, Pick, V},
};

/// `last`: nothing is reflected any more.
#[simd]
pub(super) fn surface<L: Lanes>(l: L, work: &Work, batch: &mut Batch, last: bool) {
    let scene = work.scene;
    let Batch { paths, hits, t, primitive, radiance, bounce, .. } = batch;
    let paths = &paths[(*bounce & 1) as usize];
    hits.clear();
    for start in (0..paths.len()).step_by(L::N) {
        let live = l.first(paths.len() - start);
        let path = Path::read(l, paths, start);
        let primitive = l.load(&primitive[start..]).bits();
        let miss = primitive.is(MISS);
        if let Some(background) = scene.background {
            let sky = live & miss;
            if sky.any() {
                add(radiance, sky, path.slot, path.throughput * background.radiance);
            }
        }
        let hit = live & !miss;
        if !hit.any() {
            continue;
        }

        // Lanes without a surface look at primitive 0 and are masked out.
        let primitive = hit.pick(primitive, l.u(0));
        let t = hit.pick(l.load(&t[start..]), l.f(0.0));
        let point = scene.shapes.surface_point(l, primitive, path.o + path.d * t);
        let cos = -point.n_geometric.dot(path.d);
        if !scene.emitters.is_empty() {
            let emits = hit & scene.emitters.emits(primitive);
            if emits.any() {
                let (le, seen) = scene.emitters.radiance(l, emits, primitive, cos);
                add(radiance, seen, path.slot, path.throughput * le);
            }
        }
        if last {
            continue;
        }

        let [red, green, blue, _] = l.rows(&scene.albedo, primitive);
        let albedo = V { x: red, y: green, z: blue };
        let reflects = hit & albedo.max_component().above(0.0);
        let side = l.f(1.0).copysign(cos);
        let n = point.n_geometric * side;
        Hit { p: point.p + n * point.error, n, albedo, throughput: path.throughput, slot: path.slot }.push(reflects, hits);
    }
}
