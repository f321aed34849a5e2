//! Light tracing (J. Arvo, "Backward Ray Tracing", 1986; P. Dutré, E. Lafortune and Y. Willems, "Monte Carlo Light Tracing with Direct
//! Computation of Pixel Intensities", 1993).
use super::Weighting;
use noisefall_base::declare::Word;

/// Paths start at lights. Every surface point that they reach is connected to the camera.
///
/// Mirrors and clear glass cannot be connected to the camera. Their light comes from camera paths, as with `mis`.
pub(super) struct LightTracing;

impl Weighting for LightTracing {
    const WORD: Word = Word {
        name: "light_tracing",
        title: "Light tracing",
        doc: "Traces light paths, and connects each of their vertices to the camera. Good for caustics, noisy for other light.",
    };
    const STRATEGIES: &'static str = "light paths, each vertex connected to the camera; those of `mis` at mirrors and clear glass that the camera sees; balance heuristic";
    const COMPARES: bool = true;
    const TRACES_LIGHT_PATHS: bool = true;
}
