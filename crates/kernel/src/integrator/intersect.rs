//! Second stage: finds x_M, the first surface that every path meets. A separate instance is compiled for scenes of spheres alone.
use fearless_simd_macros::simd;

use super::{batch::Batch, meet::meet, queue::Register, records::Path, transparent_ray::Decisions, work::Work};
use noisefall_base::math::Lanes;

#[inline(always)]
pub(super) fn intersect<L: Lanes>(l: L, work: &Work, batch: &mut Batch, decisions: Decisions) {
    if work.scene.shapes.are_spheres() {
        intersect_with::<L, true>(l, work, batch);
    } else {
        intersect_with::<L, false>(l, work, batch);
    }
    if work.has_passages() {
        meet(l, work, batch, decisions);
    }
}

#[simd]
fn intersect_with<L: Lanes, const SPHERES: bool>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { paths, first_hits, bounce, rays, .. } = batch;
    let (paths, shapes) = (&paths[(*bounce & 1) as usize], &work.scene.shapes);
    for Register { start, live } in paths.registers(l) {
        let path = Path::read(l, &paths.paths, start);
        let nearest = if SPHERES {
            shapes.closest_sphere(l, path.o, path.d)
        } else {
            shapes.closest(l, live, path.o, path.d, work.time(l, path.slot))
        };
        first_hits.put(start, &nearest, !SPHERES && shapes.have_elements());
    }
    *rays += paths.len() as u64;
}
