//! Handle to the render worker. It compares each request with the last one; a difference starts a new generation.
mod edits;

use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    Budget, KeepHandle, Publish, Published, RenderRequest, RenderTask, Renderer, checkpoint::Checkpoint, threads::Threads,
};

pub use self::edits::EditedDescription;

/// Seconds to wait for the last image before the next request, while a control is dragged.
const PATIENCE: f64 = 0.1;

pub struct RenderWorkerHandle {
    renderer: Renderer,
    /// Generation of the last request, for either view.
    latest: u64,
    generation: u64,
    second_generation: u64,
    request: Option<RenderRequest>,
    /// A render of this request that continues when it is requested.
    kept: Option<(RenderRequest, Checkpoint)>,
    second: Option<RenderTask>,
    /// The edit that has no result yet.
    edit: Option<PendingEdit>,
    budget: Budget,
    threads: usize,
    restarts: bool,
    /// Time of the last request, in seconds of the window's clock.
    asked: f64,
}

/// An edit of the scene that the worker compiles.
struct PendingEdit {
    /// Its image, with the scene before the edit.
    request: RenderRequest,
    /// The generation of the previous image.
    before: u64,
    /// The image continues.
    continues: bool,
}

impl RenderWorkerHandle {
    pub fn new(threads: Threads, ctx: &egui::Context) -> RenderWorkerHandle {
        let ctx = ctx.clone();
        let count = threads.count();
        let renderer = Renderer::new(threads, Publish::Live, move || ctx.request_repaint());
        RenderWorkerHandle {
            renderer,
            latest: 0,
            generation: 0,
            second_generation: 0,
            request: None,
            kept: None,
            second: None,
            edit: None,
            budget: Budget::default(),
            threads: count,
            restarts: false,
            asked: 0.0,
        }
    }

    /// Sets the stopping targets.
    pub fn set_budget(&mut self, budget: Budget) {
        if budget != self.budget {
            self.renderer.set_budget(budget);
            self.budget = budget;
        }
    }

    /// Requests what has changed. `now` is the time of the window's clock.
    pub fn update(&mut self, request: RenderRequest, second: Option<RenderTask>, now: f64) {
        if self.is_editing() {
            return;
        }
        let is_new = std::mem::take(&mut self.restarts) || self.request.as_ref() != Some(&request);
        if is_new {
            self.generation = self.next(now);
            match self.kept.take() {
                Some((of, kept)) if of == request => self.renderer.submit_checkpoint(self.generation, request.clone(), kept),
                _ => self.renderer.submit(self.generation, request.clone()),
            }
        }
        if self.second != second || (is_new && second.is_some()) {
            self.second_generation = self.next(now);
            match second.clone() {
                Some(task) => self.renderer.submit_second(self.second_generation, task),
                None => self.renderer.stop_second(),
            }
            self.second = second;
        }
        self.request = Some(request);
    }

    /// Continues a render with the next request, if that is its own.
    pub fn continue_from(&mut self, request: RenderRequest, kept: Checkpoint) {
        self.kept = Some((request, kept));
    }

    /// Returns a handle that requests checkpoints from other threads.
    pub fn keep_handle(&self) -> KeepHandle {
        self.renderer.keep_handle()
    }

    fn next(&mut self, now: f64) -> u64 {
        self.asked = now;
        self.latest += 1;
        self.latest
    }

    /// Whether the image of the last request is not shown yet and the request is younger than [`PATIENCE`]. `shown` are the
    /// generations on the screen.
    pub fn is_awaited(&self, shown: [u64; 2], now: f64) -> bool {
        let second = self.second.is_some() && shown[1] < self.second_generation;
        (shown[0] < self.generation || second) && now - self.asked < PATIENCE
    }

    /// Whether this equals the last request.
    pub fn is_asked(&self, request: &RenderRequest, second: Option<&RenderTask>) -> bool {
        self.request.as_ref() == Some(request) && self.second.as_ref() == second
    }

    /// Makes the next [`RenderWorkerHandle::update`] restart rendering.
    pub fn restart(&mut self) {
        self.restarts = true;
    }

    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Sets the number of threads to render on.
    pub fn set_threads(&mut self, count: usize) -> Result<(), String> {
        if count != self.threads {
            let threads = Threads::new(count, SimdLevel::best()).map_err(|error| error.to_string())?;
            self.renderer.set_threads(threads);
            self.threads = count;
        }
        Ok(())
    }

