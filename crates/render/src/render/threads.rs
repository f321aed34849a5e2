//! The render threads and their input.
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use noisefall_base::{math::SimdLevel, parallel::PerThread};
use noisefall_kernel::integrator::{Batch, Interrupted, Segments, Terms, Work, thresholds, trace, trace_counting};
use noisefall_scene::scene::{CameraRays, RenderSettings, Scene};

/// The render threads, each with its queues.
pub struct Threads {
    pub(super) pool: ThreadPool,
    pub(super) buffers: PerThread<Buffers>,
    pub(super) level: SimdLevel,
}

/// The queues of a thread.
#[derive(Default)]
pub struct Buffers {
    pub(super) batch: Batch,
    /// For films with a series.
    pub(super) terms: Terms,
}

/// The input of a pass.
#[derive(Clone, Copy)]
pub struct PassJob<'a> {
    /// The compiled scene.
    pub scene: &'a Scene,
    /// The rays of the camera, by [`Scene::rays`]. They decide the resolution.
    pub rays: &'a CameraRays,
    /// The settings of the estimate.
    pub settings: &'a RenderSettings,
}

impl Threads {
    /// Starts `count` threads, or one per core if `count` is 0. Fails if the system refuses to start them.
    pub fn new(count: usize, level: SimdLevel) -> Result<Threads, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|i| format!("render {i}")).build()?;
        let buffers = PerThread::new(pool.current_num_threads());
        Ok(Threads { pool, buffers, level })
    }

    /// The number of threads.
    pub fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs a task on the pool, so that rayon's parallel iterators in it use these threads.
    pub fn install<T: Send>(&self, task: impl FnOnce() -> T + Send) -> T {
        self.pool.install(task)
    }

    /// Traces a sample of a tile on a thread of the pool, with what its pixels share; `result` gets their radiance.
    pub(super) fn trace<T>(&self, work: &Work, result: impl FnOnce(&[[f32; 4]]) -> T) -> T {
        let Buffers { batch, .. } = &mut *self.buffers.get();
        let traced = thresholds(self.level, work, batch, &|| false).and_then(|thresholds| {
            let work = Work { thresholds: thresholds.as_ref(), ..*work };
            trace(self.level, &work, batch, &|| false)
        });
        traced.expect("nobody interrupts");
        result(batch.radiance())
    }

    /// Traces a tile on a thread of the pool; `result` gets the radiance of its pixels and the path segments.
    pub(super) fn trace_counting<T>(
        &self,
        work: &Work,
        interrupted: &dyn Fn() -> bool,
        result: impl FnOnce(&[[f32; 4]], Segments) -> T,
    ) -> Result<T, Interrupted> {
        let Buffers { batch, .. } = &mut *self.buffers.get();
        trace_counting(self.level, work, batch, interrupted).map(|segments| result(batch.radiance(), segments))
    }
}
