//! Multiple importance sampling with the power heuristic (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997).
use super::Weighting;
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

/// Emitter hits and light samples count, combined by the power heuristic.
pub(super) struct Mis;

impl Weighting for Mis {
    const WORD: Word = Word {
        name: "mis",
        title: "MIS",
        doc: "Combines BSDF and light sampling, weighted by their pdfs (multiple importance sampling).",
    };
    const STRATEGIES: &'static str = "camera paths that hit a light and samples of lights, weighted by the power heuristic";
    const COMPARES: bool = true;
}

/// The power heuristic with exponent 2 (Veach 1997, section 9.2): the weight of a sample with pdf `pdf`, whose pdf by another strategy
/// is `other`.
#[inline(always)]
pub fn power_heuristic<L: Lanes>(pdf: F<L>, other: F<L>) -> F<L> {
    let ratio = other / pdf;
    1.0 / (1.0 + ratio * ratio)
}
