//! The messages between the window or the command line and the worker.
use std::{sync::Arc, time::Duration};

use super::{
    frame::Frame,
    pass::{Failure, SampleId},
    region::Region,
    target::Target,
};
use noisefall_scene::scene::{Camera, PathReuse, RenderSettings, Scene};

/// Everything that an image depends on. Display settings are not in it, so they cannot restart a render.
#[derive(Clone)]
pub struct RenderRequest {
    /// The scene to render.
    pub scene: Arc<Scene>,
    /// The camera, which need not be the scene's.
    pub camera: Camera,
    /// How it is rendered.
    pub settings: RenderSettings,
}

impl PartialEq for RenderRequest {
    /// Whether both ask for the same image.
    fn eq(&self, other: &Self) -> bool {
        self.scene.has_same_image(&other.scene) && self.camera == other.camera && self.settings == other.settings
    }
}

/// Limits of a render. A change continues with the existing samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// Whether rendering stops after the first sample.
    pub paused: bool,
    /// Number of single passes requested so far while paused; it only grows.
    pub steps: u64,
    /// Samples per pixel at which to stop.
    pub max_spp: Option<u32>,
    /// Render time after which to stop.
    pub max_time: Option<Duration>,
    /// Relative noise at which to stop: the root of the estimated relMSE.
    pub noise: Option<f64>,
    /// Region to render before the rest, until it has `max_spp` samples.
    pub region: Option<Region>,
    /// Whether frames have the two halves of their samples.
    pub halves: bool,
}

impl Budget {
    /// The target that an image with these figures has reached, if any.
    pub fn target(&self, spp: u32, elapsed: Duration, rel_mse_estimate: Option<f64>) -> Option<Target> {
        let samples = self.max_spp.filter(|most| spp >= *most).map(|_| Target::Samples(spp));
        let time = self.max_time.filter(|most| elapsed >= *most).map(|_| Target::Time);
        let noise = self.noise.filter(|goal| is_below(*goal, spp, rel_mse_estimate)).map(Target::Noise);
        samples.or(time).or(noise).filter(|_| spp > 0)
    }
}

/// Minimum number of samples for a noise target. With fewer, pixels that no light has reached yet look free of noise.
const LEAST_SPP: u32 = 64;

/// Whether the estimated noise of an image is reliably at most `goal`. It is looked at only at some sample counts, so that where a
/// render stops does not depend on the length of its passes.
pub(super) fn is_below(goal: f64, spp: u32, rel_mse_estimate: Option<f64>) -> bool {
    let is_noise_check = spp >= LEAST_SPP && spp == next_look(spp - 1);
    is_noise_check && rel_mse_estimate.is_some_and(|rel_mse| rel_mse.sqrt() <= goal)
}

/// The next sample count above `spp` at which a noise target looks at the noise: 16 between one power of two and the next.
pub(super) fn next_look(spp: u32) -> u32 {
    let next = spp.saturating_add(1).max(LEAST_SPP);
    let step = (LEAST_SPP / 16) << (next / LEAST_SPP).ilog2();
    next.checked_next_multiple_of(step).unwrap_or(u32::MAX)
}

/// Role of a rendered image.
#[derive(Clone, PartialEq)]
pub enum RenderTask {
    /// A image.
    Picture(RenderRequest),
    /// An image with its [`super::Series`]; only full frames.
    Series(RenderRequest),
}

/// State of the worker.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum State {
    /// No job yet.
    #[default]
    Idle,
    /// Samples are being added.
    Running,
    /// The budget asks for a pause.
    Paused,
    /// The render has reached a target of the budget.
    Done(Target),
    /// The renderer panicked; the image so far is kept.
    Failed(Failure),
}

/// Figures of the render, and the state of the worker.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Number of the image.
    pub generation: u64,
    /// State of the worker.
    pub state: State,
    /// Minimum number of samples per pixel.
    pub spp: u32,
    /// Samples per pixel of the region that is rendered before the rest.
    pub region_spp: Option<u32>,
    /// Camera samples taken.
    pub samples: u64,
    /// Rays traced: path segments, shadow rays and visibility rays of path reuse.
    pub rays: u64,
    /// Render time of this image.
    pub elapsed: Duration,
    /// Estimated relMSE; `None` before the second sample.
    pub rel_mse_estimate: Option<f64>,
    /// Whether few pixels carry that error, so that the true one may be much larger.
    pub error_is_lower_bound: bool,
    /// Path reuse between pixels.
    pub path_reuse: PathReuse,
    /// Whether sampling is adaptive.
    pub adapts: bool,
    /// Samples dropped because they were negative or not finite.
    pub invalid_samples: u64,
    /// The first of the dropped samples.
    pub first_invalid: Option<SampleId>,
    /// Paths cut at [`RenderSettings::last_bounce`] in the absence of a cap.
    pub cut_paths: u64,
    /// Whether the first samples are of another scene or program.
    pub is_mixed: bool,
}

