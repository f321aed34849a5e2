//! Path tracing with caustics by light tracing.
use super::Weighting;
use noisefall_base::declare::Word;

/// Light paths go through mirrors and clear glass to the first other surface, and are connected to the camera there. All other light
/// comes from camera paths.
pub(super) struct Caustics;

impl Weighting for Caustics {
    const WORD: Word = Word {
        name: "caustics",
        title: "MIS + light tracing",
        doc: "MIS, plus light tracing for the caustics of mirrors and clear glass. Cheaper than Bidirectional.",
    };
    const STRATEGIES: &'static str =
        "those of `mis`, and light paths through mirrors and clear glass, connected to the camera; balance heuristic";
    const COMPARES: bool = true;
    const TRACES_LIGHT_PATHS: bool = true;
    const ONLY_CAUSTICS: bool = true;
}
