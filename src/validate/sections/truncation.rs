//! 3. Truncation is biased, roulette is not.
use crate::{
    measure::exact::{furnace, furnace_capped, furnace_variance},
    report::{
        Figure,
        plot::{Axis, Style, curve, plot},
    },
    sampling::Directions,
    scene::{RenderSettings, Roulette},
    validate::{Section, Statement, Validation, check},
};

const ALBEDO: f64 = 0.5;
const CAPS: u32 = 8;
const SURVIVALS: [f64; 7] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

pub fn section(validation: &Validation) -> Section {
    let scene = check::furnace(ALBEDO);
    let exact = furnace(1.0, ALBEDO);
    let mut statements = Vec::new();
    let mut capped = Vec::new();
    for cap in 0..=CAPS {
        let settings = RenderSettings { max_bounces: Some(cap), ..validation.path(Directions::Uniform, 40 + cap) };
        let found = validation.moments(&scene, settings, 2500);
        let partial = furnace_capped(1.0, ALBEDO, cap);
        capped.push((f64::from(cap), found.mean));
        let error = (found.variance / found.count).sqrt();
        if cap == 0 {
            statements.push(Statement::within("cap at 0: emission alone", found.mean, partial, 0.0));
            continue;
        }
        statements.push(Statement::z(format!("cap at {cap}: the partial sum"), found.mean, error, partial));
        if cap <= 6 {
            let bias = (found.mean - exact) / error;
            let what = format!("cap at {cap}: its bias is beyond doubt, in standard errors from {exact}");
            statements.push(Statement::below(what, bias, -4.0));
        }
    }
    let (mut survived, mut cost) = (Vec::new(), Vec::new());
    for (number, q) in (60..).zip(SURVIVALS) {
        let settings = RenderSettings { roulette: Roulette::Fixed(q as f32), ..validation.path(Directions::Cosine, number) };
        let found = validation.moments(&scene, settings, 2500);
        survived.push((q, found.mean));
        cost.push((q, found.variance / (1.0 - q)));
        let variance = furnace_variance(1.0, ALBEDO, 1.0 / q);
        statements.push(Statement::mean_with(format!("roulette, survival {q}"), &found, exact, variance));
    }
    Section {
        title: "Truncation is biased, roulette is not",
        claim: "A cap of n bounces gives the partial sum of the series and nothing else; Russian roulette gives all of it at \
                any survival probability.",
        derivation: &[
            "The k-th bounce carries L_e ρᵏ, so that a cap of n leaves L_e (1 − ρⁿ⁺¹)/(1 − ρ): the picture is too dark by \
             L_e ρⁿ⁺¹/(1 − ρ), however many samples are taken.",
            "A path that survives with probability q and is then weighted by 1/q has the mean q · X/q = X of the endless path. With \
             cosine directions the weight is 1/q or 0, E w² = 1/q, and by the formula of section 2 the variance is \
             (L_e² + 2 L_e ρ L)/(1 − ρ²/q) − L², finite while q > ρ²; with uniform directions E w² = 4/(3q), finite while q > 4ρ²/3. A path has 1/(1 − q) segments on the mean: \
             that is its cost.",
        ],
        source: "J. Arvo and D. Kirk, “Particle Transport and Image Synthesis”, SIGGRAPH 1990. ρ = 0.5, L_e = 1. The biases of caps at 7 and 8 \
                 are too small for this number of samples to be plain.",
        statements,
        figures: vec![caps(&capped, exact), roulettes(&survived, exact), costs(cost)],
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
    let caption = "The estimate against the survival probability: within its standard error (in the table) of the exact line at all of them.";
    plot(caption, Axis::linear("survival probability q"), Axis::linear("radiance"), &curves)
}

/// Variance times segments: what a unit of precision costs.
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
                   directions have no variance of their own, so that paths should hardly be ended; with the noise of uniform \
                   directions there is a best survival probability.";
    plot(caption, Axis::linear("survival probability q"), Axis::log("variance × segments"), &curves)
}
