//! Path tracing with caustics by light tracing.
use super::Weighting;
use noisefall_base::declare::Word;

/// Paths from lights go through mirrors and clear glass to the first other surface, and are joined with the camera there. All other light
/// comes from paths from the camera.
pub(super) struct Caustics;

impl Weighting for Caustics {
    const WORD: Word = Word {
        name: "caustics",
        title: "MIS + light tracing",
        doc: "MIS, plus light tracing for the caustics of mirrors and clear glass. Cheaper than Bidirectional.",
    };
    const STRATEGIES: &'static str =
        "those of `mis`, and light paths through mirrors and clear glass, joined with the camera; balance heuristic";
    const COMPARES: bool = true;
    const TRACES_LIGHT_PATHS: bool = true;
    const ONLY_CAUSTICS: bool = true;
}
