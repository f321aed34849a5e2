//! Ranking of the outcomes of a scene.
use statrs::distribution::{ContinuousCDF, Normal};

use crate::study::{
    Checkpoint, Eligibility, Findings, Outcome, Run, checkpoints,
    outcome::Limits,
    ranking::rank,
    table,
    trial::Group,
    verdict,
    wording::{certainty, command, percent, significant},
};
use noisefall_base::math::{One, U};
use noisefall_kernel::measure::student_95;
use noisefall_scene::{
    sampling::{
        Sampler,
        hash::{hash, unit},
    },
    scene::{Estimator, RenderSettings, Roulette},
};

/// Outcomes of 16 samples per pixel, for an image with a mean square of 4.
pub(super) fn run(rel_mse: f64, seconds: f64) -> Run {
    let point = |n: u32| {
        let [share, all] = [f64::from(n), 16.0];
        let rel_mse = rel_mse * all / share;
        Checkpoint {
            spp: n,
            seconds: seconds * share / all,
            rmse: 2.0 * rel_mse.sqrt(),
            rel_mse,
            bias: 0.0,
            bias_standard_error: Some(0.1 / share.sqrt()),
            effective_samples: Some(1e4 * share),
        }
    };
    Run { checkpoints: checkpoints(16).into_iter().map(point).collect(), ..Run::default() }
}

pub(super) fn outcome(settings: RenderSettings, runs: &[Run]) -> Outcome {
    Outcome::of(Group { settings, twins: Vec::new() }, runs, Limits { floor: 0.0, black: 1.0, variance_of_mean: 0.0, mean: 1.0 })
}

pub(super) fn findings(mut outcomes: Vec<Outcome>) -> Findings {
    rank(&mut outcomes);
    Findings {
        title: "A scene".to_owned(),
        path: "scene.toml".into(),
        resolution: [8, 8],
        of_scene: RenderSettings::default(),
        reference: "the exact radiance".to_owned(),
        reference_is_taken_for_exact: false,
        limits: Limits { floor: 0.0, black: 1.0, variance_of_mean: 0.0, mean: 1.0 },
        repeats: 2,
        outcomes,
    }
}

fn estimator(estimator: Estimator) -> RenderSettings {
    RenderSettings { estimator, ..RenderSettings::default() }
}

#[test]
fn neither_biased_nor_empty_pictures_win_however_fast() {
    let biased = Run { bias: "cap at 2".to_owned(), ..run(1e-9, 1e-3) };
    let capped = RenderSettings { max_bounces: Some(2), ..RenderSettings::default() };
    let found = findings(vec![
        outcome(capped, &[biased.clone(), biased]),
        outcome(estimator(Estimator::Path), &[run(0.9, 1e-6), run(0.9, 1e-6)]),
        outcome(estimator(Estimator::Mis), &[run(0.01, 2.0), run(0.012, 2.0)]),
        outcome(estimator(Estimator::Light), &[run(0.01, 1.0), run(0.012, 1.0)]),
    ]);
    let eligibilities: Vec<Eligibility> = found.outcomes.iter().map(|outcome| outcome.eligibility).collect();
    assert_eq!(eligibilities, [Eligibility::Sound, Eligibility::Sound, Eligibility::TooNoisy, Eligibility::Biased]);
    assert_eq!(found.best().map(|best| best.settings.estimator), Some(Estimator::Light));
    assert!((found.ratio(&found.outcomes[1]).expect("a ratio") - 0.5).abs() < 1e-12);
    assert!(verdict(&found).contains(": light, bsdf, sobol, roulette throughput – an error of "), "{}", verdict(&found));
    // Repeats differ by a factor of 1.2, so log efficiencies have the variance ln² 1.2/2 with two degrees of freedom. The
    // difference of two means of two has the same variance, and 95 % of Student's t are within ±4.3027, which is a factor of
    // 1.7414.
    assert!((found.uncertainty().expect("repeats") - 1.7414).abs() < 1e-3, "{:?}", found.uncertainty());
    assert_eq!(found.rivals().count(), 0);
    assert!(findings(vec![outcome(estimator(Estimator::Path), &[run(0.9, 1.0)])]).best().is_none());
}

