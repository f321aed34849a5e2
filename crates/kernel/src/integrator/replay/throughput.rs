//! The throughput of a path for its own pixel. In the queues, paths that pixels share lack the albedo of their first surface.
use crate::integrator::{batch::Batch, records::Path, slots::SLOTS, work::Work};
use noisefall_base::math::{One, U};

pub(super) const BLACK: [f32; 3] = [0.0; 3];
pub(super) const WHITE: [f32; 3] = [1.0; 3];

/// The throughput of a path before a bounce.
pub(super) fn of(work: &Work, batch: &Batch, bounce: u32, path: &Path<One>) -> [f32; 3] {
    let throughput = path.throughput.lane(0);
    if bounce == 1 && work.shares() {
        return batch.shared.weighted(path.slot.0 as usize, throughput);
    }
    own(batch, path.slot, throughput)
}

/// The contribution of a slot to the path's own pixel.
pub(super) fn own(batch: &Batch, slot: U<One>, colour: [f32; 3]) -> [f32; 3] {
    let slot = slot.0 as usize;
    if slot < SLOTS { colour } else { batch.shared.weighted(slot - SLOTS, colour) }
}
