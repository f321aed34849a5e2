//! A pass: all tiles of a film brought to a number of samples, on all threads.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Mutex, PoisonError},
};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder, prelude::*};

use super::film::{Film, Tile};
use crate::{
    integrator::{Batch, Interrupted, Work, replay, trace},
    math::SimdLevel,
    scene::{CameraRays, RenderSettings, Reuse, Scene},
};

/// The threads that render, each with its queues.
pub struct Threads {
    pool: ThreadPool,
    batches: Vec<Mutex<Batch>>,
    level: SimdLevel,
}

/// What a pass renders.
#[derive(Clone, Copy)]
pub struct PassJob<'a> {
    pub scene: &'a Scene,
    pub rays: &'a CameraRays,
    pub settings: &'a RenderSettings,
}

/// What a pass did besides adding samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassCount {
    /// Path segments traced.
    pub rays: u64,
    /// Paths cut because they were too long.
    pub cut_paths: u64,
    /// The first invalid sample.
    pub invalid: Option<SampleId>,
    /// A sample that could not be computed at all.
    pub failure: Option<Failure>,
}

/// One sample: a pixel and a number, enough to replay it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleId {
    pub pixel: [u32; 2],
    pub sample: u32,
}

/// The renderer panicked.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The sample, or the first one of the tile where none fails alone.
    pub at: SampleId,
    /// The sample fails when it is replayed.
    pub replays: bool,
    /// Of the picture, which may have been a coarse one.
    pub resolution: [u32; 2],
    pub message: String,
}

impl Threads {
    /// `count` 0 means as many as there are cores.
    pub fn new(count: usize, level: SimdLevel) -> Result<Threads, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|i| format!("render {i}")).build()?;
        let batches = (0..pool.current_num_threads()).map(|_| Mutex::default()).collect();
        Ok(Threads { pool, batches, level })
    }

    pub fn count(&self) -> usize {
        self.batches.len()
    }

    /// Runs something on the threads of the pool.
    pub fn install<T: Send>(&self, task: impl FnOnce() -> T + Send) -> T {
        self.pool.install(task)
    }

    /// Brings every tile to `spp` samples, or stops between two bounces when `interrupted` says so. A tile that was interrupted
    /// goes on later as if nothing had happened.
    pub fn pass(&self, job: PassJob, film: &mut Film, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
        let resolution = film.resolution;
        self.pool.install(|| {
            let tiles = film.tiles.par_iter_mut();
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
        (batch.rays, batch.cut_paths) = (0, 0);
        while tile.spp < spp && !interrupted() {
            let PassJob { scene, rays, settings } = job;
            let work = Work { scene, rays, settings, origin: tile.origin, size: tile.size, sample: tile.spp };
            let traced = catch_unwind(AssertUnwindSafe(|| trace(self.level, &work, &mut batch, interrupted)));
            match traced {
                Ok(Ok(())) => {
                    let sample = tile.spp;
                    let invalid = tile.add(batch.radiance()).map(|pixel| SampleId { pixel, sample });
                    count.invalid = count.invalid.or(invalid);
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
        (count.rays, count.cut_paths) = (batch.rays, batch.cut_paths);
        count
    }
}

impl PassCount {
    pub fn merge(self, other: PassCount) -> PassCount {
        PassCount {
            rays: self.rays + other.rays,
            cut_paths: self.cut_paths + other.cut_paths,
            invalid: [self.invalid, other.invalid].into_iter().flatten().min(),
            failure: self.failure.or(other.failure),
        }
    }
}

/// The first pixel of the tile whose sample panics when it is replayed alone.
fn find_failure(work: &Work) -> Option<SampleId> {
    let [x, y] = work.origin;
    let [width, height] = work.size;
    let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| [x, y]));
    // Paths that are shared would be those of the whole tile.
    let settings = RenderSettings { reuse: Reuse::Off, ..*work.settings };
    let fails = |pixel: &[u32; 2]| {
        catch_unwind(AssertUnwindSafe(|| replay(work.scene, work.rays, &settings, *pixel, work.sample))).is_err()
    };
    { pixels }.find(fails).map(|pixel| SampleId { pixel, sample: work.sample })
}

/// What a panic said.
pub fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned())).unwrap_or_else(|| "unknown panic".to_owned())
}
