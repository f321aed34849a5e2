//! What camera rays meet first, found off the UI thread, and only while somebody looks at it.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
    mpsc,
};

use noisefall::{
    integrator::{Features, features},
    math::SimdLevel,
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

impl FeatureFinder {
    pub fn new(ctx: &egui::Context) -> FeatureFinder {
        FeatureFinder { ctx: ctx.clone(), found: None, subject: None, pending: None }
    }

    /// The features of a picture, as soon as they are there; those of the one before meanwhile.
    pub fn of(&mut self, scene: &Arc<Scene>, camera: &Camera) -> Option<Arc<Features>> {
        let same = |(old, at): &Subject| Arc::ptr_eq(old, scene) && at == camera;
        if !self.subject.as_ref().is_some_and(same) {
            self.search(scene, camera);
        }
        if let Some(features) = self.pending.as_ref().and_then(|search| search.result.try_recv().ok()) {
            (self.found, self.pending) = (Some(Arc::new(features)), None);
        }
        self.found.clone()
    }

    fn search(&mut self, scene: &Arc<Scene>, camera: &Camera) {
        if let Some(search) = &self.pending {
            search.given_up.store(true, Ordering::Relaxed);
        }
        self.subject = Some((scene.clone(), *camera));
        let (sender, result) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        self.pending = Some(Search { result, given_up: given_up.clone() });
        let (ctx, scene, camera) = (self.ctx.clone(), scene.clone(), *camera);
        std::thread::spawn(move || {
            let found = features(SimdLevel::best(), &scene, &camera, &|| given_up.load(Ordering::Relaxed));
            if let Some(features) = found {
                let _ = sender.send(features);
                ctx.request_repaint();
            }
        });
    }
}
