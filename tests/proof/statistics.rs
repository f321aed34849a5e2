//! What statistics says of samples.
pub use noisefall::measure::{Moments, samples};

/// The statements of these tests hold at this many standard deviations.
pub const SIGMAS: f64 = 4.0;

pub fn assert_within(z: f64, what: &str) {
    assert!(z.abs() < SIGMAS, "{what}: {z:.2} σ");
}
