//! Images of scenes in the tests.
pub use noisefall_kernel::measure::{Mean, Measure, Picture, picture};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, parse},
};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::statistics::SIGMAS;

/// The scene of a text without its `format` line.
pub fn scene(text: &str) -> Scene {
    parse("inline.toml", format!("format = 1\n{text}")).unwrap_or_else(|error| panic!("{error:?}\n{text}"))
}

/// Settings with independent samples, whose variance gives the standard error.
pub fn settings(estimator: Estimator) -> RenderSettings {
    RenderSettings {
        estimator,
        sampler: Sampler::Independent,
        directions: Directions::Cosine,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        merging: false,
        count_crossings: false,
        reuse: Reuse::Off,
        adaptive: false,
        // Estimators that are compared with each other share no random numbers.
        seed: 17 + estimator as u32,
        strategy: None,
        fault: None,
    }
}

/// The estimators whose paths start at the camera, some of them at lights, too. `light_tracing` finds no view as small as a point, and `auto` is
/// one of the others.
pub const WITH_CAMERA_PATHS: [Estimator; 5] =
    [Estimator::Path, Estimator::Light, Estimator::Mis, Estimator::Caustics, Estimator::Bidirectional];

pub const RED: Measure = |radiance| f64::from(radiance[0]);
pub const GREEN: Measure = |radiance| f64::from(radiance[1]);
pub const BLUE: Measure = |radiance| f64::from(radiance[2]);
pub const LUMINANCE: Measure = |[r, g, b, _]| f64::from(noisefall_base::math::colour::luminance([r, g, b]));

/// The number of standard errors that the largest of `count` deviations exceeds as rarely as a single one exceeds [`SIGMAS`]
/// (Bonferroni's bound).
pub fn sigmas_of_most(count: usize) -> f64 {
    let normal = Normal::new(0.0, 1.0).expect("a normal distribution");
    -normal.inverse_cdf(normal.cdf(-SIGMAS) / count as f64)
}

/// Checks that all deviations are within the limit for their number.
pub fn assert_all_within(deviations: &[f64], what: &str) {
    assert!(!deviations.is_empty(), "{what}: nothing to compare");
    let most = sigmas_of_most(deviations.len());
    let worst = deviations.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (place, z) = worst.expect("not empty");
    println!("{what}: worst of {} is {z:.2} σ at {place}, allowed {most:.2}", deviations.len());
    assert!(z.abs() < most, "{what}: number {place} of {} deviates by {z:.2} σ, allowed are {most:.2}", deviations.len());
}
