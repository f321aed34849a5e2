//! Finds the first surfaces along camera rays, off the UI thread, while a view shows them.
use std::sync::Arc;

use noisefall_base::{math::SimdLevel, memory::Reservation};
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::threads::Threads;
use noisefall_scene::scene::{Camera, Scene};

use super::search::{Patience, Question, Search};

/// The scene and the camera of features.
#[derive(Clone)]
struct Viewpoint(Arc<Scene>, Camera);

impl Question for Viewpoint {
    fn is_same(&self, other: &Viewpoint) -> bool {
        self.is_near(other) && self.1 == other.1
    }

    /// Features of the same scene from another camera stand in while the camera is dragged.
    fn is_near(&self, other: &Viewpoint) -> bool {
        self.0.has_same_image(&other.0)
    }
}

pub struct FeatureFinder {
    ctx: egui::Context,
    search: Search<Viewpoint, (Arc<Features>, Reservation)>,
}

impl FeatureFinder {
    pub fn new(ctx: &egui::Context) -> FeatureFinder {
        FeatureFinder { ctx: ctx.clone(), search: Search::default() }
    }

    /// The features of an image as soon as they are known; until then, those of the same scene from the previous camera.
    pub fn of(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) -> Option<Arc<Features>> {
        let viewpoint = Viewpoint(scene.clone(), *camera);
        // A failure here is not reported, because the render threads report the same one.
        self.search.ask(&self.ctx, &viewpoint, Patience::Waits, |Viewpoint(scene, camera)| {
            move |cancelled| {
                let room = Features::reserve(camera.resolution).ok()?;
                // A pool of its own, with as many threads as the renderer has.
                let pool = Threads::new(threads, SimdLevel::best()).ok()?;
                let found = pool.install(|| features(SimdLevel::best(), &scene, &camera, cancelled))?;
                Some((Arc::new(found), room))
            }
        });
        self.search.found().map(|(_, (features, _))| features.clone())
    }

    /// Whether the features are those of this scene and camera.
    pub fn has(&self, scene: &Arc<Scene>, camera: &Camera) -> bool {
        self.search.answer(&Viewpoint(scene.clone(), *camera)).is_some()
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
