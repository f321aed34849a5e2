//! Exponential, logarithm, sine and cosine of any number by polynomials instead of the standard library, so that every processor
//! gives the same bits.
//!
//! exp and log are the polynomials of S. Moshier's Cephes library (single/expf.c, single/logf.c). The bounds below are checked
//! by `tests/functions.rs`; the affine forms in `affine_form.rs` rely on them.
use noisefall_base::math::{F, Lanes, Pick, round::floor, trig::sin_cos_eighth};

/// |exp computed − exp| ≤ this · exp, plus [`EXP_END`].
pub(super) const EXP_ERROR: f32 = 2.0e-7;
/// Lower bound of the computed exp.
pub(super) const EXP_END: f32 = 1.25e-38;
/// |log computed − log| ≤ this · (1 + |log|)
pub(super) const LOG_ERROR: f32 = 1.2e-7;
/// |sin computed − sin x| ≤ this · (|x| + |sin x|), and so for cos.
pub(super) const SIN_ERROR: f32 = 1.5e-7;

/// eˣ; infinite from 88.7, where it would overflow, and about the smallest normal number below −87.3.
#[inline(always)]
pub(super) fn exp<L: Lanes>(x: F<L>) -> F<L> {
    // ln 2 in two parts, of which the first has so few bits that its multiples are exact.
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let clamped = x.min(x.splat(88.02)).max(x.splat(-87.3));
    let (whole, bits) = floor(clamped * std::f32::consts::LOG2_E + 0.5);
    let t = clamped - whole * LN_2_HIGH - whole * LN_2_LOW;
    let p = t * 1.987_569_2e-4 + 1.398_2e-3;
    let p = p * t + 8.333_452e-3;
    let p = p * t + 4.166_579_6e-2;
    let p = p * t + 1.666_666_5e-1;
    let p = p * t + 0.5;
    let p = p * (t * t) + t + 1.0;
    x.above(88.02).pick(x.splat(f32::INFINITY), p * ((bits + 127) << 23).as_real_bits())
}

/// The natural logarithm of x, or of the smallest normal number when that is larger.
#[inline(always)]
pub(super) fn log<L: Lanes>(x: F<L>) -> F<L> {
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let bits = x.max(x.splat(f32::MIN_POSITIVE)).bits();
    let mantissa = ((bits & 0x007f_ffff) | 0x3f00_0000).as_real_bits();
    let exponent = (bits >> 23).to_real() - 126.0;
    // The mantissa between √½ and √2, minus 1.
    let low = mantissa.below(std::f32::consts::FRAC_1_SQRT_2);
    let exponent = low.pick(exponent - 1.0, exponent);
    let t = low.pick(mantissa + mantissa, mantissa) - 1.0;
    let p = t * 7.037_683_6e-2 - 1.151_461e-1;
    let p = p * t + 1.167_699_9e-1;
    let p = p * t - 1.242_014_1e-1;
    let p = p * t + 1.424_932_3e-1;
    let p = p * t - 1.666_805_8e-1;
    let p = p * t + 2.000_071_5e-1;
    let p = p * t - 2.499_999_4e-1;
    let p = p * t + 3.333_333e-1;
    let t2 = t * t;
    let p = p * t * t2 + exponent * LN_2_LOW - t2 * 0.5;
    t + p + exponent * LN_2_HIGH
}

/// (sin x, cos x). The argument is converted to quarter turns, so its rounding error is up to ε|x|; beyond 6·10⁶ no digits
/// remain, and the result is (0, 1).
#[inline(always)]
pub(super) fn sin_cos<L: Lanes>(x: F<L>) -> (F<L>, F<L>) {
    const FARTHEST: f32 = 4_194_000.0;
    let quarters = x * std::f32::consts::FRAC_2_PI;
    let known = quarters.abs().below(FARTHEST);
    let quarters = known.pick(quarters, x.splat(0.0));
    let (whole, bits) = floor(quarters + 0.5);
    let (sin, cos) = sin_cos_eighth((quarters - whole) * 2.0);
    // A quarter turn makes (sin, cos) into (cos, −sin).
    let swapped = (bits & 1).is(1);
    let (s, c) = (swapped.pick(cos, sin), swapped.pick(sin, cos));
    let sin_negative = (bits & 2).is(2);
    let cos_negative = ((bits + 1) & 2).is(2);
    (sin_negative.pick(-s, s), cos_negative.pick(-c, c))
}
