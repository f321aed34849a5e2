//! Absorption inside tinted media: Beer's law.
use super::work::Work;
use noisefall_base::math::{F, Lanes, U, V, exp::exp2_of_negative};

/// Maximum distance. Over longer ones the transmittance is 0 or 1.
const FARTHEST: f32 = 1e30;

/// Transmittance of the innermost of `media` over `t` metres.
#[inline(always)]
pub(super) fn transmittance<L: Lanes>(l: L, work: &Work, media: U<L>, t: F<L>) -> V<L> {
    let [r, g, b, _] = l.rows(&work.scene.surfaces.media, media & 0xff);
    let way = t.min(l.f(FARTHEST));
    V { x: exp2_of_negative(-(r * way)), y: exp2_of_negative(-(g * way)), z: exp2_of_negative(-(b * way)) }
}

/// The media around a path after it passes through a surface, into its medium or out of the innermost.
#[inline(always)]
pub(super) fn beyond<L: Lanes>(media: U<L>, medium: U<L>, enters: noisefall_base::math::M<L>) -> U<L> {
    use noisefall_base::math::Pick;
    enters.pick((media << 8) | medium, media >> 8)
}
