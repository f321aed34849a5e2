//! Takes the samples of one tile on one thread.
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::{
    area::Area,
    pass_count::{Failure, PassCount, SampleId, panic_message},
    threads::{Buffers, PassJob, Threads},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Blocks, Interrupted, Splat, Thresholds, Work, replay, thresholds, trace};
use noisefall_scene::scene::{RenderSettings, Reuse};

/// The next samples of a tile.
pub enum NextSamples {
    /// The sample with this index of all its pixels.
    OfTile(u32),
    /// Samples of some of its blocks.
    OfBlocks(Box<Blocks>),
}

/// A tile that takes samples.
pub trait SampledTile {
    /// Where it lies.
    fn area(&self) -> Area;

    /// The next samples; `None` at the goal.
    fn next(&self) -> Option<NextSamples>;

    /// The thresholds of its outliers, once they are known.
    fn thresholds(&mut self) -> &mut Option<Thresholds>;

    /// Traces samples.
    fn trace(
        &mut self,
        level: SimdLevel,
        work: &Work,
        buffers: &mut Buffers,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<(), Interrupted> {
        trace(level, work, &mut buffers.batch, interrupted)
    }

    /// Adds samples: see [`noisefall_kernel::integrator::Batch::radiance`]. Returns the first that is invalid.
    fn add(&mut self, level: SimdLevel, samples: &NextSamples, radiance: &[[f32; 4]]) -> Option<SampleId>;

    /// Adds what the light paths of these samples bring to any pixel.
    fn splat(&self, _splats: &[Splat]) {}
}

impl Threads {
    /// Brings a tile to its goal, or stops within a sample if `interrupted` returns true. The tile is then as if the samples that were being
    /// traced had not begun.
    pub(super) fn sample_tile(
        &self,
        job: PassJob,
        resolution: [u32; 2],
        tile: &mut impl SampledTile,
        interrupted: &dyn Fn() -> bool,
    ) -> PassCount {
        let PassJob { scene, rays, settings } = job;
        let Area { origin, size } = tile.area();
        let mut count = PassCount::default();
        let mut buffers = self.buffers.get();
        (buffers.batch.rays, buffers.batch.cut_paths) = (0, 0);
        let mut known = tile.thresholds().take();
        while let Some(samples) = tile.next().filter(|_| !interrupted()) {
            let work = match &samples {
                NextSamples::OfTile(sample) => Work::tile(scene, rays, settings, origin, size, *sample),
                NextSamples::OfBlocks(blocks) => {
                    Work { blocks: Some(blocks), ..Work::tile(scene, rays, settings, origin, size, 0) }
                }
            };
            let is_whole = matches!(samples, NextSamples::OfTile(_));
            let traced = catch_unwind(AssertUnwindSafe(|| {
                if is_whole && known.is_none() {
                    known = thresholds(self.level, &work, &mut buffers.batch, interrupted)?;
                }
                let thresholds = known.as_ref().filter(|_| is_whole);
                tile.trace(self.level, &Work { thresholds, ..work }, &mut buffers, interrupted)
            }));
            match traced {
                Ok(Ok(())) => {
                    tile.splat(&buffers.batch.splats);
                    count.invalid = count.invalid.or(tile.add(self.level, &samples, buffers.batch.radiance()));
                }
                Ok(Err(Interrupted)) => break,
                Err(panic) => {
                    let alone = find_failure(&work);
                    count.failure = Some(Failure {
                        at: alone.unwrap_or(SampleId { pixel: work.origin, sample: work.sample }),
                        replays: alone.is_some(),
                        resolution,
                        message: panic_message(&*panic),
                    });
                    break;
                }
            }
        }
        *tile.thresholds() = known;
        (count.rays, count.cut_paths) = (buffers.batch.rays, buffers.batch.cut_paths);
        count
    }
}

/// The first sample of the work that panics when it is replayed alone.
fn find_failure(work: &Work) -> Option<SampleId> {
    let samples = |([left, top], [width, height], sample): ([u32; 2], [u32; 2], u32)| {
        let pixels = (top..top + height).flat_map(move |y| (left..left + width).map(move |x| [x, y]));
        pixels.map(move |pixel| SampleId { pixel, sample })
    };
    // Paths that are shared would be those of the whole tile.
    let settings = RenderSettings { reuse: Reuse::Off, ..*work.settings };
    let fails =
        |at: &SampleId| catch_unwind(AssertUnwindSafe(|| replay(work.scene, work.rays, &settings, at.pixel, at.sample))).is_err();
    work.parts().into_iter().flat_map(samples).find(fails)
}
