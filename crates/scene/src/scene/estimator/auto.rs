//! The estimator that a trial of the scene chooses.
use super::Weighting;
use noisefall_base::declare::Word;

/// `mis` or `bidirectional`, by a trial of the scene. The integrator itself treats it as `mis`.
pub(super) struct Auto;

impl Weighting for Auto {
    const WORD: Word = Word {
        name: "auto",
        title: "Auto",
        doc: "Tries MIS and Bidirectional on a small image, once per scene, and takes the one with the least error at equal cost.",
    };
    const STRATEGIES: &'static str = "those of `mis` or of `bidirectional`, whichever has less error at equal cost in a trial";
    const COMPARES: bool = true;
}
