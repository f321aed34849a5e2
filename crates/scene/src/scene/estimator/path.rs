//! Plain path tracing (Kajiya, "The Rendering Equation", SIGGRAPH 1986).
use super::Weighting;
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

/// Only emitter hits of paths count, and light samples of punctual lights, which no path can hit.
pub(super) struct Path;

impl Weighting for Path {
    const WORD: Word = Word {
        name: "path",
        title: "BSDF sampling",
        doc: "Finds lights only by hitting them; punctual lights are sampled. The simplest estimator; very noisy for small lights.",
    };
    const STRATEGIES: &'static str = "camera paths that hit a light; samples of punctual lights";
    const SAMPLES_LIGHTS: bool = false;

    #[inline(always)]
    fn hit_weight<L: Lanes>(l: L, _: F<L>, _: F<L>) -> F<L> {
        l.f(1.0)
    }
}
