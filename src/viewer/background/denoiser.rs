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

use super::search::{Patience, Question, Search};

type Radiance = Arc<Vec<[f32; 3]>>;

/// A frame to denoise.
#[derive(Clone)]
struct Noisy(Arc<Frame>);

impl Question for Noisy {
    fn is_same(&self, other: &Noisy) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// An earlier frame of the same image stands in while samples arrive.
    fn is_near(&self, other: &Noisy) -> bool {
        is_of_image(&self.0, &other.0)
    }
}

pub struct Denoiser {
    ctx: egui::Context,
    search: Search<Noisy, Radiance>,
    /// The steps that the search has made.
    steps: Arc<AtomicUsize>,
}

/// Milliseconds between two looks at the progress.
const LOOK: u64 = 100;

impl Denoiser {
    pub fn new(ctx: &egui::Context) -> Denoiser {
        Denoiser { ctx: ctx.clone(), search: Search::default(), steps: Arc::default() }
    }

    /// The denoised radiance of a frame as soon as it is known; until then, that of an earlier frame of the same image.
    pub fn denoised(&mut self, frame: &Arc<Frame>, threads: usize) -> Option<Radiance> {
        if frame.halves.is_some() {
            let (steps, ctx) = (&mut self.steps, self.ctx.clone());
            self.search.ask(&self.ctx, &Noisy(frame.clone()), Patience::Waits, |Noisy(frame)| {
                *steps = Arc::default();
                let steps = steps.clone();
                move |cancelled| {
                    let _memory = reserve([frame.width, frame.height]).ok()?;
                    let pool = Threads::new(threads, SimdLevel::best()).ok()?;
                    let step = || {
                        steps.fetch_add(1, Ordering::Relaxed);
                        ctx.request_repaint_after(Duration::from_millis(LOOK));
                        cancelled()
                    };
                    pool.install(|| denoised(&frame, &step)).map(Arc::new)
                }
            });
        }
        self.search.found().filter(|(of, _)| is_of_image(&of.0, frame)).map(|(_, radiance)| radiance.clone())
    }

    /// The frame of this image whose result is known.
    pub fn of(&self, frame: &Frame) -> Option<Arc<Frame>> {
        self.search.found().map(|(of, _)| of.0.clone()).filter(|of| is_of_image(of, frame))
    }

    /// The fraction of the task that is done, while there is no result for the image yet.
    pub fn progress(&self) -> Option<f32> {
        let Noisy(of) = self.search.pending().filter(|Noisy(of)| self.of(of).is_none())?;
        let whole = steps([of.width, of.height]).max(1);
        Some(self.steps.load(Ordering::Relaxed) as f32 / whole as f32)
    }

    /// Cancels the task and drops the result: nothing shows it.
    pub fn stop(&mut self) {
        self.search = Search::default();
    }
}

fn is_of_image(of: &Frame, frame: &Frame) -> bool {
    of.generation == frame.generation && of.radiance.len() == frame.radiance.len()
}
