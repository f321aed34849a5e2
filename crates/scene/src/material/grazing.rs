//! Sampling of directions in which shadowing loses light: cosines around α, and a tail like 1/μ² above.
//!
//! The loss is roughly μ/(a² + μ²) per cosine, with a = 2α. The inverse of its distribution needs more than roots. Those of
//! μ/(a² + μ²)^½ and μ/(a² + μ²)^(3/2) need only roots. The loss is their geometric mean, so an equal mixture of both is nowhere
//! much smaller.
use std::f32::consts::TAU;

use noisefall_base::math::{F, Lanes, Pick, V, trig::sin_cos_turns};

/// Samples a direction of the hemisphere; `half` in [0, 1) chooses between the distributions.
#[inline(always)]
pub fn sample<L: Lanes>(alpha: F<L>, u: (F<L>, F<L>), half: F<L>) -> V<L> {
    let a = 2.0 * alpha;
    let b = (1.0 + a * a).sqrt();
    // s = √(a² + μ²), from a to b.
    let rise = u.0 * (b - a);
    let (s_flat, rise_flat) = (a + rise, rise);
    let s_steep = a * b / (b - rise);
    let rise_steep = s_steep * rise / b;
    let flat = half.below(0.5);
    let s = flat.pick(s_flat, s_steep);
    let z = (flat.pick(rise_flat, rise_steep) * (s + a)).sqrt().min(a.splat(1.0));
    let (sin, cos) = sin_cos_turns(u.1);
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    V { x: r * cos, y: r * sin, z }
}

/// Pdf of [`sample`] at cosine `mu` ≥ 0, per solid angle.
#[inline(always)]
pub fn pdf<L: Lanes>(alpha: F<L>, mu: F<L>) -> F<L> {
    let a = 2.0 * alpha;
    let b = (1.0 + a * a).sqrt();
    let s2 = a * a + mu * mu;
    // 1/(b − a) of the one and 1/(1/a − 1/b) of the other.
    (0.5 / TAU) * mu * (1.0 + a * b / s2) / ((b - a) * s2.sqrt())
}