    /// The generation of the first view's last request.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    pub fn second_generation(&self) -> u64 {
        self.second_generation
    }

    pub fn latest(&self) -> Published {
        self.renderer.latest()
    }

    pub fn latest_second(&self) -> Published {
        self.renderer.latest_second()
    }

    /// The time of the last request.
    #[cfg(test)]
    pub fn asked(&self) -> f64 {
        self.asked
    }

    /// The last request for the first view.
    pub fn request(&self) -> Option<&RenderRequest> {
        self.request.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use noisefall_scene::scene::{Camera, RenderSettings, built_in};

    use super::*;

    fn worker() -> (RenderWorkerHandle, RenderRequest) {
        let scene = built_in();
        let camera = Camera { resolution: [8, 8], ..scene.camera };
        let request = RenderRequest { settings: scene.settings, scene: Arc::new(scene), camera };
        (
            RenderWorkerHandle::new(Threads::new(1, SimdLevel::best()).expect("a thread can be had"), &egui::Context::default()),
            request,
        )
    }

    /// Requests the same image with another seed.
    fn other(request: &RenderRequest, seed: u32) -> RenderTask {
        RenderTask::Picture(RenderRequest { settings: RenderSettings { seed, ..request.settings }, ..request.clone() })
    }

    #[test]
    fn a_request_is_awaited_until_it_is_shown_or_patience_ends() {
        let (mut worker, request) = worker();
        worker.update(request.clone(), None, 10.0);
        assert_eq!((worker.generation(), worker.second_generation()), (1, 0));
        assert!(worker.is_awaited([0, 0], 10.0 + 0.9 * PATIENCE));
        assert!(!worker.is_awaited([0, 0], 10.0 + 1.1 * PATIENCE), "for a little while only");
        assert!(!worker.is_awaited([1, 0], 10.0));
        // Nothing is awaited without a new request, and the time counts from the last request.
        worker.update(request.clone(), None, 20.0);
        assert_eq!(worker.generation(), 1);
        let other = other(&request, 5);
        worker.update(request.clone(), Some(other), 30.0);
        assert_eq!((worker.generation(), worker.second_generation()), (1, 2));
        assert!(worker.is_awaited([1, 0], 30.0) && !worker.is_awaited([1, 2], 30.0), "the image beside is awaited too");
        worker.update(request, None, 40.0);
        assert!(!worker.is_awaited([1, 0], 40.0), "but not when it is gone");
    }

    #[test]
    fn only_changes_of_scene_camera_or_settings_start_a_new_image() {
        let (mut worker, request) = worker();
        worker.update(request.clone(), None, 0.0);
        assert!(worker.is_asked(&request, None) && !worker.is_asked(&request, Some(&RenderTask::Series(request.clone()))));
        worker.set_budget(Budget { max_spp: Some(3), ..Budget::default() });
        worker.update(request.clone(), None, 0.0);
        assert_eq!(worker.generation(), 1);
        let of_settings = RenderRequest { settings: RenderSettings { seed: 1, ..request.settings }, ..request.clone() };
        let of_camera = RenderRequest { camera: Camera { fov: 20.0, ..request.camera }, ..request.clone() };
        let of_scene = RenderRequest { scene: Arc::new(built_in()), ..request.clone() };
        for (changed, generation) in [(of_settings, 2), (of_camera, 3), (of_scene, 4)] {
            assert!(!worker.is_asked(&changed, None));
            worker.update(changed, None, 0.0);
            assert_eq!(worker.generation(), generation);
        }
        worker.update(request.clone(), None, 0.0);
        worker.restart();
        worker.update(request.clone(), None, 0.0);
        worker.update(request.clone(), None, 0.0);
        assert_eq!(worker.generation(), 6, "it starts over once");
        // The second image starts over with the first, and anew with other settings.
        let other = |seed| Some(other(&request, seed));
        worker.update(request.clone(), other(1), 0.0);
        worker.update(request.clone(), other(2), 0.0);
        assert_eq!((worker.generation(), worker.second_generation()), (6, 8));
        worker.restart();
        worker.update(request.clone(), other(2), 0.0);
        assert_eq!((worker.generation(), worker.second_generation()), (9, 10));
    }
}
