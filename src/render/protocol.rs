//! What the window or the command line says to the worker, and what it answers.
use std::{sync::Arc, time::Duration};

use super::{
    frame::Frame,
    pass::{Failure, SampleId},
    region::Region,
    target::Target,
};
use crate::scene::{Camera, RenderSettings, Scene};

/// A picture to render. Another generation is another picture.
#[derive(Clone)]
pub struct Job {
    pub generation: u64,
    pub scene: Arc<Scene>,
    pub camera: Camera,
    pub settings: RenderSettings,
}

/// How far to render it. A change goes on with the samples there are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    pub paused: bool,
    /// Single passes asked for so far while paused: a count that only grows.
    pub steps: u64,
    pub max_spp: Option<u32>,
    pub max_time: Option<Duration>,
    /// Relative noise at which to stop: the root of the estimated relMSE.
    pub noise: Option<f64>,
    /// What to render before the rest, until it has `max_spp` samples.
    pub region: Option<Region>,
}

impl Budget {
    /// The target that a picture with these figures has reached, if it has one.
    pub fn target(&self, spp: u32, elapsed: Duration, rel_mse_estimate: Option<f64>) -> Option<Target> {
        let samples = self.max_spp.filter(|most| spp >= *most).map(|_| Target::Samples(spp));
        let time = self.max_time.filter(|most| elapsed >= *most).map(|_| Target::Time);
        let noise = self.noise.filter(|goal| is_below(*goal, spp, rel_mse_estimate)).map(Target::Noise);
        samples.or(time).or(noise).filter(|_| spp > 0)
    }
}

/// Whether the noise of a picture is at most `goal`, as far as this can be believed.
pub(super) fn is_below(goal: f64, spp: u32, rel_mse_estimate: Option<f64>) -> bool {
    /// Before so many samples pixels that no light has found yet look free of noise.
    const LEAST_SPP: u32 = 64;
    spp >= LEAST_SPP && rel_mse_estimate.is_some_and(|rel_mse| rel_mse.sqrt() <= goal)
}

/// A picture beside the first.
#[derive(Clone)]
pub enum Beside {
    /// Another one, as of the same scene by other settings.
    Picture(Job),
    /// The same one as a [`super::Series`]: only full frames.
    Series(Job),
}

/// What the worker is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum State {
    /// No job yet.
    #[default]
    Idle,
    Running,
    Paused,
    /// A target of the budget is reached.
    Done(Target),
    /// The renderer panicked; the picture so far stands.
    Failed(Failure),
}

/// Figures of the render, and what the worker is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    pub generation: u64,
    pub state: State,
    pub spp: u32,
    /// Samples per pixel of the region that is rendered before the rest.
    pub region_spp: Option<u32>,
    /// Camera samples taken.
    pub samples: u64,
    /// Path segments traced.
    pub rays: u64,
    /// Time spent rendering this picture.
    pub elapsed: Duration,
    pub rel_mse_estimate: Option<f64>,
    /// Pixels share what their paths find.
    pub shares: bool,
    /// Samples are spread by noise.
    pub adapts: bool,
    /// Samples dropped because they were not finite or negative.
    pub invalid_samples: u64,
    pub first_invalid: Option<SampleId>,
    /// Paths cut at [`RenderSettings::last_bounce`] without a cap that says so.
    pub cut_paths: u64,
}

impl Status {
    /// Why the expected picture differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self, settings: &RenderSettings) -> Option<String> {
        settings.bias().or((self.cut_paths > 0).then(|| format!("{} paths cut", self.cut_paths)))
    }

    /// Root of the estimated relMSE.
    pub fn relative_noise(&self) -> Option<f64> {
        self.rel_mse_estimate.map(f64::sqrt)
    }

    pub fn samples_per_second(&self) -> f64 {
        self.samples as f64 / self.elapsed.as_secs_f64().max(1e-9)
    }
}

/// The latest picture and figures.
#[derive(Clone, Default)]
pub struct Published {
    pub frame: Arc<Frame>,
    pub status: Status,
}

/// When frames are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Publish {
    /// A coarse one at once, then as the picture grows: for looking on.
    Live,
    /// Twice a second and at rest, full resolution only: for files.
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
        assert_eq!(time.target(0, second, None), None, "there is no picture yet");
        // relMSE is the square of the noise.
        let noise = budget(None, None, Some(0.1));
        assert_eq!(noise.target(64, second, Some(0.0099)), Some(Target::Noise(0.1)));
        assert_eq!(noise.target(64, second, Some(0.0101)), None);
        assert_eq!(noise.target(63, second, Some(0.0)), None, "too early to be believed");
        assert_eq!(noise.target(1000, second, None), None);
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
    }
}
