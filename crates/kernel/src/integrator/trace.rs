//! The path loop: runs a batch through the stages, bounce by bounce, until no path is left.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    interrupted::Interrupted,
    intersect::intersect,
    queues::HitQueues,
    records::Path,
    reuse::share,
    shade::shade,
    shadow::shadow,
    slots::{BLOCK, BLOCKS, TILE},
    spawn::spawn,
    surface::surfaces,
    transparent_ray::Decisions,
    work::Work,
};
use noisefall_base::math::{Lanes, One, SimdLevel, in_lanes};
use noisefall_scene::material::in_stage;

/// Observes a batch between the stages; `()` does nothing.
pub trait Observer {
    /// Called after the surface stage: paths at reflecting surfaces are queued.
    fn at_surfaces(&mut self, _work: &Work, _batch: &Batch) {}

    /// Called after shading: light samples and the paths of the next bounce are queued. Faults of tests change the paths.
    fn at_shaded(&mut self, _work: &Work, _batch: &mut Batch) {}

    /// Called when all paths have ended, before pixels share them.
    fn before_reuse(&mut self, _work: &Work, _batch: &mut Batch) {}

    /// Called after each stage.
    fn after(&mut self, _stage: PathStage, _batch: &Batch) {}
}

/// A stage of the path loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathStage {
    /// Generates camera rays.
    Spawn,
    /// Finds the first surface of every path.
    Intersect,
    /// Evaluates the surfaces, and adds emission and background.
    Surface,
    /// Samples a light and the next direction.
    Shade,
    /// Traces shadow rays.
    Shadow,
    /// Reuses paths and outliers between pixels.
    Reuse,
}

impl Observer for () {}

/// Traces one sample of every pixel of a tile by camera paths; the result is [`Batch::radiance`]. Calls `interrupted` before every
/// bounce, and in the reuse stage.
///
/// The estimate is the sum over bounces k of throughput × emitted radiance at the k-th surface: the rendering equation (Kajiya
/// 1986, equation 1), with one sampled direction in place of the integral at every surface. Light samples replace the emission at
/// the next surface or are combined with it by multiple importance sampling (Veach 1997, chapter 9).
pub fn trace_alone(level: SimdLevel, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
    in_lanes!(level, l => trace_in(l, work, batch, interrupted, &mut ()))
}

/// Number of path segments, without shadow rays, per block of the tile.
#[derive(Default)]
pub struct Segments(pub [u32; BLOCKS]);

impl Observer for Segments {
    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        const ACROSS: u32 = TILE / BLOCK;
        let paths = batch.current();
        for at in 0..paths.len() {
            let (x, y) = work.place(Path::read(One, &paths.paths, at).slot);
            self.0[(y.0 / BLOCK * ACROSS + x.0 / BLOCK) as usize] += 1;
        }
    }
}

/// Traces one sample of every pixel of a tile by camera paths, and counts the path segments of its blocks.
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
    observer.after(PathStage::Spawn, batch);
    while !batch.current().is_empty() {
        if interrupted() {
            return Err(Interrupted);
        }
        let last = batch.bounce == last_bounce;
        intersect(l, work, batch, Decisions::Random);
        observer.after(PathStage::Intersect, batch);
        if work.scene.is_plain() {
            surfaces::<L, false>(l, work, batch, last && !cut_short);
        } else {
            surfaces::<L, true>(l, work, batch, last && !cut_short);
        }
        observer.after(PathStage::Surface, batch);
        observer.at_surfaces(work, batch);
        if last {
            batch.cut_paths += if cut_short { batch.hits.iter().map(HitQueues::len).sum::<usize>() as u64 } else { 0 };
            break;
        }
        shade_all(l, work, batch);
        observer.after(PathStage::Shade, batch);
        observer.at_shaded(work, batch);
        if work.samples_lights() {
            shadow(l, work, batch);
            observer.after(PathStage::Shadow, batch);
        }
        batch.bounce += 1;
    }
    observer.before_reuse(work, batch);
    if work.shares() && work.replays.is_none() {
        if !share(l, work, batch, interrupted) {
            return Err(Interrupted);
        }
        observer.after(PathStage::Reuse, batch);
    }
    Ok(())
}

/// Runs the shading stages of the scene.
#[inline(always)]
fn shade_all<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    batch.paths[((batch.bounce + 1) & 1) as usize].clear();
    for stage in &work.scene.surfaces.stages {
        in_stage!(stage, K => shade::<L, K>(l, work, batch));
    }
}