#[test]
fn equal_repeats_leave_no_doubt() {
    let clear = |rel_mse| [run(rel_mse, 1.0), run(rel_mse, 1.0)];
    let found =
        findings(vec![outcome(estimator(Estimator::Path), &clear(0.02)), outcome(estimator(Estimator::Mis), &clear(0.01))]);
    assert!((found.uncertainty().expect("repeats") - 1.0).abs() < 1e-9);
    assert_eq!(found.rivals().count(), 0);
    let gains = found.gains(RenderSettings::ESTIMATOR);
    assert_eq!(gains.iter().map(|gain| gain.value.as_str()).collect::<Vec<_>>(), ["mis", "path"]);
    assert!(found.gains(RenderSettings::SAMPLER).is_empty());
}

#[test]
fn without_noise_time_decides() {
    let found = findings(vec![
        outcome(estimator(Estimator::Path), &[run(1e-16, 0.2)]),
        outcome(estimator(Estimator::Mis), &[run(1e-15, 0.1)]),
    ]);
    let best = found.best().expect("a best one");
    assert!(best.is_exact() && best.slope.is_none() && best.settings.estimator == Estimator::Mis);
    assert!(verdict(&found).contains("no noise"));
}

/// A standard normal number.
fn normal(i: u32) -> f64 {
    let u = f64::from(unit(hash(U::<One>(i))).0) + 0.5 / f64::from(1u32 << 24);
    Normal::new(0.0, 1.0).map_or(f64::NAN, |normal| normal.inverse_cdf(u))
}

/// Random log efficiencies around known means. The ratio of two combinations is within the factor in 95 of 100 studies.
#[test]
fn the_uncertainty_of_a_ratio_covers_it_as_often_as_it_says() {
    const STUDIES: u32 = 1500;
    let samplers = [Sampler::Independent, Sampler::Sobol, Sampler::Stratified];
    for (repeats, count) in [(2, 2), (2, 3), (4, 2)] {
        let covered = |study: &u32| {
            let of = |combination: u32| {
                let settings = RenderSettings { sampler: samplers[combination as usize], ..RenderSettings::default() };
                let factor = [1.0, 0.8, 0.7][combination as usize];
                let log = |repeat: u32| 0.3 * normal(((study * 4 + combination) * 8 + repeat) * 31 + 7 * repeats);
                let runs: Vec<Run> = (0..repeats).map(|repeat| run(0.01 * f64::exp(log(repeat)) / factor, 1.0)).collect();
                outcome(settings, &runs)
            };
            let found = Findings { repeats, ..findings((0..count).map(of).collect()) };
            let efficiency =
                |sampler| found.outcomes.iter().find(|o| o.settings.sampler == sampler).map_or(f64::NAN, Outcome::efficiency);
            let off = efficiency(samplers[1]) / efficiency(samplers[0]) / 0.8;
            off.ln().abs() <= found.uncertainty().expect("repeats").ln()
        };
        let share = f64::from((0..STUDIES).filter(covered).count() as u32) / f64::from(STUDIES);
        // 4 standard errors of a fraction of 0.95 are 0.0225.
        assert!((share - 0.95).abs() < 0.0225, "{repeats} repeats of {count}: {share}");
    }
}

