//! What is made of runs.
use crate::{
    scene::{Estimator, RenderSettings},
    study::{
        Checkpoint, Findings, Outcome, Run, Standing, checkpoints, outcome::Limits, ranking::rank, setting::Setting,
        trial::Group, verdict,
    },
};

fn run(rel_mse: f64, seconds: f64) -> Run {
    let point = |n: u32| {
        let [share, all] = [f64::from(n), 16.0];
        Checkpoint { spp: n, seconds: seconds * share / all, rmse: 1.0, rel_mse: rel_mse * all / share, bias: 0.0 }
    };
    Run { checkpoints: checkpoints(16).into_iter().map(point).collect(), ..Run::default() }
}

fn outcome(settings: RenderSettings, runs: &[Run]) -> Outcome {
    Outcome::of(Group { settings, twins: Vec::new() }, runs, Limits { floor: 0.0, black: 1.0 })
}

fn findings(mut outcomes: Vec<Outcome>) -> Findings {
    rank(&mut outcomes);
    Findings {
        title: "A scene".to_owned(),
        path: "scene.toml".into(),
        resolution: [8, 8],
        of_scene: RenderSettings::default(),
        reference: "the exact radiance".to_owned(),
        reference_is_taken_for_exact: false,
        limits: Limits { floor: 0.0, black: 1.0 },
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
    let standings: Vec<Standing> = found.outcomes.iter().map(|outcome| outcome.standing).collect();
    assert_eq!(standings, [Standing::Sound, Standing::Sound, Standing::TooNoisy, Standing::Biased]);
    assert_eq!(found.best().map(|best| best.settings.estimator), Some(Estimator::Light));
    assert!((found.ratio(&found.outcomes[1]).expect("a ratio") - 0.5).abs() < 1e-12);
    assert!(verdict(&found).contains(": light, bsdf, sobol, roulette throughput – an error of "), "{}", verdict(&found));
    // Half the efficiency is within what two repeats with a spread of 20 % can tell apart only if the factor says so.
    let factor = found.uncertainty().expect("repeats");
    assert_eq!(found.rivals().count(), usize::from(factor >= 2.0));
    assert!(findings(vec![outcome(estimator(Estimator::Path), &[run(0.9, 1.0)])]).best().is_none());
}

#[test]
fn equal_repeats_leave_no_doubt() {
    let clear = |rel_mse| [run(rel_mse, 1.0), run(rel_mse, 1.0)];
    let found =
        findings(vec![outcome(estimator(Estimator::Path), &clear(0.02)), outcome(estimator(Estimator::Mis), &clear(0.01))]);
    assert!((found.uncertainty().expect("repeats") - 1.0).abs() < 1e-9);
    assert_eq!(found.rivals().count(), 0);
    let worth = found.worth(Setting::Estimator);
    assert_eq!(worth.iter().map(|worth| worth.value.as_str()).collect::<Vec<_>>(), ["mis", "path"]);
    assert!(found.worth(Setting::Sampler).is_empty());
}

#[test]
fn the_error_of_the_reference_is_taken_off_and_ends_the_curve() {
    let group = Group { settings: RenderSettings::default(), twins: Vec::new() };
    // relMSE 0.16, 0.08, 0.04, 0.02, 0.01 plus that of the reference.
    let mut measured = run(0.01, 1.0);
    measured.checkpoints.iter_mut().for_each(|point| point.rel_mse += 0.015);
    let found = Outcome::of(group, &[measured], Limits { floor: 0.015, black: 1.0 });
    assert_eq!(found.last().spp, 8);
    assert!((found.last().rel_mse - 0.02).abs() < 1e-12);
    assert!((found.efficiency() - 1.0 / (0.02 * 0.5)).abs() < 1e-9);
    assert!(found.log_efficiency().variance.is_nan());
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
