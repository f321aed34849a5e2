//! What the user can choose about the estimate: everything a sample depends on besides scene and camera.
use serde::{Deserialize, Serialize};

use crate::sampling::{Directions, Sampler};

/// The settings of a render. Together with scene, camera, pixel and sample index they determine every sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    pub estimator: Estimator,
    pub sampler: Sampler,
    pub directions: Directions,
    pub roulette: Roulette,
    /// The highest number of bounces counted, reflections and refractions alike; 0 is emitted light only, `None` is no cap.
    pub max_bounces: Option<u32>,
    pub reuse: Reuse,
    /// Whether pixels get more samples where a pilot found more noise. Not where they share paths.
    pub adaptive: bool,
    pub seed: u32,
    /// A mistake that the validation must notice.
    #[cfg(test)]
    #[serde(skip)]
    pub fault: Option<Fault>,
}

/// Mistakes that tests inject into the integrator.
#[cfg(test)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Samples are divided by 1.03 times their density.
    WrongPdf,
    /// cos θ is missing from the integrand at the first reflection.
    DroppedCosine,
    /// Survivors of roulette are not weighted.
    NoReweighting,
    /// One bounce more than the cap allows.
    OneBounceMore,
}

/// How direct light is estimated. All estimators converge to the same image; they differ in noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Estimator {
    /// Only by emitter hits of paths: plain path tracing (Kajiya 1986).
    Path,
    /// Only by sampling lights (next-event estimation), except for lights seen directly or by specular paths.
    Light,
    /// By both, combined by multiple importance sampling with the power heuristic (Veach 1997, equation 9.14).
    #[default]
    Mis,
}

impl Estimator {
    pub const ALL: [Estimator; 3] = [Estimator::Path, Estimator::Light, Estimator::Mis];

    /// What the scene file and the command line call it.
    pub fn name(self) -> &'static str {
        match self {
            Estimator::Path => "path",
            Estimator::Light => "light",
            Estimator::Mis => "mis",
        }
    }
}

/// Russian roulette: ending paths at random and weighting the survivors, so that the mean stays right.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Roulette {
    Off,
    /// Survival probability at every bounce, from [`Roulette::LEAST`] to 1.
    Fixed(f32),
    /// Survival probability is the throughput's largest component, at most [`Roulette::MOST`].
    Throughput {
        /// The first bounce at which a path can end.
        start: u32,
    },
}

impl Roulette {
    /// Upper bound of the survival probability by throughput: a path between white walls must end too.
    pub const MOST: f32 = 0.95;
    /// Lower bound of all survival probabilities: random numbers are multiples of 2⁻²³, which would round smaller ones.
    pub const LEAST: f32 = 0.01;
    /// The first bounce at which a path can end, where nothing is said.
    pub const FIRST: u32 = 4;
    pub const BY_THROUGHPUT: Roulette = Roulette::Throughput { start: Roulette::FIRST };

    /// What the command line calls it.
    pub fn name(self) -> String {
        match self {
            Roulette::Off => "off".to_owned(),
            Roulette::Fixed(p) => p.to_string(),
            Roulette::Throughput { .. } => "throughput".to_owned(),
        }
    }
}

impl Default for Roulette {
    fn default() -> Self {
        Roulette::BY_THROUGHPUT
    }
}

/// Whether neighbouring pixels share what their paths find beyond the first surface (Bekaert, Sbert and Halton 2002).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Reuse {
    /// Where a short trial says that it pays. The integrator itself takes it for [`Reuse::Off`].
    #[default]
    Auto,
    On,
    Off,
}

impl Reuse {
    pub const ALL: [Reuse; 3] = [Reuse::Auto, Reuse::On, Reuse::Off];

    /// What the scene file and the command line call it.
    pub fn name(self) -> &'static str {
        match self {
            Reuse::Auto => "auto",
            Reuse::On => "on",
            Reuse::Off => "off",
        }
    }
}

impl RenderSettings {
    /// Paths that go on for longer are cut, counted and reported: a room of white walls without roulette would never let one go.
    pub const LONGEST_PATH: u32 = 4096;
    /// The highest cap that is taken at its word: who asks for long paths gets them, and waits.
    pub const HIGHEST_CAP: u32 = 1 << 17;

    /// The number of bounces after which every path is cut.
    pub fn last_bounce(&self) -> u32 {
        let last = self.max_bounces.map_or(Self::LONGEST_PATH, |cap| cap.min(Self::HIGHEST_CAP));
        // A mistake may let paths go on for ever.
        #[cfg(test)]
        let last = self.fault.map_or(last, |fault| last.min(60) + u32::from(fault == Fault::OneBounceMore));
        last
    }

    /// Why the expected picture differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self) -> Option<String> {
        self.max_bounces.map(|cap| format!("cap at {cap}"))
    }
}
