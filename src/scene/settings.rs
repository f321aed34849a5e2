//! What the user can choose about the estimate: everything a sample depends on besides scene and camera.
use serde::{Deserialize, Serialize};

use crate::{
    declare::{CountRange, Declare, Form, OneOf, Parameter, Parameters, Range},
    sampling::{Directions, Sampler},
};

/// The settings of a render. Together with scene, camera, pixel and sample index they determine every sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// How direct light is estimated.
    pub estimator: Estimator,
    /// The sequence of random numbers.
    pub sampler: Sampler,
    /// How directions are sampled at diffuse surfaces.
    pub directions: Directions,
    /// How paths end.
    pub roulette: Roulette,
    /// The highest number of bounces counted, reflections and refractions alike; 0 is emitted light only, `None` is no cap.
    pub max_bounces: Option<u32>,
    /// Whether neighbouring pixels share path suffixes.
    pub reuse: Reuse,
    /// Whether pixels get more samples where a pilot found more noise. Not where they share paths.
    pub adaptive: bool,
    /// Seed of all random numbers.
    pub seed: u32,
    /// A mistake that the validation must notice.
    #[cfg(test)]
    #[serde(skip)]
    pub fault: Option<InjectedFault>,
}

/// Mistakes that tests inject into the integrator.
#[cfg(test)]
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

crate::words! {
    Estimator {
        Path: "path", "Path", "Only paths that run into lights.";
        Light: "light", "Light", "Only samples of the lights (next-event estimation), but for what is seen directly or in mirrors.";
        Mis: "mis", "MIS", "Both, each weighted by how likely it was to find what it found (Veach 1997).";
    }
}

/// Russian roulette: ending paths at random and weighting the survivors, so that the mean stays right.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Roulette {
    /// Paths end only where nothing is left, at the cap, or in the background.
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
    /// By throughput, from the fourth bounce.
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

impl OneOf for Roulette {
    const WHAT: &'static str = "roulette";

    fn alternatives() -> Vec<Self> {
        vec![Roulette::Off, Roulette::Fixed(0.8), Roulette::BY_THROUGHPUT]
    }

    fn place(&self) -> usize {
        match self {
            Roulette::Off => 0,
            Roulette::Fixed(_) => 1,
            Roulette::Throughput { .. } => 2,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Roulette::Off => "off",
            Roulette::Fixed(_) => FIXED.key,
            Roulette::Throughput { .. } => THROUGHPUT.key,
        }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            Roulette::Off => {}
            Roulette::Fixed(survival) => p.single(&FIXED, survival, Range::linear(0.01, 1.0)),
            Roulette::Throughput { start } => p.table(&THROUGHPUT, &mut Start(start)),
        }
    }
}

const FIXED: Parameter = Parameter::new("fixed", "Survival probability at every bounce.").symbol("q").required();
const THROUGHPUT: Parameter =
    Parameter::new("throughput", "Survival probability is the throughput's largest component, at most 0.95.");

/// The values of [`Roulette::Throughput`].
struct Start<'a>(&'a mut u32);

impl Declare for Start<'_> {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const START: Parameter = Parameter::new("start", "The first bounce at which a path can end.");
        p.count(&START, self.0, CountRange::ANY);
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
    /// Wherever neighbouring pixels can share.
    On,
    /// Every pixel on its own.
    Off,
}

crate::words! {
    Reuse {
        Auto: "auto", "Auto", "Where a short trial says that it pays.";
        On: "on", "On", "Wherever neighbouring pixels can share.";
        Off: "off", "Off", "Every pixel on its own.";
    }
}

impl Declare for RenderSettings {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const ESTIMATOR: Parameter =
            Parameter::new("estimator", "How light is found; all estimators converge to the same picture.")
                .aliases("integrator method nee");
        const DIRECTIONS: Parameter = Parameter::new("directions", "How the next direction is drawn at a diffuse surface.")
            .symbol("p(ω)")
            .aliases("sampling importance_sampling distribution");
        const SAMPLER: Parameter = Parameter::new("sampler", "Which points of the unit cube the samples of a pixel are.");
        const MAX_BOUNCES: Parameter = Parameter::new(
            "max_bounces",
            "Longest paths, in bounces; a cap makes the picture darker than it is. No cap where it is absent.",
        )
        .symbol("k")
        .aliases("depth max_depth bounces max_bounce maxdepth")
        .advice("leave it out for no cap");
        const ROULETTE: Parameter =
            Parameter::new("roulette", "Ends paths at random and weights the survivors, so that the mean stays right.")
                .aliases("russian_roulette rr");
        const REUSE: Parameter =
            Parameter::new("reuse", "Whether neighbouring pixels share path suffixes (Bekaert, Sbert and Halton 2002).")
                .aliases("sharing share");
        const ADAPTIVE: Parameter = Parameter::new("adaptive", "Whether pixels get more samples where a pilot found more noise.");
        const SEED: Parameter = Parameter::new("seed", "Other seeds give other noise.");
        p.word(&ESTIMATOR, &mut self.estimator);
        p.word(&DIRECTIONS, &mut self.directions);
        p.word(&SAMPLER, &mut self.sampler);
        p.optional(&MAX_BOUNCES, &mut self.max_bounces, || 8, |p, cap| p.count(&MAX_BOUNCES, cap, CountRange::ANY));
        p.optional_choice(&ROULETTE, Form::NameOrTable, &mut self.roulette);
        p.word(&REUSE, &mut self.reuse);
        p.flag(&ADAPTIVE, &mut self.adaptive);
        p.count(&SEED, &mut self.seed, CountRange::ANY);
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
        let last = self.fault.map_or(last, |fault| last.min(60) + u32::from(fault == InjectedFault::OneBounceMore));
        last
    }

    /// Why the expected picture differs from the solution of the equation; `None` when it does not.
    pub fn bias(&self) -> Option<String> {
        self.max_bounces.map(|cap| format!("cap at {cap}"))
    }
}
