//! Finds the first surfaces along camera rays, off the UI thread, while a view shows them.
use std::sync::Arc;

use noisefall_base::{math::SimdLevel, memory::Reservation};
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::threads::Threads;
use noisefall_scene::scene::{Camera, Scene};

use super::background_task::BackgroundTask;

/// The scene and the camera of features.
type Viewpoint = (Arc<Scene>, Camera);

pub struct FeatureFinder {
    ctx: egui::Context,
    found: Option<FoundFeatures>,
    /// The last requested viewpoint.
    viewpoint: Option<Viewpoint>,
    pending: Option<BackgroundTask<Option<(Features, Reservation)>>>,
}

struct FoundFeatures {
    viewpoint: Viewpoint,
    features: Arc<Features>,
    _memory: Reservation,
}

impl FeatureFinder {
    pub fn new(ctx: &egui::Context) -> FeatureFinder {
        FeatureFinder { ctx: ctx.clone(), found: None, viewpoint: None, pending: None }
    }

    /// The features of an image as soon as they are known; until then, those of the same scene from the previous camera.
    pub fn of(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) -> Option<Arc<Features>> {
        let same = |(old, at): &Viewpoint| old.has_same_image(scene) && at == camera;
        if let (Some(features), Some(viewpoint)) = (BackgroundTask::take(&mut self.pending), &self.viewpoint) {
            // A failure here is not reported, because the render threads report the same one.
            let found = features.ok().flatten();
            self.found = found.map(|(features, _memory)| FoundFeatures {
                viewpoint: viewpoint.clone(),
                features: Arc::new(features),
                _memory,
            });
        }
        // A running search is not cancelled; otherwise none would finish while the camera is dragged.
        if self.pending.is_none() && !self.viewpoint.as_ref().is_some_and(same) {
            self.search(scene, camera, threads);
        }
        let found = self.found.as_ref().filter(|found| found.viewpoint.0.has_same_image(scene));
        found.map(|found| found.features.clone())
    }

    /// Whether the features are those of this scene and camera.
    pub fn has(&self, scene: &Arc<Scene>, camera: &Camera) -> bool {
        self.found
            .as_ref()
            .is_some_and(|FoundFeatures { viewpoint, .. }| viewpoint.0.has_same_image(scene) && viewpoint.1 == *camera)
    }

    fn search(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) {
        self.viewpoint = Some((scene.clone(), *camera));
        let (scene, camera) = (scene.clone(), *camera);
        self.pending = Some(BackgroundTask::start(&self.ctx, move |cancelled| {
            let room = Features::reserve(camera.resolution).ok()?;
            // A pool of its own, with as many threads as the renderer has.
            let pool = Threads::new(threads, SimdLevel::best()).ok()?;
            let found = pool.install(|| features(SimdLevel::best(), &scene, &camera, cancelled))?;
            Some((found, room))
        }));
    }
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::built_in;

    use super::*;

    #[test]
    fn features_are_of_the_scene_that_is_asked_for_and_known_by_their_camera() {
        let scene = Arc::new(built_in());
        let here = Camera { resolution: [8, 8], ..scene.camera };
        let there = Camera { fov: 20.0, ..here };
        let mut finder = FeatureFinder::new(&egui::Context::default());
        let wait = |finder: &mut FeatureFinder, camera: &Camera| {
            let start = std::time::Instant::now();
            while !finder.has(&scene, camera) {
                assert!(start.elapsed().as_secs() < 60, "they never came");
                let _ = finder.of(&scene, camera, 1);
                std::thread::yield_now();
            }
            finder.of(&scene, camera, 1).expect("they are there")
        };
        let first = wait(&mut finder, &here);
        assert!(!finder.has(&scene, &there));
        assert!(finder.of(&scene, &there, 1).is_some_and(|old| Arc::ptr_eq(&old, &first)), "those from elsewhere meanwhile");
        let second = wait(&mut finder, &there);
        assert!(finder.has(&scene, &there) && !finder.has(&scene, &here) && first.depth != second.depth);
        assert!(finder.of(&Arc::new(built_in()), &there, 1).is_none(), "but not those of another scene");
    }
}
