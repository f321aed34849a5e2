//! Second stage: finds x_M, the first surface along every path. A separate instance is compiled for scenes of spheres alone.
use fearless_simd_macros::simd;

use super::{batch::Batch, records::Path, work::Work};
use crate::math::Lanes;

#[inline(always)]
pub(super) fn intersect<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    if work.scene.shapes.are_spheres() {
        intersect_with::<L, true>(l, work, batch);
    } else {
        intersect_with::<L, false>(l, work, batch);
    }
}

#[simd]
fn intersect_with<L: Lanes, const SPHERES: bool>(l: L, work: &Work, batch: &mut Batch) {
    let paths = &batch.paths[(batch.bounce & 1) as usize];
    for start in (0..paths.len()).step_by(L::N) {
        let path = Path::read(l, paths, start);
        let live = l.first(paths.len() - start);
        let nearest = if SPHERES {
            work.scene.shapes.closest_sphere(l, path.o, path.d)
        } else {
            work.scene.shapes.closest(l, live, path.o, path.d, work.time(l, path.slot))
        };
        nearest.t.store(&mut batch.t[start..]);
        nearest.primitive.as_real_bits().store(&mut batch.primitive[start..]);
        if !SPHERES && work.scene.shapes.have_elements() {
            nearest.element.as_real_bits().store(&mut batch.element[start..]);
        }
    }
    batch.rays += paths.len() as u64;
}
