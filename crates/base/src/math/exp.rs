//! Powers of two and logarithms by polynomials instead of the standard library, so that every processor gives the same bits.
use super::{
    lanes::{F, Lanes},
    number::Pick,
    round::floor,
};

/// 2ˣ for x ≤ 0, with a relative error below 2e-7; smaller values than 2⁻¹²⁶ are clamped to it.
#[inline(always)]
pub fn exp2_of_negative<L: Lanes>(x: F<L>) -> F<L> {
    let (whole, bits) = floor(x.max(x.splat(-126.0)));
    let t = x.max(x.splat(-126.0)) - whole;
    // The Taylor series of 2ᵗ with its last terms adjusted for t in [0, 1).
    let p = t * 2.186_85e-4 + 1.238_824e-3;
    let p = p * t + 9.684_73e-3;
    let p = p * t + 5.548_05e-2;
    let p = p * t + 2.402_303e-1;
    let p = p * t + 6.931_470_6e-1;
    let p = p * t + 1.0;
    p * ((bits + 127) << 23).as_real_bits()
}

/// log₂ x for x > 0, within 1e-6 of the larger of 1 and its size; smaller values than 2⁻¹²⁶ are clamped to it.
#[inline(always)]
pub fn log2<L: Lanes>(x: F<L>) -> F<L> {
    let bits = x.max(x.splat(f32::MIN_POSITIVE)).bits();
    let whole = (bits >> 23).to_real() - 127.0;
    let m = ((bits & 0x7f_ffff) | 0x3f80_0000).as_real_bits();
    let large = m.above(std::f32::consts::SQRT_2);
    let m = large.pick(m * 0.5, m);
    // log₂ m = 2 artanh(s)/ln 2 with s = (m − 1)/(m + 1), |s| < 0.172.
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let series = ((s2 * (1.0 / 7.0) + 0.2) * s2 + 1.0 / 3.0) * s2 + 1.0;
    large.pick(whole + 1.0, whole) + s * series * (2.0 * std::f32::consts::LOG2_E)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::One;

    #[test]
    fn powers_of_two_are_accurate() {
        let error = |i: i32| {
            let x = -f64::from(i) / 1000.0;
            (f64::from(exp2_of_negative(F::<One>(x as f32)).0) / f64::from(x as f32).exp2() - 1.0).abs()
        };
        let worst = (0..125_000).map(error).fold(0.0, f64::max);
        assert!(worst < 4e-7, "{worst:e}");
        assert_eq!(exp2_of_negative(F::<One>(0.0)).0, 1.0);
        assert!(exp2_of_negative(F::<One>(f32::NEG_INFINITY)).0 < 1e-37);
    }

    #[test]
    fn logarithms_are_those_of_the_standard_library() {
        for i in 1..100_000u32 {
            let x = (i as f32 / 1000.0).powi(3) * 1e-6;
            let (found, exact) = (f64::from(log2(F::<One>(x)).0), f64::from(x).log2());
            assert!((found - exact).abs() < 1e-6 * exact.abs().max(1.0), "{x}: {found} {exact}");
        }
        assert_eq!([log2(F::<One>(1.0)).0, log2(F::<One>(8.0)).0, log2(F::<One>(0.0)).0], [0.0, 3.0, -126.0]);
    }
}
