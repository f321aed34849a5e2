//! The χ² test of counts against expectations, for tests.
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Bins that expect less are taken together.
const LEAST: f64 = 8.0;

/// The probability of a χ² at least as large as that of these counts; 1 if fewer than two bins expect enough.
pub fn chi_squared(observed: &[f64], expected: &[f64]) -> f64 {
    chi_squared_with(observed, expected, 0.0)
}

/// [`chi_squared`] for expectations that are known to a relative standard error.
pub fn chi_squared_with(observed: &[f64], expected: &[f64], relative_error: f64) -> f64 {
    assert_eq!(observed.len(), expected.len());
    let pairs = || observed.iter().copied().zip(expected.iter().copied());
    let rare = pairs().filter(|(_, e)| *e < LEAST).fold((0.0, 0.0), |(a, b), (o, e)| (a + o, b + e));
    let bins = || pairs().chain([rare]).filter(|(_, e)| *e >= LEAST);
    let degrees = bins().count() as f64 - 1.0;
    let statistic: f64 = bins().map(|(o, e)| (o - e).powi(2) / (e + (relative_error * e).powi(2))).sum();
    ChiSquared::new(degrees).map_or(1.0, |distribution| distribution.sf(statistic))
}

#[test]
fn chi_squared_is_exponential_with_two_degrees_of_freedom() {
    // χ² = 3 · 10²/100, and the survival function is exp(−χ²/2).
    let p = chi_squared(&[110.0, 90.0, 110.0, 3.0], &[100.0, 100.0, 100.0, 3.0]);
    assert!((p - (-1.5f64).exp()).abs() < 1e-12, "{p}");
    assert_eq!(chi_squared(&[9.0], &[10.0]), 1.0);
    // The error of the expectations doubles the variance: χ² = 1.
    let p = chi_squared_with(&[110.0, 90.0], &[100.0, 100.0], 0.1);
    assert!((p - 0.317_310_507_862_9).abs() < 1e-9, "{p}");
}