#[test]
fn far_worse_combinations_do_not_change_the_uncertainty() {
    let with = |worse: [f64; 2]| {
        let sampler = |sampler| RenderSettings { sampler, ..RenderSettings::default() };
        findings(vec![
            outcome(sampler(Sampler::Sobol), &[run(0.01, 1.0), run(0.011, 1.0)]),
            outcome(sampler(Sampler::Stratified), &[run(0.0145, 1.0), run(0.0145, 1.0)]),
            outcome(sampler(Sampler::Independent), &[run(worse[0], 1.0), run(worse[1], 1.0)]),
        ])
    };
    let (far, near) = (with([0.2, 0.15]), with([0.06, 0.08]));
    assert!(near.uncertainty() > far.uncertainty(), "{:?} {:?}", near.uncertainty(), far.uncertainty());
    // A spread of 1.1 in both near combinations, with two degrees of freedom: exp(4.3027 · ln 1.1/2) = 1.2276.
    assert!((far.uncertainty().expect("repeats") - 1.2276).abs() < 1e-3, "{:?}", far.uncertainty());
    assert_eq!((far.rivals().count(), near.rivals().count()), (0, 1));
    // 0.0145/√(0.01 · 0.011) = 1.3825, divided and multiplied by the factor.
    let said = "It is 1.38 times as efficient as the next (95 %, by the spread of repeats: 1.13 to 1.70).";
    assert_eq!(certainty(&far), said);
    // The best is 1 by definition; 1/1.3825 divided and multiplied by the factor.
    let intervals: Vec<Option<[f64; 2]>> = far.outcomes.iter().map(|outcome| far.interval(outcome)).collect();
    let [None, Some([low, high]), Some([lowest, highest])] = intervals[..] else { panic!("{intervals:?}") };
    assert!((low - 0.5892).abs() < 1e-3 && (high - 0.8880).abs() < 1e-3, "{low} {high}");
    // The uncertainty of a far combination comes from its own spread and that of the best. The mean of the logarithms of two
    // numbers with ratio q has the variance ln² q/4: ln² (4/3)/4 + ln² 1.1/4 = 0.022961, with 0.022961²/(0.020690² + 0.002271²) =
    // 1.217 degrees of freedom.
    let ratio = (0.01f64 * 0.011).sqrt() / (0.2f64 * 0.15).sqrt();
    let factor = (student_95(1.2172) * 0.022_961f64.sqrt()).exp();
    assert!(
        (highest / (ratio * factor) - 1.0).abs() < 1e-2 && (lowest / (ratio / factor) - 1.0).abs() < 1e-2,
        "{lowest} {highest}"
    );
    let biased =
        outcome(RenderSettings { seed: 7, ..RenderSettings::default() }, &[Run { bias: "cut".to_owned(), ..run(0.2, 1.0) }]);
    assert_eq!(far.interval(&biased), None);
}

#[test]
fn the_gain_of_a_setting_is_with_the_best_and_at_its_best() {
    let of = |estimator, sampler, rel_mse| {
        let settings = RenderSettings { estimator, sampler, ..RenderSettings::default() };
        outcome(settings, &[run(rel_mse, 1.0), run(rel_mse, 1.0)])
    };
    let mut best = of(Estimator::Mis, Sampler::Sobol, 0.01);
    best.twins = vec![RenderSettings { roulette: Roulette::Off, ..best.settings }];
    let found = findings(vec![
        of(Estimator::Path, Sampler::Independent, 0.05),
        best,
        of(Estimator::Path, Sampler::Sobol, 0.1),
        of(Estimator::Mis, Sampler::Independent, 0.02),
    ]);
    let gains = |setting| {
        let values = found.gains(setting).into_iter();
        values.map(|gain| (gain.value, gain.alone.unwrap_or(-1.0), gain.at_best.unwrap_or(-1.0))).collect::<Vec<_>>()
    };
    let near = |found: &[(String, f64, f64)], exact: &[(&str, f64, f64)]| {
        let same =
            |(a, b): (&(String, f64, f64), &(&str, f64, f64))| a.0 == b.0 && (a.1 - b.1).abs() < 1e-9 && (a.2 - b.2).abs() < 1e-9;
        assert!(found.len() == exact.len() && found.iter().zip(exact).all(same), "{found:?} {exact:?}");
    };
    near(&gains(RenderSettings::ESTIMATOR), &[("mis", 1.0, 1.0), ("path", 0.1, 0.2)]);
    near(&gains(RenderSettings::SAMPLER), &[("sobol", 1.0, 1.0), ("independent", 0.5, 0.5)]);
    near(&gains(RenderSettings::ROULETTE), &[("throughput", 1.0, 1.0), ("off", 1.0, 1.0)]);
    assert!(
        found.find(&RenderSettings { roulette: Roulette::Off, ..RenderSettings::default() }).is_some_and(|o| o.twins.len() == 1)
    );
    assert!(found.find(&RenderSettings { seed: 1, ..RenderSettings::default() }).is_none());
}

