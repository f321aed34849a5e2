//! Images that are rendered one after the other, each up to the same budget: for files.
use std::{ops::ControlFlow, time::Duration};

use crossbeam_channel::{Receiver, RecvTimeoutError, bounded};

use super::{
    checkpoint::{Checkpoint, CheckpointPlan},
    protocol::{Budget, Publish, Published, RenderRequest, RenderTask, State},
    threads::Threads,
    worker::Renderer,
};

/// Longest time between two reports of progress.
const INTERVAL: Duration = Duration::from_millis(200);

/// The render thread has ended.
#[derive(Debug, thiserror::Error)]
#[error("the render thread ended unexpectedly")]
pub struct RendererEnded;

/// Looks at the progress of an image, and decides whether it goes on. The frame may still be that of an earlier image.
pub type Watch<'a> = &'a mut dyn FnMut(&Published) -> ControlFlow<()>;

/// Renders images up to a budget. Only full frames are published, twice a second.
pub struct StillRenderer {
    renderer: Renderer,
    woken: Receiver<()>,
    budget: Budget,
    /// How the next image is kept.
    plan: Option<CheckpointPlan>,
    /// Number of the last image.
    image: u64,
}

impl StillRenderer {
    /// Starts the render thread.
    pub fn new(threads: Threads, budget: Budget) -> StillRenderer {
        let (wake, woken) = bounded(1);
        let renderer = Renderer::new(threads, Publish::Sparse, move || {
            let _ = wake.try_send(());
        });
        StillRenderer { renderer, woken, budget, plan: None, image: 0 }
    }

    /// Renders the next image up to the budget, or until `watch` stops it.
    pub fn picture(&mut self, request: RenderRequest, watch: Watch) -> Result<Published, RendererEnded> {
        self.begin(|renderer, image| renderer.submit(image, request));
        self.finished(Renderer::latest, watch)
    }

    /// Continues an image from its checkpoint.
    pub fn continued(&mut self, request: RenderRequest, kept: Checkpoint, watch: Watch) -> Result<Published, RendererEnded> {
        self.begin(|renderer, image| renderer.submit_checkpoint(image, request, kept));
        self.finished(Renderer::latest, watch)
    }

    fn begin(&mut self, submit: impl FnOnce(&Renderer, u64)) {
        self.image += 1;
        self.renderer.set_budget(self.budget);
        // While the image changes there is no plan: by neither one may the other image be kept.
        self.renderer.set_plan(None);
        submit(&self.renderer, self.image);
        self.renderer.set_plan(self.plan.take());
    }

    /// Keeps the next image by this plan.
    pub fn set_plan(&mut self, plan: CheckpointPlan) {
        self.plan = Some(plan);
    }

    /// Keeps the image no longer. Waits for a checkpoint that is being written.
    pub fn stop_keeping(&self) -> Result<(), RendererEnded> {
        self.renderer.set_plan(None);
        self.keep_now()
    }

    /// Keeps the image as it is, and waits until it is on the disk or has failed.
    pub fn keep_now(&self) -> Result<(), RendererEnded> {
        self.renderer.keep_now().recv().map_err(|_| RendererEnded)
    }

    /// Renders the same image by number of bounces, with samples of its own.
    pub fn series(&mut self, request: RenderRequest, watch: Watch) -> Result<Published, RendererEnded> {
        self.renderer.submit_second(self.image, RenderTask::Series(request));
        let published = self.finished(Renderer::latest_second, watch);
        self.renderer.stop_second();
        published
    }

    /// Waits for the end of the current image.
    fn finished(&self, latest: fn(&Renderer) -> Published, watch: Watch) -> Result<Published, RendererEnded> {
        loop {
            if self.woken.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Disconnected) {
                return Err(RendererEnded);
            }
            // Until the worker begins, the figures are those of the image before.
            let published = latest(&self.renderer);
            let has_begun = published.status.generation == self.image;
            if has_begun && matches!(published.status.state, State::Paused | State::Done(_) | State::Failed(_)) {
                let _ = watch(&published);
                return Ok(published);
            }
            if has_begun && watch(&published).is_break() {
                self.renderer.set_budget(Budget { paused: true, ..self.budget });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use noisefall_base::math::SimdLevel;
    use noisefall_scene::scene::{Camera, built_in};

    #[test]
    fn images_follow_each_other_and_a_stop_ends_one_with_the_samples_that_it_has() {
        let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
        let mut stills = StillRenderer::new(threads, Budget { max_spp: Some(3), ..Budget::default() });
        let scene = built_in();
        let camera = Camera { resolution: [24, 16], ..scene.camera };
        let request = RenderRequest { settings: scene.settings, scene: Arc::new(scene), camera };
        let go_on = &mut |_: &Published| ControlFlow::Continue(());
        for generation in [1, 2] {
            let done = stills.picture(request.clone(), go_on).expect("it runs");
            assert_eq!((done.frame.generation, done.frame.spp), (generation, 3));
        }
        let large = Camera { resolution: [1024, 1024], ..camera };
        let mut stills = StillRenderer { budget: Budget::default(), ..stills };
        let request = RenderRequest { camera: large, ..request };
        let stopped = stills.picture(request, &mut |_| ControlFlow::Break(())).expect("it runs");
        assert_eq!((stopped.status.generation, stopped.status.state), (3, State::Paused));
    }
}
