//! Second stage: x_M, the first surface along every path.
use fearless_simd_macros::simd;

use super::batch::{Batch, Path, Work};
use crate::math::Lanes;

#[simd]
pub(super) fn intersect<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let paths = &batch.paths[(batch.bounce & 1) as usize];
    for start in (0..paths.len()).step_by(L::N) {
        let path = Path::read(l, paths, start);
        let (t, primitive) = work.scene.shapes.closest(l, path.o, path.d);
        t.store(&mut batch.t[start..]);
        primitive.as_real_bits().store(&mut batch.primitive[start..]);
    }
    batch.rays += paths.len() as u64;
}
