//! Denoises frames off the UI thread, while the view shows them.
use std::{
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
    time::Duration,
};

use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    Frame,
    denoise::{denoised, reserve, steps},
    threads::Threads,
};

use super::background_task::BackgroundTask;

type Radiance = Arc<Vec<[f32; 3]>>;

pub struct Denoiser {
    ctx: egui::Context,
    /// The last result, and its frame.
    done: Option<(Arc<Frame>, Radiance)>,
    /// The frame of the task.
    of: Option<Arc<Frame>>,
    pending: Option<BackgroundTask<Option<Vec<[f32; 3]>>>>,
    /// The steps that the task has made.
    steps: Arc<AtomicUsize>,
}

/// Milliseconds between two looks at the progress.
const LOOK: u64 = 100;

impl Denoiser {
    pub fn new(ctx: &egui::Context) -> Denoiser {
        Denoiser { ctx: ctx.clone(), done: None, of: None, pending: None, steps: Arc::default() }
    }

    /// The denoised radiance of a frame as soon as it is known; until then, that of an earlier frame of the same image.
    pub fn denoised(&mut self, frame: &Arc<Frame>, threads: usize) -> Option<Radiance> {
        if let (Some(found), Some(of)) = (BackgroundTask::take(&mut self.pending), &self.of) {
            self.done = found.ok().flatten().map(|radiance| (of.clone(), Arc::new(radiance)));
        }
        let is_of_image = |of: &Arc<Frame>| is_of_image(of, frame);
        // A task for the same image runs to its end; otherwise none would end while samples arrive.
        if self.pending.is_some() && !self.of.as_ref().is_some_and(is_of_image) {
            self.pending = None;
        }
        let is_new = !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, frame));
        if self.pending.is_none() && is_new && frame.halves.is_some() {
            self.start(frame, threads);
        }
        self.done.as_ref().filter(|(of, _)| is_of_image(of)).map(|(_, radiance)| radiance.clone())
    }

    /// The frame of this image whose result is known.
    pub fn of(&self, frame: &Frame) -> Option<Arc<Frame>> {
        self.done.as_ref().map(|(of, _)| of.clone()).filter(|of| is_of_image(of, frame))
    }

    /// The fraction of the task that is done, while there is no result for the image yet.
    pub fn progress(&self) -> Option<f32> {
        let of = self.of.as_ref().filter(|of| self.pending.is_some() && self.of(of).is_none())?;
        let whole = steps([of.width, of.height]).max(1);
        Some(self.steps.load(Ordering::Relaxed) as f32 / whole as f32)
    }

    /// Cancels the task and drops the result: nothing shows it.
    pub fn stop(&mut self) {
        (self.done, self.of, self.pending) = (None, None, None);
    }

    fn start(&mut self, frame: &Arc<Frame>, threads: usize) {
        self.of = Some(frame.clone());
        self.steps = Arc::default();
        let (frame, steps, ctx) = (frame.clone(), self.steps.clone(), self.ctx.clone());
        self.pending = Some(BackgroundTask::start(&self.ctx, move |cancelled| {
            let _memory = reserve([frame.width, frame.height]).ok()?;
            let pool = Threads::new(threads, SimdLevel::best()).ok()?;
            let step = || {
                steps.fetch_add(1, Ordering::Relaxed);
                ctx.request_repaint_after(Duration::from_millis(LOOK));
                cancelled()
            };
            pool.install(|| denoised(&frame, &step))
        }));
    }
}

fn is_of_image(of: &Frame, frame: &Frame) -> bool {
    of.generation == frame.generation && of.radiance.len() == frame.radiance.len()
}
