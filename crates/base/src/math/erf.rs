//! The error function and its inverse by polynomials instead of the standard library, so that every processor gives the same bits.
use std::f32::consts::{LN_2, LOG2_E};

use super::{
    exp::{exp2_of_negative, log2},
    lanes::{F, Lanes},
    number::Pick,
};

/// exp(−x²), with a relative error of about 1e-7 x².
#[inline(always)]
pub fn bell<L: Lanes>(x: F<L>) -> F<L> {
    exp2_of_negative(-(x * x * LOG2_E))
}

/// erf x within 6e-7. M. Abramowitz and I. Stegun, "Handbook of Mathematical Functions", 1964, formula 7.1.26.
#[inline(always)]
pub fn erf<L: Lanes>(x: F<L>) -> F<L> {
    let t = 1.0 / (1.0 + x.abs() * 0.327_591_1);
    let p = t * 1.061_405_4 - 1.453_152;
    let p = p * t + 1.421_413_7;
    let p = p * t - 0.284_496_72;
    let p = p * t + 0.254_829_6;
    (1.0 - p * t * bell(x)).copysign(x)
}

/// The x with erf x = y, within 2e-6 for |y| ≤ 1 − 1e-6. M. Giles, "Approximating the erfinv Function", GPU Computing Gems, 2012.
#[inline(always)]
pub fn inverse_erf<L: Lanes>(y: F<L>) -> F<L> {
    let w = log2((1.0 - y) * (1.0 + y)) * -LN_2;
    let c = w - 2.5;
    let p = c * 2.810_226_4e-8 + 3.432_739_4e-7;
    let p = p * c - 3.523_387_7e-6;
    let p = p * c - 4.391_506_5e-6;
    let p = p * c + 2.185_808_7e-4;
    let p = p * c - 1.253_725_1e-3;
    let p = p * c - 4.177_681_6e-3;
    let p = p * c + 0.246_640_73;
    let p = p * c + 1.501_409_4;
    let s = w.max(w.splat(0.0)).sqrt() - 3.0;
    let q = s * -2.002_142_6e-4 + 1.009_505_6e-4;
    let q = q * s + 1.349_343_2e-3;
    let q = q * s - 3.673_428_4e-3;
    let q = q * s + 5.739_507_7e-3;
    let q = q * s - 7.622_461_3e-3;
    let q = q * s + 9.438_870_5e-3;
    let q = q * s + 1.001_674;
    let q = q * s + 2.832_976_8;
    w.below(5.0).pick(p, q) * y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::One;

    #[test]
    fn the_error_function_is_that_of_the_standard_tables() {
        // Abramowitz and Stegun, table 7.1.
        let table =
            [(0.0f32, 0.0f32), (0.1, 0.112_462_92), (0.5, 0.520_499_9), (1.0, 0.842_700_8), (2.0, 0.995_322_3), (6.0, 1.0)];
        for (x, exact) in table {
            for (x, exact) in [(x, exact), (-x, -exact)] {
                assert!((erf(F::<One>(x)).0 - exact).abs() < 6e-7, "{x}: {}", erf(F::<One>(x)).0);
            }
        }
    }

    #[test]
    fn the_error_function_is_the_integral_of_the_bell() {
        const STEPS: u32 = 40_000;
        let mut sum = 0.0f64;
        for step in 0..STEPS {
            let width = 4.0 / f64::from(STEPS);
            let x = (f64::from(step) + 0.5) * width;
            sum += (-x * x).exp() * width * std::f64::consts::FRAC_2_SQRT_PI;
            let end = (x + 0.5 * width) as f32;
            assert!((f64::from(erf(F::<One>(end)).0) - sum).abs() < 7e-7, "{end}");
            let exact = (-f64::from(end) * f64::from(end)).exp();
            assert!((f64::from(bell(F::<One>(end)).0) - exact).abs() < 3e-6 * exact, "{end}");
        }
    }

    #[test]
    fn the_inverse_inverts() {
        for i in -9999..=9999 {
            let y = i as f32 * 1e-4;
            let x = inverse_erf(F::<One>(y));
            assert!((erf(x).0 - y).abs() < 3e-6 && (x.0 >= 0.0) == (y >= 0.0), "{y}: {}", x.0);
        }
        assert!((inverse_erf(F::<One>(0.999_999)).0 - 3.458_91).abs() < 0.02 && inverse_erf(F::<One>(0.0)).0 == 0.0);
    }
}
