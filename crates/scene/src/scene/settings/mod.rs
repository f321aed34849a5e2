//! Settings of the estimate: everything that a sample depends on besides scene and camera.
mod setting;
mod table;

use serde::{Deserialize, Serialize};

pub use self::setting::{Changes, Setting};
use super::{Estimator, Reuse, Roulette, Strategy};
use crate::sampling::{Directions, Sampler};

/// The settings of a render. Together with scene, camera, pixel and sample index they determine every sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// How light is estimated.
    pub estimator: Estimator,
    /// Whether the estimator `bidirectional` merges vertices, too. Biased, but consistent.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub merging: bool,
    /// The sequence of random numbers.
    pub sampler: Sampler,
    /// How the next direction is sampled at diffuse surfaces.
    pub directions: Directions,
    /// How paths end.
    pub roulette: Roulette,
    /// The highest number of bounces counted, reflections and refractions alike; 0 is emitted light only, `None` is no cap.
    pub max_bounces: Option<u32>,
    /// Whether crossing a surface by its opacity counts as a bounce for the cap.
    #[serde(default)]
    pub count_crossings: bool,
    /// Path reuse between neighbouring pixels.
    pub reuse: Reuse,
    /// Whether pixels get more samples where a pilot found more noise. Not where they reuse paths.
    pub adaptive: bool,
    /// Seed of all random numbers.
    pub seed: u32,
    /// The only strategy of the estimator `bidirectional` that finds light; `None` for all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strategy: Option<Strategy>,
    /// A mistake that the validation must notice.
    #[serde(skip)]
    pub fault: Option<InjectedFault>,
}

/// Mistakes that tests inject into the integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InjectedFault {
    /// Samples are divided by 1.03 times their density.
    WrongPdf,
    /// cos θ is missing from the integrand at the first reflection.
    DroppedCosine,
    /// Survivors of roulette are not weighted.
    NoReweighting,
    /// One bounce more than the cap allows.
    OneBounceMore,
}

impl RenderSettings {
    /// The settings that render the light of a strategy alone. The cap also bounds the number of connections, whatever the roulette.
    pub fn of_strategy(self, strategy: Strategy) -> RenderSettings {
        RenderSettings {
            estimator: Estimator::Bidirectional,
            reuse: Reuse::Off,
            adaptive: false,
            merging: false,
            strategy: Some(strategy),
            max_bounces: Some(strategy.bounces()),
            ..self
        }
    }
}

impl RenderSettings {
    /// Without a cap, paths that go on for longer are cut, counted and reported: a room of white walls without roulette would never
    /// let one go.
    pub const LONGEST_PATH: u32 = 4096;
    /// The highest cap that is honoured, and that the window offers.
    pub const HIGHEST_CAP: u32 = 1 << 17;
    /// The cap that the window begins with when one is switched on.
    pub const FIRST_CAP: u32 = 8;

    /// The number of bounces after which every path is cut.
    pub fn last_bounce(&self) -> u32 {
        self.max_bounces.map_or(Self::LONGEST_PATH, |cap| cap.min(Self::HIGHEST_CAP))
    }

    /// Whether vertices are merged.
    pub fn merges(&self) -> bool {
        self.merging && self.estimator.connects()
    }

    /// Why the expected image differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self) -> Option<String> {
        let part = self.strategy.map(|Strategy { s, t, .. }| format!("strategy ({s}, {t}) alone"));
        let cap = part.or_else(|| self.max_bounces.map(|cap| format!("cap at {cap}")));
        let merging = self.merges().then(|| "vertex merging".to_owned());
        let all: Vec<String> = cap.into_iter().chain(merging).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}
