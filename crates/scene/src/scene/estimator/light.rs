//! Next-event estimation: only light samples count, except for lights seen directly or by specular paths.
use super::Weighting;
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

/// Only light samples count, except for lights seen directly or by specular paths.
pub(super) struct Light;

impl Weighting for Light {
    const WORD: Word = Word {
        name: "light",
        title: "Light sampling",
        doc: "Every surface point samples a light (next-event estimation). Noisy for glossy surfaces and large lights.",
    };
    const STRATEGIES: &'static str = "samples of lights; camera paths that hit a light directly or after mirrors and clear glass";

    #[inline(always)]
    fn hit_weight<L: Lanes>(l: L, _: F<L>, _: F<L>) -> F<L> {
        l.f(0.0)
    }
}
