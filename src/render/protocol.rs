//! What the window or the command line says to the worker, and what it answers.
use std::{sync::Arc, time::Duration};

use super::{
    frame::Frame,
    pass::{Failure, SampleId},
    region::Region,
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
    Converged,
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
