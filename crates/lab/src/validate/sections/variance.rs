//! Error falls as 1/√N.
use super::directions::ground;
use crate::{
    report::{
        Figure,
        plot::{Axis, Curve, Style, curve, plot},
    },
    validate::{Effort, Section, Statement, Validation, check},
};
use noisefall_kernel::measure::{
    Moments,
    exact::{furnace_capped, furnace_variance},
    samples,
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{RenderSettings, Scene},
};

const ALBEDO: f64 = 0.5;
/// Samples per pixel at which errors are measured; the last one in full runs only.
const COUNTS: [u32; 5] = [1, 4, 16, 64, 256];
/// Images for each sample count, with different seeds.
const REPEATS: usize = 10;

/// An integral with a known value, and its sampling.
struct Integrand {
    name: &'static str,
    scene: Scene,
    directions: Directions,
    cap: u32,
    exact: f64,
}

fn integrands() -> [Integrand; 3] {
    let sine = 0.6;
    [
        Integrand {
            name: "one reflection",
            scene: check::furnace(ALBEDO),
            directions: Directions::Uniform,
            cap: 1,
            exact: furnace_capped(1.0, ALBEDO, 1),
        },
        // The albedo of the ground is 0.8.
        Integrand {
            name: "light with an edge",
            scene: ground(sine),
            directions: Directions::Cosine,
            cap: 1,
            exact: 0.8 * sine * sine,
        },
        Integrand {
            name: "20 reflections",
            scene: check::furnace(ALBEDO),
            directions: Directions::Uniform,
            cap: 20,
            exact: furnace_capped(1.0, ALBEDO, 20),
        },
    ]
}

pub fn section(validation: &Validation) -> Section {
    let scene = check::furnace(ALBEDO);
    let exact = furnace_variance(1.0, ALBEDO, 4.0 / 3.0);
    let single = validation.moments(&scene, validation.path(Directions::Uniform), 1500);
    let mut statements = vec![Statement::variance("variance of one sample, uniform directions, no cap", &single, exact)];
    statements.extend(variances(validation, &scene));
    let mut figures = Vec::new();
    for integrand in integrands() {
        let mut curves = Vec::new();
        for sampler in Sampler::ALL {
            let errors = errors(validation, &integrand, sampler);
            statements.extend(convergence(&integrand, sampler, sampler.name(), &errors));
            let points: Vec<_> =
                errors.counts.iter().zip(errors.mean_squares()).map(|(n, mse)| (f64::from(*n), mse.sqrt())).collect();
            curves.push(curve(sampler.name(), Style::Points, points.clone()));
            curves.push(curve(sampler.name(), Style::Line, points));
        }
        figures.push(figure(&integrand, curves));
    }
    Section {
        title: "Error falls as 1/√N",
        claim: "The variance of one sample is known in closed form, and the mean of N independent samples has 1/N of it: its error against the exact value falls as 1/√N. With every other sampler the error falls at least as fast, and the mean tends to the same value.",
        derivation: &[
            "A sample is X = L_e + ρ w X′ with the weight w = 2 cos θ of a uniform direction, E w = 1, E w² = 4/3, and X′ \
             distributed as X but independent of w. Hence E X² = L_e² + 2 L_e ρ L + ρ² (4/3) E X², which gives \
             Var X = (L_e² + 2 L_e ρ L)/(1 − 4ρ²/3) − L², finite while ρ² < 3/4. Here ρ = 0.5 and L_e = 1.",
            "With one reflection only, X = L_e (1 + 2ρ cos θ) and Var X = 4ρ² L_e² (1/3 − 1/4) = ρ² L_e²/3. The variances of independent samples add. Stratified samples are not independent, and for a smooth integrand their error falls faster.",
            "Errors are the root mean square over 1024 pixels of the estimate minus the exact value, not minus its own mean, so the curve of a sampler that converges to another value flattens out. Three integrands: one reflection (smooth, in two dimensions), a light that covers part of the \
             sky (discontinuous), and 20 reflections (smooth, in 40 dimensions). Slopes of log error over log N are fitted to each of \
             10 images with different seeds; their spread gives the standard error (Student’s t with 9 degrees of freedom), even if pixels are correlated.",
        ],
        source: "Variance of the weight: moments of cos θ uniform in [0, 1]. Sobol points are Owen-scrambled (A. Owen, “Scrambled \
                 net variance for integrals of smooth functions”, 1997).",
        statements,
        figures,
        remark: None,
    }
}

