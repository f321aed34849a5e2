//! The curves of plots and their positions.
use crate::{
    report::plot::Plot,
    study::{
        Checkpoint, Findings, Outcome, Run, checkpoints,
        figures::{by_setting, overview},
        outcome::Limits,
        ranking::rank,
        trial::Group,
    },
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, RenderSettings},
};

fn outcome(settings: RenderSettings, rel_mse: f64, twins: Vec<RenderSettings>) -> Outcome {
    let point = |n: u32| {
        let share = f64::from(n) / 16.0;
        Checkpoint {
            spp: n,
            seconds: 4.0 * share,
            rmse: 1.0,
            rel_mse: rel_mse / share,
            bias: 0.0,
            bias_standard_error: None,
            effective_samples: None,
        }
    };
    let run = Run { checkpoints: checkpoints(16).into_iter().map(point).collect(), ..Run::default() };
    Outcome::of(Group { settings, twins }, &[run], Limits { floor: 0.0, black: 1e9, variance_of_mean: 0.0, mean: 1.0 })
}

fn findings(mut outcomes: Vec<Outcome>, of_scene: RenderSettings) -> Findings {
    rank(&mut outcomes);
    Findings {
        title: String::new(),
        path: "scene.toml".into(),
        resolution: [8, 8],
        of_scene,
        reference: String::new(),
        reference_is_taken_for_exact: false,
        limits: Limits { floor: 0.0, black: 1e9, variance_of_mean: 0.0, mean: 1.0 },
        repeats: 1,
        outcomes,
    }
}

fn settings(estimator: Estimator, sampler: Sampler) -> RenderSettings {
    RenderSettings { estimator, sampler, ..RenderSettings::default() }
}

/// Points at powers of two of `first`, where `error` falls with the root.
fn falling(error: f64, first: f64, powers: &[i32]) -> Vec<(f64, f64)> {
    powers.iter().map(|power| (first * 2f64.powi(*power), error / 2f64.powi(*power).sqrt())).collect()
}

/// How often each name occurs in a drawing.
fn named(svg: &str, name: &str) -> usize {
    svg.matches(&format!("\n{name}\n")).count()
}

#[test]
fn the_overview_has_the_best_three_the_own_and_the_last() {
    let all = [Sampler::Sobol, Sampler::Stratified, Sampler::Independent];
    let of = |(i, sampler): (usize, Sampler)| {
        [Estimator::Mis, Estimator::Light].map(|estimator| {
            let rel_mse = 0.01 * (1.0 + i as f64) * if estimator == Estimator::Light { 10.0 } else { 1.0 };
            outcome(settings(estimator, sampler), rel_mse, Vec::new())
        })
    };
    let outcomes: Vec<Outcome> = all.into_iter().enumerate().flat_map(of).collect();
    let found = findings(outcomes, settings(Estimator::Light, Sampler::Sobol));
    let pair = overview(&found).expect("curves");
    for svg in &pair.plots.each_ref().map(Plot::svg) {
        let shown = |estimator: &str, sampler: &str| {
            named(svg, &format!("{estimator}, bsdf, {sampler}, roulette throughput, no path reuse"))
        };
        let counts = ["sobol", "stratified", "independent"].map(|sampler| [shown("mis", sampler), shown("light", sampler)]);
        assert_eq!(counts, [[1, 1], [1, 0], [1, 1]], "{svg}");
        assert_eq!(named(svg, "slope −1/2"), 1);
    }
    assert!(pair.plots[0].svg().contains("rendering time, s") && pair.plots[1].svg().contains("samples per pixel"));
    assert!(!pair.caption.contains("Without noise") && !pair.caption.contains("taken off"));
    let limited = Findings { limits: Limits { floor: 1e-9, black: 1e9, variance_of_mean: 0.0, mean: 1.0 }, ..found };
    assert!(overview(&limited).expect("curves").caption.contains("The error of the reference is subtracted"));
}

#[test]
fn a_setting_has_a_curve_for_each_value_and_twins_share_one() {
    let best = settings(Estimator::Mis, Sampler::Sobol);
    let twin = RenderSettings { sampler: Sampler::BlueNoise, ..best };
    let found = findings(
        vec![
            outcome(best, 0.01, vec![twin]),
            outcome(settings(Estimator::Mis, Sampler::Independent), 0.04, Vec::new()),
            outcome(settings(Estimator::Path, Sampler::Independent), 0.08, Vec::new()),
            outcome(settings(Estimator::Path, Sampler::Stratified), 0.16, Vec::new()),
        ],
        best,
    );
    let pair = by_setting(&found, RenderSettings::SAMPLER).expect("curves");
    assert_eq!(pair.title, "Sampler");
    assert!(pair.caption.contains("All other settings as in the best combination: mis, bsdf, sobol"), "{}", pair.caption);
    // Stratified was measured with another estimator only.
    let counts = ["sobol = bluenoise", "independent", "stratified"].map(|name| named(&pair.plots[0].svg(), name));
    assert_eq!(counts, [1, 1, 0], "{}", pair.plots[0].svg());
    // The best has a root of relMSE of 0.4 after one sample, which takes a quarter of a second, and falls as independent samples do.
    for (plot, first) in pair.plots.iter().zip([0.25, 1.0]) {
        let curves = [&plot.curves[0], &plot.curves[1], &plot.curves[plot.curves.len() - 1]].map(|curve| &curve.points[..]);
        let exact = [&[0, 1, 2, 3, 4][..], &[0, 1, 2, 3, 4], &[0, 4]].map(|powers| falling(0.4, first, powers));
        let near = |(found, exact): (&(f64, f64), &(f64, f64))| found.0 == exact.0 && (found.1 - exact.1).abs() < 1e-12;
        for (found, exact) in curves.into_iter().zip(&exact) {
            assert!(found.len() == exact.len() && found.iter().zip(exact).all(near), "{found:?} {exact:?}");
        }
    }
    assert!(by_setting(&found, RenderSettings::ROULETTE).is_none() && by_setting(&found, RenderSettings::ESTIMATOR).is_none());
}

#[test]
fn combinations_without_noise_are_named_and_not_drawn() {
    let exact = outcome(settings(Estimator::Mis, Sampler::Sobol), 1e-17, Vec::new());
    let noisy = outcome(settings(Estimator::Path, Sampler::Sobol), 0.1, Vec::new());
    let pair = overview(&findings(vec![exact.clone(), noisy], RenderSettings::default())).expect("a curve");
    assert!(
        pair.caption.ends_with("Not shown because they have no noise: mis, bsdf, sobol, roulette throughput, no path reuse."),
        "{}",
        pair.caption
    );
    assert!(overview(&findings(vec![exact], RenderSettings::default())).is_none());
}
