//! The render threads, and what they are given.
use std::sync::{Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::{
    integrator::{Batch, Interrupted, Segments, Terms, Work, trace_counting},
    math::SimdLevel,
    scene::{CameraRays, RenderSettings, Scene},
};

/// The render threads, each with its queues.
pub struct Threads {
    pub(super) pool: ThreadPool,
    pub(super) batches: Vec<Mutex<Batch>>,
    /// Buffers for films with a series.
    pub(super) terms: Vec<Mutex<Terms>>,
    pub(super) level: SimdLevel,
}

/// The input of a pass.
#[derive(Clone, Copy)]
pub struct PassJob<'a> {
    pub scene: &'a Scene,
    pub rays: &'a CameraRays,
    pub settings: &'a RenderSettings,
}

impl Threads {
    /// `count` 0 means as many as there are cores.
    pub fn new(count: usize, level: SimdLevel) -> Result<Threads, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|i| format!("render {i}")).build()?;
        let (batches, terms) = (0..pool.current_num_threads()).map(|_| Default::default()).unzip();
        Ok(Threads { pool, batches, terms, level })
    }

    pub fn count(&self) -> usize {
        self.batches.len()
    }

    /// Runs something on the threads of the pool.
    pub fn install<T: Send>(&self, task: impl FnOnce() -> T + Send) -> T {
        self.pool.install(task)
    }

    /// Traces a tile on a thread of the pool; `result` gets the radiance of its pixels and the path segments.
    pub(super) fn trace_counting<T>(
        &self,
        work: &Work,
        interrupted: &dyn Fn() -> bool,
        result: impl FnOnce(&[[f32; 4]], Segments) -> T,
    ) -> Result<T, Interrupted> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let mut batch = self.batches[thread].lock().unwrap_or_else(PoisonError::into_inner);
        trace_counting(self.level, work, &mut batch, interrupted).map(|segments| result(batch.radiance(), segments))
    }
}
