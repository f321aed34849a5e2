//! The samples of a pixel and one of its paths, traced again off the UI thread.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
    mpsc,
};

use noisefall::{
    integrator::{Replay, pixel_samples, replay},
    math::colour::luminance,
    render::sharing::resolved,
};

use super::count_of;
use crate::viewer::link::Wish;

/// More samples do not change what a histogram looks like.
pub const MOST_SAMPLES: u32 = 4096;

/// What has been found.
pub struct Findings {
    /// Luminance of the first samples, by number.
    pub samples: Arc<[f32]>,
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

struct Search {
    question: Question,
    result: mpsc::Receiver<Findings>,
    given_up: Arc<AtomicBool>,
}

pub struct Inspector {
    ctx: egui::Context,
    pub pixel: Option<[u32; 2]>,
    pub sample: u32,
    found: Option<(Question, Findings)>,
    pending: Option<Search>,
    /// What the renderer fails at.
    failed: Option<Question>,
}

impl Inspector {
    pub fn new(ctx: &egui::Context) -> Inspector {
        Inspector { ctx: ctx.clone(), pixel: None, sample: 0, found: None, pending: None, failed: None }
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
        if self.failed.as_ref().is_some_and(known)
            || self.found.as_ref().is_some_and(|(found, _)| known(found))
            || self.pending.as_ref().is_some_and(|search| known(&search.question))
        {
            return;
        }
        let same_pixel = |found: &Question| Question { sample: question.sample, ..found.clone() } == question;
        let samples = self.found.as_ref().filter(|(found, _)| same_pixel(found)).map(|(_, findings)| findings.samples.clone());
        self.start(question, samples);
    }

    fn receive(&mut self) {
        let Some(result) = self.pending.as_ref().map(|search| search.result.try_recv()) else { return };
        match result {
            Ok(findings) => self.found = self.pending.take().map(|search| (search.question.clone(), findings)),
            Err(mpsc::TryRecvError::Disconnected) => self.failed = self.pending.take().map(|search| search.question.clone()),
            Err(mpsc::TryRecvError::Empty) => {}
        }
    }

    /// Whether the renderer fails at what is looked at.
    pub fn has_failed(&self) -> bool {
        self.failed.as_ref().is_some_and(|failed| self.pixel == Some(failed.pixel) && self.sample == failed.sample)
    }

    fn start(&mut self, question: Question, known: Option<Arc<[f32]>>) {
        let (sender, result) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        self.pending = Some(Search { question: question.clone(), result, given_up: given_up.clone() });
        let ctx = self.ctx.clone();
        std::thread::spawn(move || {
            if let Some(findings) = find(&question, known, &|| given_up.load(Ordering::Relaxed)) {
                let _ = sender.send(findings);
            }
            ctx.request_repaint();
        });
    }
}

impl Drop for Search {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

fn find(question: &Question, known: Option<Arc<[f32]>>, given_up: &dyn Fn() -> bool) -> Option<Findings> {
    let Question { wish: Wish { scene, camera, settings }, pixel, sample, count } = question;
    let rays = scene.rays(camera);
    let settings = resolved(scene, &rays, settings);
    let replay = replay(scene, &rays, &settings, *pixel, *sample);
    let samples = match known {
        Some(samples) => samples,
        None => {
            let samples = pixel_samples(scene, &rays, &settings, *pixel, 0..*count, given_up)?;
            samples.into_iter().map(luminance).collect()
        }
    };
    Some(Findings { samples, replay })
}

impl Findings {
    /// The number of the sample with most light.
    pub fn brightest(&self) -> u32 {
        let most = (0..self.samples.len()).max_by(|&a, &b| self.samples[a].total_cmp(&self.samples[b]));
        most.unwrap_or(0) as u32
    }
}
