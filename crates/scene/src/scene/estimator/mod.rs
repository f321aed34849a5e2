//! How light is estimated. All estimators converge to the same image; they differ in noise.
//!
//! An estimator is one file and one line of the catalogue below.
mod auto;
mod bidirectional;
mod caustics;
mod light;
mod light_tracing;
mod mis;
mod obstacle;
mod path;

pub use self::{mis::power_heuristic, obstacle::Obstacle};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

noisefall_base::declare::word_kinds! {
    /// How light is estimated. All estimators converge to the same image; they differ in noise.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Estimator: Weighting, default Mis {
        path::Path,
        light::Light,
        mis::Mis,
        caustics::Caustics,
        light_tracing::LightTracing,
        bidirectional::Bidirectional,
        auto::Auto,
    }
    in_estimator
}

impl Estimator {
    /// Whether lights that rays can hit are sampled, in addition to emitter hits. Punctual lights always are.
    #[inline(always)]
    pub fn samples_lights(self) -> bool {
        in_estimator!(self, E => E::SAMPLES_LIGHTS)
    }

    /// Whether a weight depends on the pdf that the other strategy has for the same sample.
    #[inline(always)]
    pub fn compares(self) -> bool {
        in_estimator!(self, E => E::COMPARES)
    }

    /// Whether paths start at lights, too. In scenes where they cannot, the estimator works like `mis`.
    pub fn traces_light_paths(self) -> bool {
        in_estimator!(self, E => E::TRACES_LIGHT_PATHS)
    }

    /// Whether these are connected with all vertices of camera paths, and not only with the camera.
    pub fn connects(self) -> bool {
        in_estimator!(self, E => E::CONNECTS)
    }

    /// Whether light paths end at the first surface that scatters light in more than one direction.
    pub fn traces_only_caustics(self) -> bool {
        in_estimator!(self, E => E::ONLY_CAUSTICS)
    }

    /// The weight of an emitter hit that light sampling could have found, with the pdf of its direction and the pdf of light sampling,
    /// both per solid angle; the latter is read only if the estimator [compares](Self::compares).
    #[inline(always)]
    pub fn hit_weight<L: Lanes>(self, l: L, pdf: F<L>, of_light: F<L>) -> F<L> {
        in_estimator!(self, E => E::hit_weight(l, pdf, of_light))
    }

    /// The weight of a light sample with its pdf, and the pdf of its direction by the BSDF, both per solid angle.
    #[inline(always)]
    pub fn light_weight<L: Lanes>(self, l: L, pdf: F<L>, of_bsdf: F<L>) -> F<L> {
        in_estimator!(self, E => E::light_weight(l, pdf, of_bsdf))
    }

    /// How it finds light, in words.
    pub fn strategies(self) -> &'static str {
        in_estimator!(self, E => E::STRATEGIES)
    }
}

/// A kind of estimator: the weights of the two strategies that find light.
trait Weighting {
    const WORD: Word;

    /// See [`Estimator::strategies`].
    const STRATEGIES: &'static str;

    /// Whether lights are sampled, in addition to emitter hits.
    const SAMPLES_LIGHTS: bool = true;

    /// Whether a weight depends on the pdf of the other strategy.
    const COMPARES: bool = false;

    /// See [`Estimator::traces_light_paths`].
    const TRACES_LIGHT_PATHS: bool = false;

    /// See [`Estimator::connects`].
    const CONNECTS: bool = false;

    /// See [`Estimator::traces_only_caustics`].
    const ONLY_CAUSTICS: bool = false;

    /// See [`Estimator::hit_weight`].
    #[inline(always)]
    fn hit_weight<L: Lanes>(_l: L, pdf: F<L>, of_light: F<L>) -> F<L> {
        power_heuristic(pdf, of_light)
    }

    /// See [`Estimator::light_weight`].
    #[inline(always)]
    fn light_weight<L: Lanes>(l: L, pdf: F<L>, of_bsdf: F<L>) -> F<L> {
        if Self::COMPARES { power_heuristic(pdf, of_bsdf) } else { l.f(1.0) }
    }
}
