//! Second stage, in scenes where light passes through surfaces: finds the first surface that every path meets.
//!
//! A path meets a surface with the probability of its opacity, and goes on behind it otherwise. Everything after this stage sees the
//! surface that was met, at its distance from the origin of the path.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    queue::Register,
    records::Path,
    transparent_ray::{Decisions, MOST_CROSSINGS, TransparentRay},
    work::Work,
};
use noisefall_base::math::{F, Lanes, Pick, U};
use noisefall_scene::sampling::Dimension;

/// Moves the first surface of every path to the first one that it meets.
#[simd]
pub(super) fn meet<L: Lanes>(l: L, work: &Work, batch: &mut Batch, decisions: Decisions) {
    let Batch { paths, first_hits, crossings, bounce, rays, .. } = batch;
    let (paths, scene) = (&paths[(*bounce & 1) as usize], work.scene);
    let has_elements = scene.shapes.have_elements();
    for Register { start, live } in paths.registers(l) {
        let path = Path::read(l, &paths.paths, start);
        let first = first_hits.get(l, start, has_elements);
        let mut row = first.primitive;
        let mut transparent_ray = TransparentRay::new(l, [path.o, path.d], work.time(l, path.slot), first);
        let mut open = transparent_ray.layered(l, scene, live);
        let [opacity, part] = if open.any() { coordinates(l, work, path.slot, *bounce + 1, decisions) } else { [l.f(0.5); 2] };
        let (mut crossed, mut count) = (0, l.f(0.0));
        while open.any() {
            let crossing = transparent_ray.crossing(l, scene, open);
            let (alpha, at_crossing) = crossing.opacity(l, scene, open, decisions.of_crossing(part, crossed), decisions);
            row = open.pick(at_crossing, row);
            let passes = open & (crossing.again | !decisions.of_crossing(opacity, crossed).lt(alpha));
            if crossed == MOST_CROSSINGS || !passes.any() {
                break;
            }
            *rays += passes.count() as u64;
            transparent_ray.cross(l, scene, passes, &crossing);
            count = (passes & !crossing.again).pick(count + 1.0, count);
            row = passes.pick(transparent_ray.nearest().primitive, row);
            open = transparent_ray.layered(l, scene, passes);
            crossed += 1;
        }
        first_hits.put(start, &transparent_ray.nearest(), has_elements);
        if work.counts_crossings() {
            crossings.add(live, path.slot, count);
        }
        if work.has_blends() {
            first_hits.put_rows(start, row);
        }
    }
}

/// The random numbers at the first surface that a path crosses: whether it meets the surface, and which part of a blend.
#[inline(always)]
fn coordinates<L: Lanes>(l: L, work: &Work, slot: U<L>, surface: u32, decisions: Decisions) -> [F<L>; 2] {
    if decisions == Decisions::Middle {
        return [l.f(0.5); 2];
    }
    let surface = if decisions == Decisions::RandomFromLight { surface + Dimension::LIGHT_PATH } else { surface };
    let stream = work.stream(l, slot);
    let part = if work.has_blends() { stream.one(Dimension::blend(surface)) } else { l.f(0.5) };
    [stream.one(Dimension::opacity(surface)), part]
}
