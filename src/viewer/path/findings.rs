//! The samples of a pixel and one of its paths, traced again off the UI thread.
use std::sync::Arc;

use noisefall::{
    integrator::{Replay, pixel_samples, replay},
    math::colour::luminance,
    render::sharing::resolved,
};

use super::{count_of, histogram::Histogram};
use crate::viewer::{errand::Errand, link::Wish};

/// More samples do not change what a histogram looks like.
pub const MOST_SAMPLES: u32 = 4096;

/// What has been found.
pub struct Findings {
    /// Of the first samples of the pixel.
    pub histogram: Arc<Histogram>,
    pub replay: Replay,
}

/// What is looked at.
#[derive(Clone, PartialEq)]
struct Question {
    wish: Wish,
    pixel: [u32; 2],
    sample: u32,
    count: u32,
}

pub struct Inspector {
    ctx: egui::Context,
    pub pixel: Option<[u32; 2]>,
    pub sample: u32,
    found: Option<(Question, Findings)>,
    /// What is being found; nothing where it was given up.
    pending: Option<Errand<Option<Findings>>>,
    /// What it is, or was, about.
    asked: Option<Question>,
    /// What the renderer fails at.
    failed: Option<Question>,
}

impl Inspector {
    pub fn new(ctx: &egui::Context) -> Inspector {
        Inspector { ctx: ctx.clone(), pixel: None, sample: 0, found: None, pending: None, asked: None, failed: None }
    }

    pub fn look_at(&mut self, pixel: [u32; 2]) {
        if self.pixel != Some(pixel) {
            (self.pixel, self.sample, self.found) = (Some(pixel), 0, None);
        }
    }

    pub fn findings(&self) -> Option<&Findings> {
        self.found.as_ref().map(|(_, findings)| findings)
    }

    /// Takes in what has been found, and looks for what is not. The picture has so many samples a pixel.
    pub fn search(&mut self, wish: &Wish, spp: u32) {
        let [width, height] = wish.camera.resolution;
        self.pixel = self.pixel.filter(|[x, y]| *x < width && *y < height);
        let Some(pixel) = self.pixel else {
            self.found = None;
            return;
        };
        self.receive();
        let count = count_of(spp);
        let question = Question { wish: wish.clone(), pixel, sample: self.sample, count };
        let known = |other: &Question| *other == question;
        if self.found.as_ref().is_some_and(|(found, _)| (&found.wish, found.pixel) != (wish, pixel)) {
            self.found = None;
        }
        let pending = self.asked.as_ref().filter(|_| self.pending.is_some());
        let found = self.found.as_ref().map(|(found, _)| found);
        if [self.failed.as_ref(), found, pending].into_iter().flatten().any(known) {
            return;
        }
        let same_pixel = |found: &Question| Question { sample: question.sample, ..found.clone() } == question;
        let histogram =
            self.found.as_ref().filter(|(found, _)| same_pixel(found)).map(|(_, findings)| findings.histogram.clone());
        self.asked = Some(question.clone());
        self.pending = Some(Errand::start(&self.ctx, move |given_up| find(&question, histogram, given_up)));
    }

    fn receive(&mut self) {
        let (Some(result), Some(question)) = (Errand::take(&mut self.pending), &self.asked) else { return };
        match result {
            Ok(findings) => self.found = findings.map(|findings| (question.clone(), findings)),
            Err(_) => self.failed = Some(question.clone()),
        }
    }

    /// Whether the renderer fails at what is looked at.
    pub fn has_failed(&self) -> bool {
        self.failed.as_ref().is_some_and(|failed| self.pixel == Some(failed.pixel) && self.sample == failed.sample)
    }
}

fn find(question: &Question, known: Option<Arc<Histogram>>, given_up: &dyn Fn() -> bool) -> Option<Findings> {
    let Question { wish: Wish { scene, camera, settings }, pixel, sample, count } = question;
    let rays = scene.rays(camera);
    let settings = resolved(scene, &rays, settings);
    let replay = replay(scene, &rays, &settings, *pixel, *sample);
    let histogram = match known {
        Some(histogram) => histogram,
        None => {
            let samples = pixel_samples(scene, &rays, &settings, *pixel, 0..*count, given_up)?;
            Arc::new(Histogram::of(samples.into_iter().map(luminance).collect()))
        }
    };
    Some(Findings { histogram, replay })
}
