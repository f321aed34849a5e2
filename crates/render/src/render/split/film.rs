//! A film of a range of samples.
use std::ops::Range;

use rayon::prelude::*;

use super::{
    ranges::SampleRanges,
    sums::{TileSums, TooManySamples},
};
use crate::render::{
    adaptive,
    area::Area,
    block::{UNIFORM, goal},
    exact_sum::{ExactSums, MOST_VALUES},
    film::Film,
    pass::{PassCount, SampleId},
    sampled_tile::{NextSamples, SampledTile},
    splats::SplatFilm,
    threads::{PassJob, Threads},
    tile::Tile,
};
use noisefall_base::{
    math::SimdLevel,
    memory::{self, Reservation, TooMuch},
};
use noisefall_kernel::integrator::{BLOCK, Interrupted, Splat, Thresholds};
use noisefall_scene::sampling::Filter;

/// Why a film of samples cannot be begun.
#[derive(Debug, thiserror::Error)]
pub enum SplitError {
    /// The indices are too large.
    #[error(transparent)]
    TooManySamples(#[from] TooManySamples),
    /// There is too little memory.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// It was interrupted.
    #[error("interrupted")]
    Interrupted,
}

/// Exact sums of a range of samples of every pixel.
///
/// With adaptive sampling, the range is one of the average: a block whose samples are twice the average takes the samples 2A to 2B
/// of the range A to B. The rates come from the pilot, which is the same for every range.
pub struct SampleFilm {
    tiles: Vec<RangeTile>,
    samples: Range<u32>,
    count: PassCount,
    /// Radiance that light paths add to the pixels, if the estimator traces any.
    splats: Option<SplatFilm>,
    _memory: [Option<Reservation>; 2],
}

/// A tile, and how far it is.
struct RangeTile {
    sums: TileSums,
    /// Exponents of the blocks' rates; empty if all have one sample per sample of the average.
    rates: Vec<i8>,
    start: u32,
    /// Of outliers, once they are known.
    thresholds: Option<Thresholds>,
}

impl SampleFilm {
    /// Reserves memory for films of this size.
    pub(super) fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Bytes per pixel: six sums, those of blocks, and a threshold.
        const PIXEL: u64 = 6 * ExactSums::BYTES + 2 + 4;
        memory::reserve(format_args!("exact sums of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// An empty film for the samples from `start` up to at most `end`.
    pub fn begin(
        threads: &Threads,
        job: PassJob,
        Range { start, end }: Range<u32>,
        interrupted: &(dyn Fn() -> bool + Sync),
    ) -> Result<SampleFilm, SplitError> {
        let resolution = job.rays.resolution;
        let memory = SampleFilm::reserve(resolution)?;
        let traces_light_paths = job.scene.traces_light_paths(job.settings);
        let of_splats = traces_light_paths.then(|| SplatFilm::reserve(resolution)).transpose()?;
        let mut plan = Film::new(resolution);
        if end > UNIFORM {
            let spread = adaptive::spread(threads, job, &mut plan, interrupted);
            spread.map_err(|Interrupted| SplitError::Interrupted)?;
        }
        let is_adaptive = plan.is_adaptive();
        let tile = |tile: &Tile| RangeTile {
            sums: TileSums::new(tile.area()),
            rates: tile.blocks.iter().filter(|_| is_adaptive).map(|block| block.rate).collect(),
            start,
            thresholds: None,
        };
        let tiles: Vec<RangeTile> = plan.tiles.iter().map(tile).collect();
        if tiles.iter().any(|tile| tile.most_samples(end) > MOST_VALUES) {
            return Err(TooManySamples.into());
        }
        let splats = traces_light_paths.then(|| SplatFilm::new(resolution));
        Ok(SampleFilm { tiles, samples: start..start, count: PassCount::default(), splats, _memory: [Some(memory), of_splats] })
    }

    /// Adds the samples up to `end`, excluded. An interrupted film lacks some of them, and can only continue.
    pub fn advance(&mut self, threads: &Threads, job: PassJob, end: u32, interrupted: &(dyn Fn() -> bool + Sync)) {
        let resolution = job.rays.resolution;
        let tiles = self.tiles.par_iter_mut().with_max_len(1);
        let splats = self.splats.as_ref().map(|film| (film, job.rays.filter));
        let sample = |tile| threads.sample_tile(job, resolution, &mut Towards { tile, end, splats }, interrupted);
        let count = threads.install(|| tiles.map(sample).reduce(PassCount::default, PassCount::merge));
        self.count = std::mem::take(&mut self.count).merge(count);
        self.samples.end = end;
        if let Some(splats) = &self.splats {
            self.tiles[0].sums.invalid += splats.take_invalid();
            self.tiles.iter_mut().enumerate().for_each(|(place, tile)| tile.sums.splats = Some(splats.tile(place)));
        }
    }

    /// The samples that it has.
    pub fn samples(&self) -> SampleRanges {
        SampleRanges::of(&[[self.samples.start, self.samples.end]]).unwrap_or_default()
    }

    /// Figures of its passes.
    pub fn count(&self) -> &PassCount {
        &self.count
    }

    /// Number of samples over all pixels.
    pub fn paths(&self) -> u64 {
        let paths = |tile: &RangeTile| {
            let counts = tile.sums.counts.iter().enumerate();
            counts.map(|(block, count)| u64::from(*count) * tile.sums.area.block_pixels(block)).sum::<u64>()
        };
        self.tiles.iter().map(paths).sum()
    }

    /// The sums of the tiles, row by row from the top left.
    pub fn sums(&self) -> impl ExactSizeIterator<Item = &TileSums> {
        self.tiles.iter().map(|tile| &tile.sums)
    }

    /// Returns the sums of the tiles. Each tile is freed as soon as it is dropped.
    pub fn into_sums(self) -> impl Iterator<Item = TileSums> {
        self.tiles.into_iter().map(|tile| tile.sums)
    }
}

impl RangeTile {
    /// The ranges of samples that the blocks lack for the average `end`.
    fn left(&self, end: u32) -> impl Iterator<Item = Range<u32>> + Clone {
        let rates = self.rates.iter().zip(&self.sums.counts);
        rates.map(move |(rate, count)| goal(*rate, self.start) + count..goal(*rate, end))
    }

    fn most_samples(&self, end: u32) -> u32 {
        let uniform = end - self.start;
        self.rates.iter().map(|rate| goal(*rate, end) - goal(*rate, self.start)).max().unwrap_or(uniform)
    }
}

/// A tile on its way to the end of a range.
struct Towards<'a> {
    tile: &'a mut RangeTile,
    end: u32,
    splats: Option<(&'a SplatFilm, Filter)>,
}

impl SampledTile for Towards<'_> {
    fn area(&self) -> Area {
        self.tile.sums.area
    }

    fn thresholds(&mut self) -> &mut Option<Thresholds> {
        &mut self.tile.thresholds
    }

    fn next(&self) -> Option<NextSamples> {
        if self.tile.rates.is_empty() {
            let next = self.tile.start + self.tile.sums.counts[0];
            return (next < self.end).then_some(NextSamples::OfTile(next));
        }
        let left = self.tile.left(self.end);
        left.clone().any(|left| !left.is_empty()).then(|| NextSamples::OfBlocks(Box::new(self.tile.sums.area.batch(&left))))
    }

    fn splat(&self, splats: &[Splat]) {
        if let Some((film, filter)) = self.splats {
            film.add(filter, splats);
        }
    }

    fn add(&mut self, level: SimdLevel, samples: &NextSamples, radiance: &[[f32; 4]]) -> Option<SampleId> {
        let sums = &mut self.tile.sums;
        match samples {
            NextSamples::OfTile(sample) => sums.add(level, radiance).map(|pixel| SampleId { pixel, sample: *sample }),
            NextSamples::OfBlocks(blocks) => {
                let mut invalid = None;
                for ((corner, sample), slots) in blocks.iter().zip(radiance.chunks((BLOCK * BLOCK) as usize)) {
                    let found = sums.add_block(level, sums.area.block_at(corner), slots);
                    invalid = invalid.or(found.map(|pixel| SampleId { pixel, sample }));
                }
                invalid
            }
        }
    }
}
