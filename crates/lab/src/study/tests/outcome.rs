//! Outcomes of the runs of one combination.
use super::ranking::{outcome, run};
use crate::study::{Eligibility, Outcome, Run, outcome::Limits, slope, trial::Group, wording::mean_error};
use noisefall_scene::scene::RenderSettings;

#[test]
fn the_bias_of_runs_is_known_as_well_as_they_and_the_reference_are() {
    let with = |bias: f64, error: Option<f64>| {
        let mut run = run(0.01, 1.0);
        run.checkpoints.iter_mut().for_each(|point| (point.bias, point.bias_standard_error) = (bias, error));
        run
    };
    let of = |runs: &[Run], variance_of_mean| {
        let limits = Limits { floor: 0.0, black: 1.0, variance_of_mean, mean: 1.0 };
        let group = Group { settings: RenderSettings::default(), twins: Vec::new() };
        mean_error(Outcome::of(group, runs, limits).mean_error)
    };
    let runs = [with(0.5, Some(0.03)), with(0.3, Some(0.04))];
    assert_eq!(of(&runs, 0.0), "+0.400 ± 0.025");
    assert_eq!(of(&runs, 0.06 * 0.06 - 0.025 * 0.025), "+0.400 ± 0.060");
    assert_eq!(of(&[with(-2e-3, Some(1.5e-4))], 0.0), "−0.00200 ± 0.00015");
    assert_eq!(of(&[with(-2e-9, Some(1.5e-10))], 0.0), "−2.0e−9 ± 1.5e−10");
    assert_eq!(of(&[with(-0.5, None)], 0.0), "−5.0e−1");
}

#[test]
fn the_error_of_the_reference_is_taken_off_and_ends_the_curve() {
    let group = Group { settings: RenderSettings::default(), twins: Vec::new() };
    // relMSE 0.16, 0.08, 0.04, 0.02, 0.01 plus that of the reference.
    let mut measured = run(0.01, 1.0);
    for point in &mut measured.checkpoints {
        point.rel_mse += 0.015;
        point.rmse = 2.0 * point.rel_mse.sqrt();
    }
    let found = Outcome::of(group, &[measured], Limits { floor: 0.015, black: 1.0, variance_of_mean: 0.0, mean: 1.0 });
    assert_eq!(found.last().spp, 8);
    assert!((found.last().rel_mse - 0.02).abs() < 1e-12);
    assert!((found.efficiency() - 1.0 / (0.02 * 0.5)).abs() < 1e-9);
    // The variance is reduced by the same factor: 4 · 0.04 after 4 samples, 4 · 0.02 after 8.
    let near = |point: (f64, f64), exact: (f64, f64)| point.0 == exact.0 && (point.1 - exact.1).abs() < 1e-12;
    let [variances] = &found.variances[..] else { panic!("{:?}", found.variances) };
    assert!(variances.len() == 2 && near(variances[0], (4.0, 0.16)) && near(variances[1], (8.0, 0.08)), "{variances:?}");
    assert!(found.log_efficiency().variance.is_nan());
    // Nothing is known below the error of the reference.
    let limits = Limits { floor: 0.2, black: 1.0, variance_of_mean: 0.0, mean: 1.0 };
    let group = Group { settings: RenderSettings::default(), twins: Vec::new() };
    let unclear = Outcome::of(group, &[run(0.01, 1.0)], limits);
    assert_eq!((unclear.last().spp, unclear.last().rel_mse), (1, 0.2));
}

#[test]
fn an_outcome_is_the_mean_of_its_runs_where_they_end() {
    let mut second = run(0.02, 3.0);
    second.invalid_samples = 4;
    let found = outcome(RenderSettings::default(), &[run(0.01, 1.0), second]);
    assert_eq!((found.last().spp, found.curve.len(), found.invalid_samples), (16, 5, 4));
    assert!((found.last().rel_mse - 0.015).abs() < 1e-12 && (found.last().seconds - 2.0).abs() < 1e-12);
    let exact = [1.0 / (0.01 * 1.0), 1.0 / (0.02 * 3.0)];
    assert!(found.efficiencies.iter().zip(exact).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{:?}", found.efficiencies);
    assert!((found.efficiency() - (exact[0] * exact[1]).sqrt()).abs() < 1e-9);
    // Squared errors fall as 1/N, so the slope of the root is −1/2 from 4 samples on.
    assert!(found.slope.is_some_and(|slope| (slope.slope + 0.5).abs() < 1e-9), "{:?}", found.slope);
    let mut bent = run(0.01, 1.0);
    for point in &mut bent.checkpoints[..2] {
        (point.rel_mse, point.rmse) = (100.0 * point.rel_mse, 100.0 * point.rmse);
    }
    let bent = outcome(RenderSettings::default(), &[bent, run(0.01, 1.0)]);
    assert!(bent.slope.is_some_and(|slope| (slope.slope + 0.5).abs() < 1e-9));
    // The slope of the mean squared error is −1.
    for known in [found, bent] {
        assert!(slope(&known.variances).is_some_and(|slope| (slope.slope + 1.0).abs() < 1e-9), "{:?}", known.variances);
    }
    // Errors are 8, 4, 2, 1 and ½ · 10⁻¹² after 1, 2, 4, 8 and 16 samples; up to 10⁻¹² they are rounding.
    assert_eq!(outcome(RenderSettings::default(), &[run(5e-13, 1.0)]).variances[0].len(), 1);
    // Only checkpoints that all runs have count.
    let mut short = run(0.01, 1.0);
    short.checkpoints.truncate(3);
    assert_eq!(outcome(RenderSettings::default(), &[run(0.01, 1.0), short]).last().spp, 4);
    // The limit is half the error of a black image.
    let limits = Limits { floor: 0.0, black: 0.4, variance_of_mean: 0.0, mean: 1.0 };
    let group = || Group { settings: RenderSettings::default(), twins: Vec::new() };
    let eligibility = |rel_mse| Outcome::of(group(), &[run(rel_mse, 1.0)], limits).eligibility;
    assert_eq!([0.199, 0.201].map(eligibility), [Eligibility::Sound, Eligibility::TooNoisy]);
}

#[test]
fn a_curve_ends_where_one_of_its_runs_comes_near_to_the_reference() {
    // Two runs with 0.32 and 0.16 after one sample, including 0.015 from the reference in both.
    let with_own = |rel_mse: f64| {
        let mut run = run(rel_mse, 1.0);
        run.checkpoints.iter_mut().for_each(|point| point.rel_mse += 0.015);
        run
    };
    let group = Group { settings: RenderSettings::default(), twins: Vec::new() };
    let limits = Limits { floor: 0.015, black: 1.0, variance_of_mean: 0.0, mean: 1.0 };
    let found = Outcome::of(group, &[with_own(0.02), with_own(0.01)], limits);
    assert_eq!((found.last().spp, found.variances.iter().map(Vec::len).collect::<Vec<_>>()), (8, vec![2, 2]));
    assert!((found.last().rel_mse - 0.03).abs() < 1e-12, "{:?}", found.last());
}
