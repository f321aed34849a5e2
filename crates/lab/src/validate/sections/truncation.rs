//! Truncation is biased, roulette is not.
use crate::{
    report::{
        Figure,
        plot::{Axis, Style, curve, plot},
    },
    validate::{Section, Statement, Validation, check},
};
use noisefall_kernel::measure::{
    Moments,
    exact::{furnace, furnace_capped, furnace_variance},
    picture, samples,
};
use noisefall_scene::{
    sampling::Directions,
    scene::{RenderSettings, Roulette},
};

const ALBEDO: f64 = 0.5;
const CAPS: u32 = 8;
/// Only caps whose bias exceeds this many standard errors get a row that requires the bias to be significant.
const PLAIN: f64 = 8.0;
const SURVIVALS: [f64; 7] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

pub fn section(validation: &Validation) -> Section {
    let scene = check::furnace(ALBEDO);
    let exact = furnace(1.0, ALBEDO);
    let mut statements = Vec::new();
    let mut capped = Vec::new();
    for cap in 0..=CAPS {
        let settings = RenderSettings { max_bounces: Some(cap), ..validation.path(Directions::Uniform) };
        let found = validation.moments(&scene, settings, 2500);
        let partial = furnace_capped(1.0, ALBEDO, cap);
        capped.push((f64::from(cap), found.mean));
        let error = (found.variance / found.count).sqrt();
        if cap == 0 {
            statements.push(Statement::within("cap at 0: emission alone", found.mean, partial, 0.0));
            continue;
        }
        statements.push(Statement::z(format!("cap at {cap}: the partial sum"), found.mean, error, partial));
        if exact - partial > PLAIN * error {
            let bias = (found.mean - exact) / error;
            let what = format!("cap at {cap}: its bias is beyond doubt, in standard errors from {exact}");
            statements.push(Statement::below(what, bias, -4.0).of_the_same());
        }
    }
    let (mut survived, mut cost) = (Vec::new(), Vec::new());
    for q in SURVIVALS {
        let settings = RenderSettings { roulette: Roulette::fixed(q as f32), ..validation.path(Directions::Cosine) };
        let values = samples(&scene, settings, validation.spp(2500));
        let found = Moments::of(values.iter().flatten().copied());
        survived.push((q, found.mean));
        cost.push((q, found.variance / (1.0 - q)));
        let (variance, what) = (furnace_variance(1.0, ALBEDO, 1.0 / q), format!("roulette, survival {q}"));
        // E|X|³ is finite while ρ³ E w³ = ρ³/q² < 1.
        if ALBEDO.powi(3) < q * q {
            statements.push(Statement::mean_with(what, &found, exact, variance));
        } else {
            statements.push(Statement::catoni(what, values.iter().flatten().copied(), exact, variance));
        }
        statements.push(survivals(&values, q).of_the_same());
    }
    let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..validation.path(Directions::Uniform) };
    let by_throughput = picture(&scene, settings, check::RED, validation.spp(1500)).whole();
    statements.push(Statement::mean("roulette by throughput, uniform directions", by_throughput, exact));
    Section {
        title: "Truncation is biased, roulette is not",
        claim: "A cap of n bounces gives the partial sum of the series; Russian roulette gives the whole series, with finite variance as long as q > ρ².",
        derivation: &[
            "The k-th bounce contributes L_e ρᵏ, so a cap of n bounces gives L_e (1 − ρⁿ⁺¹)/(1 − ρ): the image is too dark by L_e ρⁿ⁺¹/(1 − ρ), no matter how many samples are taken.",
            "With cosine directions and fixed roulette, a path that ends after its k-th wall has the value Σ (ρ/q)ⁱ up to i = k, with probability (1 − q) qᵏ. A χ² test compares the lengths of paths with that distribution; it needs no assumption about moments.",
            "A path that survives with probability q and is then weighted by 1/q has the mean q · X/q = X of the infinite path. With \
             cosine directions the weight is 1/q or 0, E w² = 1/q, and by the formula of section 2 the variance is \
             (L_e² + 2 L_e ρ L)/(1 − ρ²/q) − L², finite while q > ρ²; with uniform directions E w² = 4/(3q), finite while q > 4ρ²/3. A path has 1/(1 − q) segments on average, which is its cost. For q = 0.3 the third moment is infinite (ρ³ > q²); that row has Catoni’s bound, as in \
             section 1.",
            "For q ≤ ρ² = 0.25 the estimate is still unbiased, but its variance is infinite. The last figure shows the running sample variance for q = 0.2: it jumps with every rare sample and never settles. No standard error can be given, so there is no row.",
        ],
        source: "J. Arvo and D. Kirk, “Particle Transport and Image Synthesis”, SIGGRAPH 1990. ρ = 0.5, L_e = 1. The bias of a cap has a row where it exceeds 8 standard errors at this number of samples.",
        statements,
        figures: vec![caps(&capped, exact), roulettes(&survived, exact), costs(cost), running_variances(validation)],
        remark: None,
    }
}

