//! Exponential, logarithm, sine and cosine against f64.
use super::super::functions::{EXP_END, EXP_ERROR, LOG_ERROR, SIN_ERROR, exp, log, sin_cos};
use noisefall_base::math::{F, One};

/// Every 97th number from `low` to `high` in size, with both signs.
fn numbers(low: f32, high: f32) -> impl Iterator<Item = f32> {
    (low.to_bits()..high.to_bits()).step_by(97).flat_map(|bits| [f32::from_bits(bits), -f32::from_bits(bits)])
}

#[test]
fn exponentials_are_within_their_bound() {
    let error = |x: f32| {
        let exact = f64::from(x).exp();
        if x > 88.02 {
            return 0.0;
        }
        (f64::from(exp(F::<One>(x)).0) - exact).abs() / (f64::from(EXP_ERROR) * exact + f64::from(EXP_END))
    };
    let worst = numbers(1e-9, 88.7).map(error).fold(0.0, f64::max);
    assert!(worst < 1.0, "{worst} of the bound");
    assert_eq!(exp(F::<One>(100.0)).0, f32::INFINITY);
    assert!(exp(F::<One>(-1e30)).0 < EXP_END);
}

#[test]
fn logarithms_are_within_their_bound() {
    let error = |x: f32| {
        let exact = f64::from(x).ln();
        (f64::from(log(F::<One>(x)).0) - exact).abs() / (f64::from(LOG_ERROR) * (1.0 + exact.abs()))
    };
    let worst = numbers(1.2e-38, 3e38).filter(|x| *x > 0.0).map(error).fold(0.0, f64::max);
    assert!(worst < 1.0, "{worst} of the bound");
    assert!((log(F::<One>(-5.0)).0 + 87.336_55).abs() < 1e-4);
}

#[test]
fn sines_and_cosines_are_within_their_bound() {
    let error = |x: f32| {
        let (sin, cos) = sin_cos(F::<One>(x));
        let exact = f64::from(x);
        let of = |computed: f32, of: f64| (f64::from(computed) - of).abs() / (f64::from(SIN_ERROR) * (exact.abs() + of.abs()));
        of(sin.0, exact.sin()).max(of(cos.0, exact.cos()))
    };
    let worst = numbers(1e-6, 6e6).map(error).fold(0.0, f64::max);
    assert!(worst < 1.0, "{worst} of the bound");
}
