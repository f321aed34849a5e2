//! Bidirectional path tracing (E. Lafortune and Y. Willems 1993; E. Veach and L. Guibas 1994).
use super::Weighting;
use noisefall_base::declare::Word;

/// Connects all vertices of camera paths with all vertices of light paths.
pub(super) struct Bidirectional;

impl Weighting for Bidirectional {
    const WORD: Word = Word {
        name: "bidirectional",
        title: "Bidirectional",
        doc: "Connects camera paths and light paths in all ways (s, t), weighted by the balance heuristic. Good for caustics and hidden lights.",
    };
    const STRATEGIES: &'static str =
        "(s, t): s vertices from a light connected to t from the camera, in all ways; balance heuristic";
    const COMPARES: bool = true;
    const TRACES_LIGHT_PATHS: bool = true;
    const CONNECTS: bool = true;
}