fn caps(found: &[(f64, f64)], exact: f64) -> Figure {
    let sums = found.iter().map(|&(cap, _)| (cap, furnace_capped(1.0, ALBEDO, cap as u32))).collect();
    let curves = [
        curve("measured", Style::Points, found.to_vec()),
        curve("partial sum", Style::Line, sums),
        curve("Lₑ/(1 − ρ)", Style::Dashed, vec![(0.0, exact), (f64::from(CAPS), exact)]),
    ];
    plot(
        "The estimate against the cap: every cap has its own, wrong, limit.",
        Axis::linear("cap"),
        Axis::linear("radiance"),
        &curves,
    )
}

fn roulettes(found: &[(f64, f64)], exact: f64) -> Figure {
    let curves = [
        curve("measured", Style::Points, found.to_vec()),
        curve("exact ± 1 %", Style::Line, vec![(0.3, exact), (0.9, exact)]),
        curve("exact ± 1 %", Style::Dashed, vec![(0.3, exact * 1.01), (0.9, exact * 1.01)]),
        curve("exact ± 1 %", Style::Dashed, vec![(0.3, exact * 0.99), (0.9, exact * 0.99)]),
    ];
    let caption = "The estimate against the survival probability; the table has the standard errors.";
    plot(caption, Axis::linear("survival probability q"), Axis::linear("radiance"), &curves)
}

/// χ² test of the lengths of paths. Long paths are counted together.
fn survivals(values: &[Vec<f64>], q: f64) -> Statement {
    const LONGEST: usize = 40;
    let (mut worth, mut sum, mut term) = (Vec::new(), 0.0, 1.0);
    while worth.len() < LONGEST && term > 1e-4 * sum {
        sum += term;
        term *= ALBEDO / q;
        worth.push(sum);
    }
    let mut counts = vec![0.0; worth.len() + 1];
    for value in values.iter().flatten() {
        counts[worth.partition_point(|worth| *worth < value * (1.0 - 2e-5))] += 1.0;
    }
    let total: f64 = counts.iter().sum();
    let share = |k: usize| q.powi(k as i32) * if k < worth.len() { 1.0 - q } else { 1.0 };
    let expected: Vec<f64> = (0..counts.len()).map(|k| share(k) * total).collect();
    Statement::chi_squared(format!("survival {q}: lengths of paths against (1 − q) qᵏ"), &counts, &expected)
}

/// Running sample variances, with finite and with infinite variance.
fn running_variances(validation: &Validation) -> Figure {
    let mut curves = Vec::new();
    for q in [0.2, 0.4] {
        let settings = RenderSettings { roulette: Roulette::fixed(q as f32), ..validation.path(Directions::Cosine) };
        let values: Vec<f64> = samples(&check::furnace(ALBEDO), settings, validation.spp(2000)).into_iter().flatten().collect();
        let (mut sum, mut square, mut points) = (0.0, 0.0, Vec::new());
        let mut next = 100.0;
        for (n, x) in (1..).zip(&values) {
            (sum, square) = (sum + x, square + x * x);
            let n = f64::from(n);
            if n >= next {
                points.push((n, (square - sum * sum / n) / (n - 1.0)));
                next = n * 1.05;
            }
        }
        curves.push(curve(format!("q = {q}"), Style::Line, points));
    }
    let exact = furnace_variance(1.0, ALBEDO, 1.0 / 0.4);
    curves.push(curve("exact for q = 0.4", Style::Dashed, vec![(100.0, exact), (1e6, exact)]));
    let caption = "The variance of the first N samples with ρ = 0.5: for q = 0.4 it settles at the exact one, for q = 0.2 ≤ ρ² it grows \
                   without end.";
    plot(caption, Axis::log("samples N"), Axis::log("variance of the samples"), &curves)
}

/// Variance × segments, the cost of a given precision.
fn costs(measured: Vec<(f64, f64)>) -> Figure {
    let cost = |albedo: f64, weight_square: f64| {
        let survivals = (0..200).map(|i| 0.3 + 0.695 * f64::from(i) / 199.0);
        let finite = survivals.filter(move |q| albedo * albedo * weight_square / q < 0.97);
        finite.map(|q| (q, furnace_variance(1.0, albedo, weight_square / q) / (1.0 - q))).collect()
    };
    let curves = [
        curve("cosine directions", Style::Line, cost(ALBEDO, 1.0)),
        curve("cosine directions", Style::Points, measured),
        curve("uniform directions", Style::Line, cost(ALBEDO, 4.0 / 3.0)),
    ];
    let caption = "Where roulette pays: variance × segments of a path, the cost of a given precision, by the closed forms (lines) and measured (points). Cosine \
                   directions have no variance of their own, so paths should rarely be ended; with the noise of uniform \
                   directions there is a best survival probability.";
    plot(caption, Axis::linear("survival probability q"), Axis::log("variance × segments"), &curves)
}
