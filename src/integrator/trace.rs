//! The path loop: a batch runs bounce by bounce through the stages until no path is left.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, Path},
    intersect::intersect,
    kinds::in_kind,
    queue::Queue,
    reuse::share,
    shade::shade,
    shadow::shadow,
    spawn::spawn,
    surface::surfaces,
    work::{BLOCK, BLOCKS, TILE, Work},
};
use crate::{
    in_lanes,
    math::{Lanes, One, SimdLevel},
};

/// Looks at a batch between the stages; `()` does not.
pub trait Observer {
    /// Every path has met its surface and what reflects is queued.
    fn at_surfaces(&mut self, _work: &Work, _batch: &Batch) {}

    /// What reflects is shaded: light samples and the paths of the next bounce are queued.
    fn at_shaded(&mut self, _work: &Work, _batch: &Batch) {}
}

impl Observer for () {}

/// The batch was interrupted: its radiance is worthless.
#[derive(Debug, PartialEq, Eq)]
pub struct Interrupted;

/// Traces one sample of every pixel of a tile; the result is [`Batch::radiance`]. `interrupted` is asked before every bounce.
///
/// The estimate is the sum over bounces k of throughput × emitted radiance at the k-th surface, which is the light transport
/// equation with its integral replaced, again and again, by one sampled direction (Kajiya 1986; equation (9) of the brief).
pub fn trace(level: SimdLevel, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
    in_lanes!(level, l => trace_in(l, work, batch, interrupted, &mut ()))
}

/// Path segments, by block of the tile.
#[derive(Default)]
pub struct Segments(pub [u32; BLOCKS]);

impl Observer for Segments {
    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        const ACROSS: u32 = TILE / BLOCK;
        let paths = batch.current();
        for at in 0..paths.len() {
            let (x, y) = work.place(Path::read(One, paths, at).slot);
            self.0[(y.0 / BLOCK * ACROSS + x.0 / BLOCK) as usize] += 1;
        }
    }
}

/// [`trace`] of a tile, which also says how long the paths of its blocks are.
pub fn trace_counting(
    level: SimdLevel,
    work: &Work,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
) -> Result<Segments, Interrupted> {
    let mut segments = Segments::default();
    in_lanes!(level, l => trace_in(l, work, batch, interrupted, &mut segments))?;
    Ok(segments)
}

#[simd]
pub(super) fn trace_in<L: Lanes, O: Observer>(
    l: L,
    work: &Work,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
    observer: &mut O,
) -> Result<(), Interrupted> {
    let last_bounce = work.settings.last_bounce();
    let cut_short = work.settings.max_bounces != Some(last_bounce);
    spawn(l, work, batch);
    while !batch.current().is_empty() {
        if interrupted() {
            return Err(Interrupted);
        }
        let last = batch.bounce == last_bounce;
        intersect(l, work, batch);
        if work.scene.is_plain() {
            surfaces::<L, false>(l, work, batch, last && !cut_short);
        } else {
            surfaces::<L, true>(l, work, batch, last && !cut_short);
        }
        observer.at_surfaces(work, batch);
        if last {
            batch.cut_paths += if cut_short { batch.hits.iter().map(Queue::len).sum::<usize>() as u64 } else { 0 };
            break;
        }
        shade_all(l, work, batch);
        observer.at_shaded(work, batch);
        if work.samples_lights() {
            shadow(l, work, batch);
        }
        batch.bounce += 1;
    }
    if work.shares() {
        share(l, work, batch);
    }
    Ok(())
}

/// The shading stages that the scene has.
#[inline(always)]
fn shade_all<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    let next = ((batch.bounce + 1) & 1) as usize;
    batch.paths[next].clear();
    batch.pasts[next].clear();
    batch.glosses[next].clear();
    batch.path_media[next].clear();
    for stage in &work.scene.surfaces.stages {
        in_kind!(stage, K => shade::<L, K>(l, work, batch));
    }
}
