//! Powers of two by a polynomial instead of the standard library, so that every processor gives the same bits.
use super::{
    lanes::{F, Lanes},
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::One;

    #[test]
    fn powers_of_two_are_what_they_should_be() {
        let error = |i: i32| {
            let x = -f64::from(i) / 1000.0;
            (f64::from(exp2_of_negative(F::<One>(x as f32)).0) / f64::from(x as f32).exp2() - 1.0).abs()
        };
        let worst = (0..125_000).map(error).fold(0.0, f64::max);
        assert!(worst < 4e-7, "{worst:e}");
        assert_eq!(exp2_of_negative(F::<One>(0.0)).0, 1.0);
        assert!(exp2_of_negative(F::<One>(f32::NEG_INFINITY)).0 < 1e-37);
    }
}