/// Variances of means over N independent samples.
fn variances(validation: &Validation, scene: &Scene) -> Vec<Statement> {
    let of = |n: u32| {
        let settings = RenderSettings { max_bounces: Some(1), ..validation.path(Directions::Uniform) };
        let pixels = samples(scene, settings, n);
        let means = Moments::of(pixels.iter().map(|samples| samples.iter().sum::<f64>() / f64::from(n)));
        let exact = ALBEDO * ALBEDO / 3.0 / f64::from(n);
        Statement::variance(format!("one reflection: variance of the mean of N = {n}"), &means, exact)
    };
    [1, 4, 16, 64, 256, 1024].map(of).into()
}

/// For every repeat, the mean error and the mean squared error at each sample count.
struct Errors {
    counts: &'static [u32],
    repeats: Vec<Vec<[f64; 2]>>,
}

fn errors(validation: &Validation, integrand: &Integrand, sampler: Sampler) -> Errors {
    let of_count = |n: &u32| {
        let settings = RenderSettings { sampler, max_bounces: Some(integrand.cap), ..validation.path(integrand.directions) };
        let pixels = samples(&integrand.scene, settings, *n);
        let error = |samples: &Vec<f64>| samples.iter().sum::<f64>() / f64::from(*n) - integrand.exact;
        let count = pixels.len() as f64;
        let sum = |power: i32| pixels.iter().map(|samples| error(samples).powi(power)).sum::<f64>() / count;
        [sum(1), sum(2)]
    };
    let counts = if validation.effort == Effort::Full { &COUNTS[..] } else { &COUNTS[..4] };
    Errors { counts, repeats: (0..REPEATS).map(|_| counts.iter().map(of_count).collect()).collect() }
}

impl Errors {
    /// Mean squared errors over all repeats.
    fn mean_squares(&self) -> Vec<f64> {
        let of = |i: usize| self.repeats.iter().map(|repeat| repeat[i][1]).sum::<f64>() / self.repeats.len() as f64;
        (0..self.counts.len()).map(of).collect()
    }

    /// Least-squares slopes of log error over log N.
    fn slopes(&self) -> Vec<f64> {
        let x: Vec<f64> = self.counts.iter().map(|n| f64::from(*n).ln()).collect();
        let middle = x.iter().sum::<f64>() / x.len() as f64;
        let spread: f64 = x.iter().map(|x| (x - middle).powi(2)).sum();
        // An error of 0 is drawn and counted as one of rounding.
        let log_error = |[_, square]: &[f64; 2]| 0.5 * square.max(1e-18).ln();
        let slope = |repeat: &Vec<[f64; 2]>| x.iter().zip(repeat).map(|(x, y)| (x - middle) * log_error(y)).sum::<f64>() / spread;
        self.repeats.iter().map(slope).collect()
    }
}

fn convergence(integrand: &Integrand, sampler: Sampler, name: &str, errors: &Errors) -> [Statement; 2] {
    let what = |text: &str| format!("{}, {name}: {text}", integrand.name);
    let most = errors.counts.last().copied().unwrap_or_default();
    let means: Vec<f64> =
        errors.repeats.iter().map(|repeat| integrand.exact + repeat.last().map_or(f64::NAN, |[error, _]| *error)).collect();
    let slopes = errors.slopes();
    let slope = if sampler.is_independent() {
        Statement::repeated(what("slope of log error over log N"), &slopes, -0.5)
    } else {
        Statement::repeated_below(what("slope of log error over log N"), &slopes, -0.5)
    };
    [Statement::repeated(what(&format!("mean of N = {most}")), &means, integrand.exact), slope.of_the_same()]
}

fn figure(integrand: &Integrand, mut curves: Vec<Curve>) -> Figure {
    if let Some(first) = curves.first().and_then(|curve| curve.points.first().copied()) {
        let most = curves[0].points.last().map_or(1.0, |point| point.0);
        curves.push(curve("rate 1/√N", Style::Dashed, vec![first, (most, first.1 / most.sqrt())]));
    }
    let caption =
        format!("Root mean square error against the exact value, over 1024 pixels and {REPEATS} seeds: {}.", integrand.name);
    plot(caption, Axis::log("samples N"), Axis::log("error against the exact value"), &curves)
}
