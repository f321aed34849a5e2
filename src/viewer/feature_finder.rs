//! What camera rays meet first, found off the UI thread, and only while somebody looks at it.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
    mpsc,
};

use noisefall::{
    integrator::{Features, features},
    math::SimdLevel,
    render::pass::Threads,
    scene::{Camera, Scene},
};

/// What features are of.
type Subject = (Arc<Scene>, Camera);

pub struct FeatureFinder {
    ctx: egui::Context,
    found: Option<Arc<Features>>,
    /// What they are, or will be, of.
    subject: Option<Subject>,
    pending: Option<Search>,
}

struct Search {
    result: mpsc::Receiver<Features>,
    given_up: Arc<AtomicBool>,
}

impl Drop for Search {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

impl FeatureFinder {
    pub fn new(ctx: &egui::Context) -> FeatureFinder {
        FeatureFinder { ctx: ctx.clone(), found: None, subject: None, pending: None }
    }

    /// The features of a picture, as soon as they are there; those of the one before meanwhile.
    pub fn of(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) -> Option<Arc<Features>> {
        let same = |(old, at): &Subject| Arc::ptr_eq(old, scene) && at == camera;
        match self.pending.as_ref().map(|search| search.result.try_recv()) {
            Some(Ok(features)) => (self.found, self.pending) = (Some(Arc::new(features)), None),
            // The renderer fails at it: the picture's own threads say so.
            Some(Err(mpsc::TryRecvError::Disconnected)) => self.pending = None,
            _ => {}
        }
        // A search that is under way is let finish: while the camera is dragged there would never be one that does.
        if self.pending.is_none() && !self.subject.as_ref().is_some_and(same) {
            self.search(scene, camera, threads);
        }
        self.found.clone()
    }

    fn search(&mut self, scene: &Arc<Scene>, camera: &Camera, threads: usize) {
        self.subject = Some((scene.clone(), *camera));
        let (sender, result) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        self.pending = Some(Search { result, given_up: given_up.clone() });
        let (ctx, scene, camera) = (self.ctx.clone(), scene.clone(), *camera);
        std::thread::spawn(move || {
            let interrupted = || given_up.load(Ordering::Relaxed);
            // On threads of their own, so many as render.
            let Ok(pool) = Threads::new(threads, SimdLevel::best()) else { return };
            let found = pool.install(|| features(SimdLevel::best(), &scene, &camera, &interrupted));
            if let Some(features) = found {
                let _ = sender.send(features);
                ctx.request_repaint();
            }
        });
    }
}
