//! Stage after shading: which light samples are seen.
//!
//! A sample counts if the first surface along its ray is the very light it was drawn from: no distance is compared, so no
//! tolerance is needed.
use fearless_simd_macros::simd;

use super::batch::{Batch, Shadow, Work, add};
use crate::math::Lanes;

#[simd]
pub(super) fn shadow<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { shadows, radiance, .. } = batch;
    for start in (0..shadows.len()).step_by(L::N) {
        let live = l.first(shadows.len() - start);
        let shadow = Shadow::read(l, shadows, start);
        let (_, primitive) = work.scene.shapes.closest(l, shadow.o, shadow.d);
        add(radiance, live & primitive.equals(shadow.target), shadow.slot, shadow.radiance);
    }
    batch.rays += shadows.len() as u64;
    shadows.clear();
}
