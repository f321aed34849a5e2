//! A pass: brings all tiles of a film to a number of samples, on all threads.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::PoisonError,
};

use rayon::prelude::*;

use super::{
    adaptive,
    block::UNIFORM,
    error_estimator,
    film::Film,
    threads::{PassJob, Threads},
    tile::Tile,
};
use crate::{
    integrator::{Interrupted, Work, replay, trace, trace_series},
    scene::{RenderSettings, Reuse},
};

/// Figures of a pass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassCount {
    /// Rays traced: path segments, shadow rays and visibility rays of path reuse.
    pub rays: u64,
    /// Paths cut because they were too long.
    pub cut_paths: u64,
    /// The first invalid sample.
    pub invalid: Option<SampleId>,
    /// A sample whose computation failed.
    pub failure: Option<Failure>,
}

/// Identifies one sample by its pixel and index, for a replay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleId {
    /// Column and row from the top left.
    pub pixel: [u32; 2],
    /// Index of the sample within the pixel.
    pub sample: u32,
}

/// The renderer panicked.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The sample, or the first one of the tile if none fails alone.
    pub at: SampleId,
    /// Whether the sample fails when it is replayed.
    pub replays: bool,
    /// Resolution of the image, which may have been a coarse one.
    pub resolution: [u32; 2],
    /// The message of the panic.
    pub message: String,
}

impl Threads {
    /// Brings a film to `spp` samples per pixel, or stops between two bounces if `interrupted` returns true. An interrupted tile
    /// continues later as if nothing had happened.
    pub fn pass(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        if spp > UNIFORM {
            // A pilot that fails is given up: the samples of the picture will fail as well, and it is known which.
            let spread = catch_unwind(AssertUnwindSafe(|| adaptive::spread(self, job, film, interrupted)));
            if matches!(spread, Ok(Err(Interrupted))) {
                return PassCount::default();
            }
        }
        film.shares |= job.scene.shares(job.rays, job.settings);
        let mut count = PassCount::default();
        loop {
            let next = next_stop(film, spp);
            count = count.merge(self.to_stop(job, film, next, interrupted));
            if next == spp || !film.tiles_in_focus().all(|tile| tile.spp >= next) {
                return count;
            }
        }
    }

    /// Brings a film to `spp` samples per pixel, from doubling to doubling of the samples of its blocks.
    fn to_stop(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        // All tiles meet where their samples have doubled, for how far they have moved is seen over the whole picture.
        let mut count = PassCount::default();
        loop {
            if film.is_noting {
                film.is_noting = !self.pool.install(|| error_estimator::note(film, interrupted));
                if film.is_noting || film.tiles_in_focus().all(|tile| tile.spp >= spp) {
                    return count;
                }
            }
            count = count.merge(self.to_next_doubling(job, film, spp, interrupted));
            // After an interruption some blocks may be ahead. What is recorded of them waits until all have doubled.
            let is_there = film.tiles_in_focus().all(|tile| tile.has_reached(spp));
            let is_done = film.tiles_in_focus().all(|tile| tile.distance_to(spp) == 0);
            film.is_noting = is_there && !(is_done && film.tiles_in_focus().any(|tile| tile.is_ahead_of(spp)));
            if !film.is_noting {
                return count;
            }
        }
    }

    /// Brings a film to `spp` samples per pixel, or to the next power of two.
    fn to_next_doubling(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        let resolution = film.resolution;
        let mut tiles: Vec<&mut Tile> = film.tiles_in_focus().filter(|tile| tile.spp < spp).collect();
        // What takes long begins first, or else one thread would be left with it in the end.
        tiles.sort_by_cached_key(|tile| std::cmp::Reverse(tile.distance_to(spp)));
        self.pool.install(|| {
            let tiles = tiles.into_par_iter().with_max_len(1);
            tiles.map(|tile| self.tile_to(job, resolution, tile, spp, interrupted)).reduce(PassCount::default, PassCount::merge)
        })
    }

    fn tile_to(
        &self,
        job: PassJob,
        resolution: [u32; 2],
        tile: &mut Tile,
        spp: u32,
        interrupted: &dyn Fn() -> bool,
    ) -> PassCount {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let mut count = PassCount::default();
        let mut batch = self.batches[thread].lock().unwrap_or_else(PoisonError::into_inner);
        let mut terms = self.terms[thread].lock().unwrap_or_else(PoisonError::into_inner);
        (batch.rays, batch.cut_paths) = (0, 0);
        while !tile.has_reached(spp) && !interrupted() {
            let PassJob { scene, rays, settings } = job;
            let blocks = tile.is_adaptive().then(|| tile.missing(spp));
            let whole = Work::tile(scene, rays, settings, tile.origin, tile.size, tile.spp);
            let work = Work { blocks: blocks.as_ref(), ..whole };
            let traced = catch_unwind(AssertUnwindSafe(|| match &mut tile.series {
                None => trace(self.level, &work, &mut batch, interrupted),
                Some(series) => trace_series(self.level, &work, &mut batch, interrupted, &mut terms)
                    .map(|()| series.add(tile.size, &terms, batch.radiance())),
            }));
            match traced {
                Ok(Ok(())) => {
                    let sample = tile.spp;
                    let invalid = match &blocks {
                        Some(blocks) => tile.add_blocks(blocks, batch.radiance()),
                        None => tile.add(batch.radiance()).map(|pixel| (pixel, sample)),
                    };
                    count.invalid = count.invalid.or(invalid.map(|(pixel, sample)| SampleId { pixel, sample }));
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
        if tile.is_adaptive() {
            tile.note_average(spp);
        }
        (count.rays, count.cut_paths) = (batch.rays, batch.cut_paths);
        count
    }
}

impl PassCount {
    /// The figures of both passes together.
    pub fn merge(self, other: PassCount) -> PassCount {
        PassCount {
            rays: self.rays + other.rays,
            cut_paths: self.cut_paths + other.cut_paths,
            invalid: [self.invalid, other.invalid].into_iter().flatten().min(),
            failure: self.failure.or(other.failure),
        }
    }
}

/// Where all blocks of an adaptive film meet on the way to `spp`: what is recorded of their noise depends on the samples that all have
/// by then, which must not depend on how the way is cut into passes.
fn next_stop(film: &mut Film, spp: u32) -> u32 {
    let least = film.tiles_in_focus().map(|tile| tile.spp).min().unwrap_or(spp);
    if film.is_adaptive() { least.saturating_add(1).checked_next_power_of_two().map_or(spp, |next| next.min(spp)) } else { spp }
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

/// The message of a panic.
pub fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned())).unwrap_or_else(|| "unknown panic".to_owned())
}
