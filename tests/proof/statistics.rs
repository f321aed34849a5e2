//! Statistics of samples.
pub use noisefall_kernel::measure::{Moments, samples};

/// Limit of deviations in these tests, in standard errors.
pub const SIGMAS: f64 = 4.0;

pub fn assert_within(z: f64, what: &str) {
    assert!(z.abs() < SIGMAS, "{what}: {z:.2} σ");
}
