//! Traces the samples of a pixel and one of its paths again, off the UI thread.
use noisefall_base::math::colour::luminance;
use noisefall_kernel::integrator::{Replay, pixel_samples, replay, seen_by_camera};
use noisefall_render::render::{RenderRequest, path_reuse::resolved};

use super::{cells::Channel, histogram::Histogram};
use crate::viewer::background::search::{self, Patience, Search};

/// More samples do not change what a histogram looks like.
const MOST_SAMPLES: u32 = 4096;

/// The sample, or the samples, to trace again.
#[derive(Clone, PartialEq)]
struct Question {
    request: RenderRequest,
    pixel: [u32; 2],
    /// The index of the sample, or the number of samples.
    number: u32,
}

impl search::Question for Question {
    fn is_same(&self, other: &Question) -> bool {
        self == other
    }

    /// Both are about the samples of the same pixel of the same image.
    fn is_near(&self, other: &Question) -> bool {
        (&self.request, self.pixel) == (&other.request, other.pixel)
    }
}

pub struct PathInspector {
    ctx: egui::Context,
    pub pixel: Option<[u32; 2]>,
    /// The pixel is one of B.
    pub of_second: bool,
    pub sample: u32,
    /// The channel that the table of terms shows.
    pub channel: Channel,
    /// With whether the camera sees each of its vertices.
    replay: Search<Question, (Replay, Vec<bool>)>,
    /// With the radiance of the samples.
    histogram: Search<Question, (Histogram, Vec<[f32; 3]>)>,
}

impl PathInspector {
    pub fn new(ctx: &egui::Context) -> PathInspector {
        let (replay, histogram) = Default::default();
        PathInspector { ctx: ctx.clone(), pixel: None, of_second: false, sample: 0, channel: Channel::Red, replay, histogram }
    }

    pub fn look_at(&mut self, pixel: [u32; 2]) {
        if self.pixel != Some(pixel) {
            (self.pixel, self.sample) = (Some(pixel), 0);
            (self.replay, self.histogram) = Default::default();
        }
    }

    /// The path of the chosen sample; of the one before while that is traced. With the number of the sample.
    pub fn replay(&self) -> Option<(u32, &Replay)> {
        self.replay.found().map(|(question, (replay, _))| (question.number, replay))
    }

    /// Whether the camera sees a vertex of that path.
    pub fn is_seen(&self, vertex: usize) -> bool {
        self.replay.found().is_some_and(|(_, (_, seen))| seen.get(vertex).copied().unwrap_or(false))
    }

    /// Of the first samples of the pixel.
    pub fn histogram(&self) -> Option<&Histogram> {
        self.histogram.found().map(|(_, (histogram, _))| histogram)
    }

    /// The first samples of the pixel.
    pub fn samples(&self) -> Option<&[[f32; 3]]> {
        self.histogram.found().map(|(_, (_, samples))| samples.as_slice())
    }

    /// Receives finished results, and starts tasks for missing ones. The image has this many samples per pixel.
    pub fn search(&mut self, request: &RenderRequest, spp: u32) {
        let [width, height] = request.camera.resolution;
        self.pixel = self.pixel.filter(|[x, y]| *x < width && *y < height);
        let Some(pixel) = self.pixel else {
            (self.replay, self.histogram) = Default::default();
            return;
        };
        let question = |number| Question { request: request.clone(), pixel, number };
        let path = |question| move |_: &(dyn Fn() -> bool + Sync)| Some(path_of(&question));
        self.replay.ask(&self.ctx, &question(self.sample), Patience::Cancels, path);
        // The number of samples grows while they are traced.
        let histogram = |question| move |cancelled: &(dyn Fn() -> bool + Sync)| histogram_of(&question, cancelled);
        self.histogram.ask(&self.ctx, &question(count_of(spp)), Patience::Waits, histogram);
    }

    /// Describes the failure of the renderer.
    pub fn failure(&self) -> Option<&'static str> {
        match (self.replay.failed, self.histogram.failed) {
            (true, _) => Some("The renderer fails at this sample"),
            (_, true) => Some("The renderer fails at a sample of this pixel"),
            _ => None,
        }
    }
}

/// The number of samples in the histogram: a power of two, so that it is traced again only when the samples have doubled.
fn count_of(spp: u32) -> u32 {
    1 << spp.clamp(1, MOST_SAMPLES).ilog2()
}

fn path_of(Question { request: RenderRequest { scene, camera, settings }, pixel, number }: &Question) -> (Replay, Vec<bool>) {
    let rays = scene.rays(camera);
    let replay = replay(scene, &rays, &resolved(scene, &rays, settings), *pixel, *number);
    let seen = seen_by_camera(scene, camera, &replay);
    (replay, seen)
}

fn histogram_of(question: &Question, cancelled: &dyn Fn() -> bool) -> Option<(Histogram, Vec<[f32; 3]>)> {
    let Question { request: RenderRequest { scene, camera, settings }, pixel, number } = question;
    let rays = scene.rays(camera);
    let samples = pixel_samples(scene, &rays, &resolved(scene, &rays, settings), *pixel, 0..*number, cancelled)?;
    Some((Histogram::of(samples.iter().map(|rgb| luminance(*rgb)).collect()), samples))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_told_of_the_sample_that_is_looked_at_first() {
        let failure = |of_sample, of_another| {
            let mut inspector = PathInspector::new(&egui::Context::default());
            (inspector.replay.failed, inspector.histogram.failed) = (of_sample, of_another);
            inspector.failure()
        };
        assert_eq!(failure(false, false), None);
        assert!([true, false].into_iter().all(|other| failure(true, other).is_some_and(|text| text.ends_with("at this sample"))));
        assert!(failure(false, true).is_some_and(|text| text.ends_with("at a sample of this pixel")));
    }

    #[test]
    fn a_histogram_has_a_power_of_two_of_the_samples_there_are() {
        assert_eq!([0, 1, 2, 3, 63, 64, 100_000].map(count_of), [1, 1, 2, 2, 32, 64, MOST_SAMPLES]);
    }
}
