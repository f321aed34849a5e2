//! The estimator that a trial of the scene chooses.
use super::{Strategy, power_heuristic};
use crate::{
    declare::Word,
    math::{F, Lanes},
};

/// `mis` or `bidirectional`, by a trial of the scene. The integrator itself treats it as `mis`.
pub(super) struct Auto;

impl Strategy for Auto {
    const WORD: Word = Word {
        name: "auto",
        title: "Auto",
        doc: "Tries MIS and Bidirectional on a small image, once per scene, and takes the one with the least error at equal cost.",
    };
    const COMPARISON: &'static str = "Estimator by trial";
    const COMPARES: bool = true;

    #[inline(always)]
    fn hit_weight<L: Lanes>(_: L, pdf: F<L>, of_light: F<L>) -> F<L> {
        power_heuristic(pdf, of_light)
    }

    #[inline(always)]
    fn light_weight<L: Lanes>(_: L, pdf: F<L>, of_bsdf: F<L>) -> F<L> {
        power_heuristic(pdf, of_bsdf)
    }
}
