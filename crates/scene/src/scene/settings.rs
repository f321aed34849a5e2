//! Settings of the estimate: everything that a sample depends on besides scene and camera.
use serde::{Deserialize, Serialize};

use super::{Estimator, Roulette, Strategy};
use crate::sampling::{Directions, Sampler};
use noisefall_base::declare::{CountRange, Declare, Form, Parameter, Parameters};

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
    /// How directions are sampled at diffuse surfaces.
    pub directions: Directions,
    /// How paths end.
    pub roulette: Roulette,
    /// The highest number of bounces counted, reflections and refractions alike; 0 is emitted light only, `None` is no cap.
    pub max_bounces: Option<u32>,
    /// Whether crossing a surface by its opacity counts as a bounce for the cap.
    #[serde(default)]
    pub count_crossings: bool,
    /// What neighbouring pixels share.
    pub reuse: Reuse,
    /// Whether pixels get more samples where a pilot found more noise. Not where they share paths.
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

noisefall_base::declare::words! {
    /// What neighbouring pixels share.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Reuse {
        /// The integrator itself treats it as [`Reuse::Off`].
        #[default]
        Auto: "auto", "Auto", "Shares what a short trial of the scene finds most efficient. The trial runs once per scene.";
        /// Bekaert, Sbert and Halton 2002.
        On: "on", "Paths", "Reuses each path in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Bright: "bright", "Bright samples", "Replays bright samples, such as those of caustics, in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Both: "both", "Both", "Reuses each path, and replays samples that are bright without the reused light.";
        Off: "off", "Nothing", "Every pixel uses only its own paths, so the noise of neighbouring pixels is independent.";
    }
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

    /// How light is estimated, as files and the window name it.
    pub const ESTIMATOR: Parameter =
        Parameter::new("estimator", "How light is estimated. All estimators converge to the same image.")
            .aliases("integrator method nee");
    /// Whether vertices are merged, as files and the window name it.
    pub const MERGING: Parameter = Parameter::new(
        "merging",
        "Whether the estimator `bidirectional` merges vertices that are near each other (Georgiev et al. 2012). Biased, but consistent.",
    )
    .aliases("vcm merge vertex_merging photons");
    /// How directions are sampled, as files and the window name it.
    pub const DIRECTIONS: Parameter = Parameter::new("directions", "How directions are sampled at diffuse surfaces.")
        .symbol("p(ω)")
        .aliases("sampling importance_sampling distribution");
    /// The sequence of random numbers, as files and the window name it.
    pub const SAMPLER: Parameter = Parameter::new("sampler", "How the samples of a pixel are distributed.");
    /// The highest number of bounces, as files and the window name it.
    pub const MAX_BOUNCES: Parameter =
        Parameter::new("max_bounces", "Highest number of bounces. A cap makes the image too dark. Default: no cap.")
            .title("Bounce cap")
            .symbol("k")
            .aliases("depth max_depth bounces max_bounce maxdepth")
            .advice("leave it out for no cap");
    /// What counts as a bounce, as files and the window name it.
    pub const COUNT_CROSSINGS: Parameter =
        Parameter::new("count_crossings", "Whether passing a surface that is not opaque counts as a bounce for `max_bounces`.");
    /// How paths end, as files and the window name it.
    pub const ROULETTE: Parameter =
        Parameter::new("roulette", "Ends paths at random and weights the survivors, so that the mean does not change.")
            .aliases("russian_roulette rr");
    /// What neighbouring pixels share, as files and the window name it.
    pub const REUSE: Parameter = Parameter::new(
        "reuse",
        "What neighbouring pixels share: path suffixes (Bekaert, Sbert and Halton 2002), bright samples, or both.",
    )
    .title("Sharing")
    .aliases("sharing share");
    /// Whether noisier pixels get more samples, as files and the window name it.
    pub const ADAPTIVE: Parameter = Parameter::new("adaptive", "Whether noisier pixels get more samples.");
    /// The seed, as files and the window name it.
    pub const SEED: Parameter = Parameter::new("seed", "Random seed of the samples.");
}

impl Declare for RenderSettings {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.word(&Self::ESTIMATOR, &mut self.estimator);
        p.flag(&Self::MERGING, &mut self.merging);
        p.word(&Self::DIRECTIONS, &mut self.directions);
        p.word(&Self::SAMPLER, &mut self.sampler);
        p.optional(
            &Self::MAX_BOUNCES,
            &mut self.max_bounces,
            || Self::FIRST_CAP,
            |p, cap| p.count(&Self::MAX_BOUNCES, cap, CountRange::ANY),
        );
        p.flag(&Self::COUNT_CROSSINGS, &mut self.count_crossings);
        p.optional_choice(&Self::ROULETTE, Form::NameOrTable, &mut self.roulette);
        p.word(&Self::REUSE, &mut self.reuse);
        p.flag(&Self::ADAPTIVE, &mut self.adaptive);
        p.count(&Self::SEED, &mut self.seed, CountRange::ANY);
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

    /// Why the expected picture differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self) -> Option<String> {
        let part = self.strategy.map(|Strategy { s, t, .. }| format!("strategy ({s}, {t}) alone"));
        let cap = part.or_else(|| self.max_bounces.map(|cap| format!("cap at {cap}")));
        let merging = self.merges().then(|| "vertex merging".to_owned());
        let all: Vec<String> = cap.into_iter().chain(merging).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}
