//! 2. Variance falls as 1/N.
use crate::{
    measure::{Moments, exact::furnace_variance, samples},
    report::{
        Figure,
        plot::{Axis, Curve, Style, curve, plot},
    },
    sampling::{Directions, Sampler},
    scene::RenderSettings,
    validate::{Section, Statement, Validation, check},
};

const ALBEDO: f64 = 0.5;

pub fn section(validation: &Validation) -> Section {
    let scene = check::furnace(ALBEDO);
    let exact = furnace_variance(1.0, ALBEDO, 4.0 / 3.0);
    let single = validation.moments(&scene, validation.path(Directions::Uniform, 20), 1500);
    let mut statements = vec![Statement::variance("variance of one sample, uniform directions, no cap", &single, exact)];
    // One reflection: X = L_e (1 + 2 ρ cos θ), of variance 4 ρ² (1/3 − 1/4).
    let one_reflection = ALBEDO * ALBEDO / 3.0;
    let mut curves = Vec::new();
    let mut slopes = Vec::new();
    for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol] {
        let settings = RenderSettings { sampler, max_bounces: Some(1), ..validation.path(Directions::Uniform, 30) };
        let points = variances(settings);
        let name = format!("{sampler:?}").to_lowercase();
        if sampler == Sampler::Independent {
            for (n, found) in &points {
                let exact = one_reflection / n;
                statements.push(Statement::variance(format!("one reflection: variance of the mean of N = {n}"), found, exact));
            }
        }
        slopes.push(slope(&points));
        curves.push(curve(&name, Style::Points, points.iter().map(|(n, found)| (*n, found.variance)).collect()));
        curves.push(curve(&name, Style::Line, points.iter().map(|(n, found)| (*n, found.variance)).collect()));
    }
    let [(slope, error), others @ ..] = &slopes[..] else { unreachable!("three samplers") };
    statements.push(Statement::z("independent samples: slope of log variance over log N", *slope, *error, -1.0));
    for ((slope, error), name) in others.iter().zip(["stratified", "Sobol"]) {
        statements.push(Statement::below(format!("{name}: slope, plus four of its standard errors"), slope + 4.0 * error, -1.0));
    }
    curves.push(curve("exact ρ²/3N", Style::Dashed, [1.0, 1024.0].map(|n| (n, one_reflection / n)).to_vec()));
    Section {
        title: "Variance falls as 1/N",
        claim: "The mean of N independent samples has 1/N of the variance of one, which is known in closed form; stratified and \
                Sobol samples do better.",
        derivation: &[
            "A sample is X = L_e + ρ w X′ with the weight w = 2 cos θ of a uniform direction, E w = 1, E w² = 4/3, and X′ \
             distributed as X but independent of w. Hence E X² = L_e² + 2 L_e ρ L + ρ² (4/3) E X², which gives \
             Var X = (L_e² + 2 L_e ρ L)/(1 − 4ρ²/3) − L², finite while ρ² < 3/4. Here ρ = 0.5 and L_e = 1.",
            "With one reflection only, X = L_e (1 + 2ρ cos θ) and Var X = 4ρ² L_e² (1/3 − 1/4) = ρ² L_e²/3. Independent samples \
             add their variances; samples that avoid each other need not, and for a smooth integrand they fall faster.",
        ],
        source: "Variance of the weight: moments of cos θ uniform in [0, 1]. Sobol points are Owen-scrambled (A. Owen, “Scrambled \
                 net variance for integrals of smooth functions”, 1997).",
        statements,
        figures: vec![figure(&curves)],
        remark: None,
    }
}

fn figure(curves: &[Curve]) -> Figure {
    let caption = "Variance, over 1024 pixels, of the mean of N samples; one reflection in the furnace with ρ = 0.5.";
    plot(caption, Axis::log("samples N"), Axis::log("variance of the mean"), curves)
}

/// Moments over pixels of the means of N samples, each N with samples of its own.
fn variances(settings: RenderSettings) -> Vec<(f64, Moments)> {
    let counts = [1, 4, 16, 64, 256, 1024];
    let of = |n: u32| {
        let pixels = samples(&check::furnace(ALBEDO), RenderSettings { seed: settings.seed + n, ..settings }, n);
        (f64::from(n), Moments::of(pixels.iter().map(|samples| samples.iter().sum::<f64>() / f64::from(n))))
    };
    counts.into_iter().map(of).collect()
}

/// The slope of log variance over log N by least squares, each point weighted by its precision, and its standard error.
fn slope(points: &[(f64, Moments)]) -> (f64, f64) {
    let rows: Vec<[f64; 3]> = points
        .iter()
        .map(|(n, found)| {
            let relative = (found.fourth / (found.variance * found.variance) - 1.0) / found.count;
            [n.ln(), found.variance.ln(), 1.0 / relative]
        })
        .collect();
    let sum = |f: &dyn Fn(&[f64; 3]) -> f64| rows.iter().map(f).sum::<f64>();
    let weight = sum(&|r| r[2]);
    let (x, y) = (sum(&|r| r[2] * r[0]) / weight, sum(&|r| r[2] * r[1]) / weight);
    let spread = sum(&|r| r[2] * (r[0] - x).powi(2));
    (sum(&|r| r[2] * (r[0] - x) * (r[1] - y)) / spread, (1.0 / spread).sqrt())
}