impl Status {
    /// The reason why the estimate is biased; `None` if it is not.
    pub fn bias(&self, settings: &RenderSettings) -> Option<String> {
        let cut = (self.cut_paths > 0).then(|| format!("{} paths cut", self.cut_paths));
        let mixed = self.is_mixed.then(|| "first samples of another scene or program".to_owned());
        let reasons: Vec<String> = settings.bias_with(self.path_reuse).or(cut).into_iter().chain(mixed).collect();
        (!reasons.is_empty()).then(|| reasons.join(", "))
    }

    /// Root of the estimated relMSE.
    pub fn relative_noise(&self) -> Option<f64> {
        self.rel_mse_estimate.map(f64::sqrt)
    }

    /// Camera samples per second of render time.
    pub fn samples_per_second(&self) -> f64 {
        self.samples as f64 / self.elapsed.as_secs_f64().max(1e-9)
    }
}

/// The latest frame and figures.
#[derive(Clone, Default)]
pub struct Published {
    /// The latest frame; empty before the first.
    pub frame: Arc<Frame>,
    /// The latest figures, which may be newer than the frame.
    pub status: Status,
}

/// When frames are published.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Publish {
    /// A coarse frame at once, then at growing intervals: for display.
    Live,
    /// Twice a second and at the end, at full resolution only: for files.
    Sparse,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_says_which_of_its_targets_is_reached() {
        let second = Duration::from_secs(1);
        let budget = |max_spp, max_time, noise| Budget { max_spp, max_time, noise, ..Budget::default() };
        let samples = budget(Some(5), None, None);
        assert_eq!(samples.target(4, 100 * second, Some(0.0)), None);
        assert_eq!(samples.target(5, second, None), Some(Target::Samples(5)));
        assert_eq!(samples.target(9, second, None), Some(Target::Samples(9)), "what it has, not what was asked for");
        let time = budget(None, Some(second), None);
        assert_eq!(time.target(1000, second - Duration::from_nanos(1), Some(0.0)), None);
        assert_eq!(time.target(1, second, None), Some(Target::Time));
        assert_eq!(time.target(0, second, None), None, "there is no image yet");
        // relMSE is the square of the noise.
        let noise = budget(None, None, Some(0.1));
        assert_eq!(noise.target(64, second, Some(0.0099)), Some(Target::Noise(0.1)));
        assert_eq!(noise.target(64, second, Some(0.0101)), None);
        assert_eq!(noise.target(63, second, Some(0.0)), None, "too early to be believed");
        assert_eq!(noise.target(1024, second, None), None);
        assert_eq!([66, 68, 130, 136].map(|spp| noise.target(spp, second, Some(0.0)).is_some()), [false, true, false, true]);
        assert_eq!([0, 63, 64, 127, 128, 1000, u32::MAX].map(next_look), [64, 64, 68, 128, 136, 1024, u32::MAX]);
        let all = budget(Some(100), Some(second), Some(0.1));
        assert_eq!(all.target(80, second / 2, Some(0.0)), Some(Target::Noise(0.1)));
        assert_eq!(all.target(80, second, Some(1.0)), Some(Target::Time));
        assert_eq!(all.target(100, second / 2, Some(1.0)), Some(Target::Samples(100)));
        assert_eq!(Budget::default().target(1 << 30, 1_000_000 * second, Some(0.0)), None);
    }

    #[test]
    fn figures_follow_from_others() {
        let status = Status {
            samples: 3_000_000,
            elapsed: Duration::from_millis(1500),
            rel_mse_estimate: Some(0.0004),
            ..Status::default()
        };
        assert_eq!((status.samples_per_second(), status.relative_noise()), (2e6, Some(0.02)));
        assert_eq!((Status::default().samples_per_second(), Status::default().relative_noise()), (0.0, None));
    }

    #[test]
    fn bias_is_told_of_caps_and_of_paths_that_were_cut() {
        let (whole, cut) = (Status::default(), Status { cut_paths: 3, ..Status::default() });
        let (uncapped, capped) =
            (RenderSettings::default(), RenderSettings { max_bounces: Some(2), ..RenderSettings::default() });
        assert_eq!((whole.bias(&uncapped), cut.bias(&uncapped)), (None, Some("3 paths cut".to_owned())));
        assert_eq!((whole.bias(&capped), cut.bias(&capped)), (capped.bias(), capped.bias()));
        assert!(capped.bias().is_some_and(|why| why.contains('2')));
        let [mixed, both] = [whole, cut].map(|status| Status { is_mixed: true, ..status }.bias(&uncapped));
        assert_eq!(mixed.as_deref(), Some("first samples of another scene or program"));
        assert_eq!(both.as_deref(), Some("3 paths cut, first samples of another scene or program"));
    }
}
