//! The furnace: a closed sphere that emits L_e = 1 inside and reflects ρ = 0.5. Its radiance is L_e/(1 − ρ) = 2 everywhere.
//!
//! A sample is X = Σ_k ρᵏ w₁ … w_k with independent weights w of mean 1: 2 cos θ for uniform directions, 1 for cosine ones, and
//! 1/q or 0 for roulette. `measure::exact::furnace_variance` derives Var X.
use noisefall_kernel::measure::exact::{furnace, furnace_capped, furnace_variance};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, load},
};

use crate::statistics::{Moments, assert_within, samples};

const LE: f64 = 1.0;
const ALBEDO: f64 = 0.5;

fn scene() -> Scene {
    load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/furnace.toml").as_ref()).expect("a shipped scene compiles")
}

fn settings(directions: Directions) -> RenderSettings {
    RenderSettings {
        estimator: Estimator::Path,
        sampler: Sampler::Independent,
        directions,
        roulette: Roulette::Off,
        max_bounces: None,
        merging: false,
        count_crossings: false,
        reuse: Reuse::Off,
        adaptive: false,
        seed: 11,
        strategy: None,
        fault: None,
    }
}

fn moments(settings: RenderSettings, spp: u32) -> Moments {
    Moments::of(samples(&scene(), settings, spp).iter().flatten().copied())
}

#[test]
fn without_a_cap_it_converges_to_the_exact_radiance() {
    for directions in Directions::ALL {
        let found = moments(settings(directions), 500);
        if directions == Directions::Cosine {
            // Every weight is 1: each sample is the series itself, summed until it underflows.
            assert_eq!((found.mean, found.variance), (furnace(LE, ALBEDO), 0.0));
        } else {
            assert_within(found.z_with(furnace(LE, ALBEDO), furnace_variance(LE, ALBEDO, 4.0 / 3.0)), "uniform directions");
        }
    }
}

#[test]
fn with_a_cap_it_converges_to_the_partial_sum_and_differs_from_the_truth_by_that_bias() {
    for cap in 0..=8 {
        let found = moments(RenderSettings { max_bounces: Some(cap), ..settings(Directions::Uniform) }, 6000);
        let exact = furnace_capped(LE, ALBEDO, cap);
        if cap == 0 {
            assert_eq!((found.mean, found.variance), (exact, 0.0));
        } else {
            assert_within(found.z(exact), &format!("cap {cap}"));
            assert!(found.z(furnace(LE, ALBEDO)) < -10.0, "the bias of cap {cap} must be plain to see");
        }
    }
}

#[test]
fn with_cosine_directions_each_single_sample_is_the_partial_sum() {
    for cap in 0..=8 {
        for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol] {
            let settings = RenderSettings { max_bounces: Some(cap), sampler, ..settings(Directions::Cosine) };
            let exact = furnace_capped(LE, ALBEDO, cap);
            assert!(samples(&scene(), settings, 16).iter().flatten().all(|x| *x == exact), "cap {cap}, {sampler:?}");
        }
    }
}

#[test]
fn roulette_is_unbiased_at_every_survival_probability() {
    for percent in [30, 40, 50, 60, 70, 80, 90, 95] {
        let q = f64::from(percent) / 100.0;
        let found = moments(RenderSettings { roulette: Roulette::fixed(q as f32), ..settings(Directions::Cosine) }, 2000);
        assert_within(found.z_with(furnace(LE, ALBEDO), furnace_variance(LE, ALBEDO, 1.0 / q)), &format!("q = {q}"));
    }
    for start in [0, 1, 4] {
        for directions in Directions::ALL {
            let found = moments(RenderSettings { roulette: Roulette::by_throughput_from(start), ..settings(directions) }, 2000);
            assert_within(found.z(furnace(LE, ALBEDO)), &format!("by throughput from {start}, {directions:?}"));
        }
    }
}

#[test]
fn the_variance_is_the_closed_form() {
    let uniform = moments(settings(Directions::Uniform), 2000);
    assert_within(uniform.z_of_variance(furnace_variance(LE, ALBEDO, 4.0 / 3.0)), "uniform directions");
    for q in [0.8, 0.9] {
        let roulette = Roulette::fixed(q as f32);
        let cosine = moments(RenderSettings { roulette, ..settings(Directions::Cosine) }, 2000);
        assert_within(cosine.z_of_variance(furnace_variance(LE, ALBEDO, 1.0 / q)), &format!("roulette {q}"));
        let both = moments(RenderSettings { roulette, ..settings(Directions::Uniform) }, 2000);
        assert_within(both.z_of_variance(furnace_variance(LE, ALBEDO, 4.0 / (3.0 * q))), &format!("uniform, roulette {q}"));
    }
}

#[test]
fn the_variance_of_the_mean_falls_as_one_over_n() {
    let exact = furnace_variance(LE, ALBEDO, 4.0 / 3.0);
    let pixels = samples(&scene(), settings(Directions::Uniform), 1024);
    for spp in [1, 4, 16, 64, 256, 1024] {
        let means: Vec<f64> = pixels.iter().map(|samples| samples[..spp].iter().sum::<f64>() / spp as f64).collect();
        let found = Moments::of(means.iter().copied());
        assert_within(found.z_of_variance(exact / spp as f64), &format!("{spp} spp"));
    }
}

#[test]
fn better_samplers_are_unbiased_too_and_have_less_variance() {
    let exact = furnace(LE, ALBEDO);
    let mut variances = Vec::new();
    for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol] {
        let pixels = samples(&scene(), RenderSettings { sampler, ..settings(Directions::Uniform) }, 256);
        // Samples within a pixel depend on each other; the means of pixels do not.
        let found = Moments::of(pixels.iter().map(|samples| samples.iter().sum::<f64>() / 256.0));
        assert_within(found.z(exact), &format!("{sampler:?}"));
        variances.push(found.variance);
    }
    assert!(variances[1] < 0.7 * variances[0] && variances[2] < 0.7 * variances[0], "{variances:?}");
}
