//! A short study of the current view, off the UI thread. The main render pauses meanwhile.
use std::{
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

use noisefall_base::math::SimdLevel;
use noisefall_lab::study::{Advice, advise};
use noisefall_render::render::{RenderRequest, threads::Threads};

use super::background_task::BackgroundTask;

/// Duration of a study.
const TIME: Duration = Duration::from_secs(8);

type AdviceResult = Result<Advice, String>;

/// A study that is running or finished.
pub struct Adviser {
    /// Rendered test images and their total.
    progress: Arc<Mutex<(usize, usize)>>,
    pending: Option<BackgroundTask<AdviceResult>>,
    pub advice: Option<AdviceResult>,
    /// The scene, camera and settings of the study.
    pub request: RenderRequest,
}

impl Adviser {
    pub fn start(ctx: &egui::Context, request: &RenderRequest, threads: usize) -> Adviser {
        let progress = Arc::new(Mutex::new((0, 0)));
        let (told, RenderRequest { scene, camera, settings }) = (progress.clone(), request.clone());
        let window = ctx.clone();
        let study = BackgroundTask::start(ctx, move |cancelled| {
            let mut tell = |done, total| {
                *told.lock().unwrap_or_else(PoisonError::into_inner) = (done, total);
                window.request_repaint();
            };
            let threads = Threads::new(threads, SimdLevel::best()).map_err(|error| error.to_string())?;
            advise(&scene, &camera, &settings, &threads, TIME, &mut tell, cancelled).map_err(|error| error.to_string())
        });
        Adviser { progress, pending: Some(study), advice: None, request: request.clone() }
    }

    pub fn receive(&mut self) {
        if let Some(advice) = BackgroundTask::take(&mut self.pending) {
            self.advice = Some(advice.unwrap_or_else(|_| Err("The study failed unexpectedly.".to_owned())));
        }
    }

    pub fn progress(&self) -> (usize, usize) {
        *self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn is_busy(&self) -> bool {
        self.advice.is_none()
    }
}
