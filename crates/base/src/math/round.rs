//! Rounding of reals to integers.
use super::{
    lanes::{F, Lanes, U},
    number::Pick,
};

/// The greatest integer not above x, as a real and in two's complement. Exact for |x| ≤ 2²²; larger values are clamped to ±2²²,
/// and NaN gives 2²².
#[inline(always)]
pub fn floor<L: Lanes>(x: F<L>) -> (F<L>, U<L>) {
    // Among the reals near 1.5 · 2²³ neighbours are 1 apart: adding it rounds, and leaves the integer in the last bits.
    const ROUNDER: f32 = 12_582_912.0;
    const REACH: f32 = 4_194_304.0;
    let x = x.min(x.splat(REACH)).max(x.splat(-REACH));
    let rounded = x + ROUNDER;
    let nearest = rounded - ROUNDER;
    let above = x.lt(nearest);
    let bits = rounded.bits() + ROUNDER.to_bits().wrapping_neg();
    (above.pick(nearest - 1.0, nearest), above.pick(bits + u32::MAX, bits))
}
