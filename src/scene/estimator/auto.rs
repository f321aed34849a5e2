//! The estimator that a trial of the scene chooses.
use super::{Strategy, power_heuristic};
use crate::{
    declare::Word,
    math::{F, Lanes},
};

/// `bidirectional` if a short trial of the scene shows a gain, else `mis`. The integrator itself treats it as `mis`.
pub(super) struct Auto;

impl Strategy for Auto {
    const WORD: Word = Word {
        name: "auto",
        title: "By trial",
        doc: "Bidirectional if a short trial of the scene shows less noise at equal cost, else MIS. The decision is made once per scene.",
    };
    const COMPARISON: &'static str = "The estimator by trial";
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