#[test]
fn findings_in_words_have_their_numbers() {
    assert_eq!([0.0, 0.012_345, 1.2345, 123.45, 99_999.0].map(significant), ["0.00", "0.0123", "1.23", "123", "99999"]);
    assert_eq!([1.5e-5, -2.5, 1e9, f64::NAN].map(significant), ["1.50e-5", "-2.50", "1.00e9", "–"]);
    assert_eq!(percent(0.0004), "2.00 %");
    let of = |estimator, rel_mse: [f64; 2], seconds| {
        outcome(self::estimator(estimator), &[run(rel_mse[0], seconds), run(rel_mse[1], seconds)])
    };
    let mut found = findings(vec![of(Estimator::Mis, [0.04, 0.04], 0.5), of(Estimator::Path, [0.09, 0.09], 2.0)]);
    found.of_scene = estimator(Estimator::Path);
    assert_eq!(
        verdict(&found),
        "Best: mis, bsdf, sobol, roulette throughput – an error of 20.0 % after 0.500 s (16 samples per pixel)."
    );
    assert_eq!(
        certainty(&found),
        "It is 9.00 times as efficient as the next (95 %, by the spread of repeats: 9.00 to 9.00). The scene opens with path, bsdf, \
         sobol, roulette throughput, which has 0.111 of the efficiency."
    );
    assert_eq!(command(&found).as_deref(), Some("noisefall render scene.toml -o image.exr --estimator mis"));
    let lines: Vec<String> = table(&found).lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(lines[0], "settings spp s error slope efficiency of best");
    assert_eq!(lines[1], "mis, bsdf, sobol, roulette throughput 16 0.500 20.0 % −0.50 ± 0.00 50.0 1.00");
    assert_eq!(lines[2], "path, bsdf, sobol, roulette throughput 16 2.00 30.0 % −0.50 ± 0.00 5.56 0.111");
    // Two combinations that the repeats cannot distinguish.
    let close = findings(vec![of(Estimator::Mis, [0.04, 0.06], 1.0), of(Estimator::Path, [0.05, 0.06], 1.0)]);
    assert!(verdict(&close).starts_with("First of 2 that cannot be told apart: mis"), "{}", verdict(&close));
    // Two variances, ln² 1.5/2 and ln² 1.2/2, with one degree of freedom each.
    assert_eq!(
        certainty(&close),
        "By the spread of repeats, ratios of efficiencies are known to a factor of 2.60 (95 %). These cannot be told apart from it: path, bsdf, \
         sobol, roulette throughput."
    );
    let biased = Run { bias: "cap at 2".to_owned(), ..run(0.01, 1.0) };
    let one = outcome(estimator(Estimator::Light), &[biased]);
    assert_eq!(one.to_string(), "light, bsdf, sobol, roulette throughput: 10.0 % after 1.00 s, 16 spp, biased: cap at 2");
    // A biased combination is no rival.
    let alone = findings(vec![of(Estimator::Mis, [0.04, 0.04], 1.0), one]);
    assert_eq!(certainty(&alone), "No other combination is ranked.");
}
