//! What camera rays meet first, found off the UI thread, and only while somebody looks at it.
use std::sync::Arc;

use noisefall::{
    integrator::{Features, features},
    math::SimdLevel,
    memory::Reservation,
    render::pass::Threads,
    scene::{Camera, Scene},
};

use super::errand::Errand;

/// What features are of.
type Subject = (Arc<Scene>, Camera);

pub struct FeatureFinder {
    ctx: egui::Context,
    found: Option<Found>,
    /// What was asked for last.
    subject: Option<Subject>,
    pending: Option<Errand<Option<(Features, Reservation)>>>,
}

struct Found {
    subject: Subject,
    features: Arc<Features>,
    _memory: Reservation,
}

impl FeatureFinder {
    pub fn new(ctx: &egui::Context) -> FeatureFinder {
        FeatureFinder { ctx: ctx.clone(), found: None, subject: None, pending: None }
    }

    /// The features of a picture, as soon as they are there; those of the same scene from elsewhere meanwhile.
    pub fn of(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) -> Option<Arc<Features>> {
        let same = |(old, at): &Subject| Arc::ptr_eq(old, scene) && at == camera;
        if let (Some(features), Some(subject)) = (Errand::take(&mut self.pending), &self.subject) {
            // Where the renderer fails, the picture's own threads say so.
            let found = features.ok().flatten();
            self.found =
                found.map(|(features, _memory)| Found { subject: subject.clone(), features: Arc::new(features), _memory });
        }
        // A search that is under way is let finish: while the camera is dragged there would never be one that does.
        if self.pending.is_none() && !self.subject.as_ref().is_some_and(same) {
            self.search(scene, camera, threads);
        }
        let found = self.found.as_ref().filter(|found| Arc::ptr_eq(&found.subject.0, scene));
        found.map(|found| found.features.clone())
    }

    /// Whether what was found is as this camera sees it.
    pub fn has(&self, camera: &Camera) -> bool {
        self.found.as_ref().is_some_and(|found| found.subject.1 == *camera)
    }

    fn search(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) {
        self.subject = Some((scene.clone(), *camera));
        let (scene, camera) = (scene.clone(), *camera);
        self.pending = Some(Errand::start(&self.ctx, move |given_up| {
            let room = Features::reserve(camera.resolution).ok()?;
            // On threads of their own, so many as render.
            let pool = Threads::new(threads, SimdLevel::best()).ok()?;
            let found = pool.install(|| features(SimdLevel::best(), &scene, &camera, given_up))?;
            Some((found, room))
        }));
    }
}

#[cfg(test)]
mod tests {
    use noisefall::scene::built_in;

    use super::*;

    #[test]
    fn features_are_of_the_scene_that_is_asked_for_and_known_by_their_camera() {
        let scene = Arc::new(built_in());
        let here = Camera { resolution: [8, 8], ..scene.camera };
        let there = Camera { fov: 20.0, ..here };
        let mut finder = FeatureFinder::new(&egui::Context::default());
        let wait = |finder: &mut FeatureFinder, camera: &Camera| {
            let start = std::time::Instant::now();
            while !finder.has(camera) {
                assert!(start.elapsed().as_secs() < 60, "they never came");
                let _ = finder.of(&scene, camera, 1);
                std::thread::yield_now();
            }
            finder.of(&scene, camera, 1).expect("they are there")
        };
        let first = wait(&mut finder, &here);
        assert!(!finder.has(&there));
        assert!(finder.of(&scene, &there, 1).is_some_and(|old| Arc::ptr_eq(&old, &first)), "those from elsewhere meanwhile");
        let second = wait(&mut finder, &there);
        assert!(finder.has(&there) && !finder.has(&here) && first.depth != second.depth);
        assert!(finder.of(&Arc::new(built_in()), &there, 1).is_none(), "but not those of another scene");
    }
}
