//! A pass: brings all tiles of a film to a number of samples, on all threads.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

pub use super::pass_count::{Failure, PassCount, SampleId, panic_message};
use super::{
    adaptive,
    area::Area,
    block::UNIFORM,
    error_estimator,
    exact_sum::MOST_VALUES,
    film::Film,
    sampled_tile::{NextSamples, SampledTile},
    splats::SplatFilm,
    threads::{Buffers, PassJob, Threads},
    tile::Tile,
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Interrupted, Splat, Thresholds, Work, trace, trace_series};
use noisefall_scene::sampling::Filter;

impl Threads {
    /// Brings a film to `spp` samples per pixel, or stops within a sample if `interrupted` returns true. An interrupted tile continues
    /// later as if nothing had happened.
    pub fn pass(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        if spp > UNIFORM {
            // A pilot that fails is given up: the samples of the image will fail as well, and it is known which.
            let spread = catch_unwind(AssertUnwindSafe(|| adaptive::spread(self, job, film, interrupted)));
            if matches!(spread, Ok(Err(Interrupted))) {
                return PassCount::default();
            }
        }
        if job.scene.traces_light_paths(job.settings) && !film.has_series() {
            film.keep_splats();
        }
        film.path_reuse = job.scene.path_reuse(job.rays, job.settings);
        let mut count = PassCount::default();
        loop {
            let next = next_meeting(film, spp);
            count = count.merge(self.to_meeting(job, film, next, interrupted));
            if next == spp || !film.tiles_in_focus().all(|tile| tile.spp >= next) {
                return count;
            }
        }
    }

    /// Brings a film to `spp` samples per pixel, from doubling to doubling of the samples of its blocks.
    fn to_meeting(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        // All tiles meet where their samples have doubled, for how far they have moved is seen over the whole image.
        let mut count = PassCount::default();
        loop {
            if film.awaits_error_record {
                film.awaits_error_record = !self.pool.install(|| error_estimator::note(film, interrupted));
                if film.awaits_error_record || film.tiles_in_focus().all(|tile| tile.spp >= spp) {
                    return count;
                }
            }
            count = count.merge(self.sample_tiles(job, film, spp, interrupted));
            // After an interruption some blocks may be ahead. What is recorded of them waits until all have doubled.
            let is_there = film.tiles_in_focus().all(|tile| tile.has_reached(spp));
            let is_done = film.tiles_in_focus().all(|tile| tile.distance_to(spp) == 0);
            film.awaits_error_record = is_there && !(is_done && film.tiles_in_focus().any(|tile| tile.is_ahead_of(spp)));
            if !film.awaits_error_record {
                return count;
            }
        }
    }

    /// Brings a film to `spp` samples per pixel, or to the next power of two.
    fn sample_tiles(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        let resolution = film.resolution;
        let splats = film.splats.take();
        let mut tiles: Vec<&mut Tile> = film.tiles_in_focus().filter(|tile| tile.spp < spp).collect();
        // Tiles that take long begin first, or else one thread would be left with one in the end.
        tiles.sort_by_cached_key(|tile| std::cmp::Reverse(tile.distance_to(spp)));
        let count = self.pool.install(|| {
            let tiles = tiles.into_par_iter().with_max_len(1);
            let sample = |tile: &mut Tile| {
                let splats = splats.as_ref().map(|film| (film, job.rays.filter));
                let count = self.sample_tile(job, resolution, &mut TileInPass { tile, spp, splats }, interrupted);
                if tile.is_adaptive() {
                    tile.note_average(spp);
                }
                count
            };
            tiles.map(sample).reduce(PassCount::default, PassCount::merge)
        });
        let is_full = splats.as_ref().is_some_and(SplatFilm::is_full);
        let count = if is_full { count.merge(full(resolution)) } else { count };
        film.splats = splats;
        self.pool.install(|| film.spread_splats());
        count
    }
}

/// The failure of a film whose pixels can take no more light.
fn full(resolution: [u32; 2]) -> PassCount {
    let message =
        format!("a pixel has light of {MOST_VALUES} batches of light paths, the most that its sums can take: stop earlier");
    let failure = Failure { at: SampleId { pixel: [0, 0], sample: 0 }, replays: false, resolution, message };
    PassCount { failure: Some(failure), ..PassCount::default() }
}

/// A tile of the film on its way to a number of samples per pixel, or to the next power of two.
struct TileInPass<'a> {
    tile: &'a mut Tile,
    spp: u32,
    splats: Option<(&'a SplatFilm, Filter)>,
}

impl SampledTile for TileInPass<'_> {
    fn area(&self) -> Area {
        self.tile.area()
    }

    fn next(&self) -> Option<NextSamples> {
        let TileInPass { tile, spp, .. } = self;
        let next = || {
            if tile.is_adaptive() { NextSamples::OfBlocks(Box::new(tile.missing(*spp))) } else { NextSamples::OfTile(tile.spp) }
        };
        (!tile.has_reached(*spp)).then(next)
    }

    fn thresholds(&mut self) -> &mut Option<Thresholds> {
        &mut self.tile.thresholds
    }

    fn trace(
        &mut self,
        level: SimdLevel,
        work: &Work,
        Buffers { batch, terms }: &mut Buffers,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<(), Interrupted> {
        match &mut self.tile.series {
            None => trace(level, work, batch, interrupted),
            Some(series) => {
                trace_series(level, work, batch, interrupted, terms).map(|()| series.add(self.tile.size, terms, batch.radiance()))
            }
        }
    }

    fn splat(&self, splats: &[Splat]) {
        if let Some((film, filter)) = self.splats {
            film.add(filter, splats);
        }
    }

    fn add(&mut self, _: SimdLevel, samples: &NextSamples, radiance: &[[f32; 4]]) -> Option<SampleId> {
        match samples {
            NextSamples::OfTile(sample) => self.tile.add(radiance).map(|pixel| SampleId { pixel, sample: *sample }),
            NextSamples::OfBlocks(blocks) => {
                self.tile.add_blocks(blocks, radiance).map(|(pixel, sample)| SampleId { pixel, sample })
            }
        }
    }
}

/// Where all blocks of an adaptive film meet on the way to `spp`: what is recorded of their noise depends on the samples that all have
/// by then, which must not depend on how the way is cut into passes.
fn next_meeting(film: &mut Film, spp: u32) -> u32 {
    let least = film.tiles_in_focus().map(|tile| tile.spp).min().unwrap_or(spp);
    if film.is_adaptive() { least.saturating_add(1).checked_next_power_of_two().map_or(spp, |next| next.min(spp)) } else { spp }
}
