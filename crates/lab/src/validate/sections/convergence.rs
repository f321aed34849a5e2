//! The estimate converges to the algebraic solution.
use crate::{
    report::{
        Figure,
        plot::{Axis, Style, curve, plot},
    },
    validate::{Section, Statement, Validation, check},
};
use noisefall_kernel::measure::{
    Moments,
    exact::{furnace, furnace_variance},
    samples,
};
use noisefall_scene::sampling::Directions;

const ALBEDOS: [f64; 3] = [0.2, 0.5, 0.8];

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    for albedo in ALBEDOS {
        let scene = check::furnace(albedo);
        let exact = furnace(1.0, albedo);
        let found = samples(&scene, validation.path(Directions::Uniform), validation.spp(1600));
        let variance = furnace_variance(1.0, albedo, 4.0 / 3.0);
        let what = format!("ρ = {albedo}, uniform directions");
        if has_third_moment(albedo) {
            let uniform = Moments::of(found.iter().flatten().copied());
            statements.push(Statement::mean_with(what, &uniform, exact, variance));
        } else {
            statements.push(Statement::catoni(what, found.iter().flatten().copied(), exact, variance));
        }
        let cosine = validation.moments(&scene, validation.path(Directions::Cosine), 100);
        // Every weight is ρ, so each sample is the series up to rounding.
        statements.push(Statement::within(format!("ρ = {albedo}, cosine directions"), cosine.mean, exact, 2e-6 * exact));
        statements.push(
            Statement::within(format!("ρ = {albedo}, cosine directions: variance"), cosine.variance, 0.0, 1e-10).of_the_same(),
        );
    }
    Section {
        title: "The estimate converges to the algebraic solution",
        claim: "In a closed room that emits L_e and reflects ρ everywhere, the radiance is L_e/(1 − ρ).",
        derivation: &[
            "By symmetry the radiance L is the same at every point and in every direction. The integral over the hemisphere is then ρ L, and the equation becomes L = L_e + ρ L, so L = L_e/(1 − ρ): no discretisation, no approximation.",
            "A path of uniform directions multiplies its throughput by ρ · 2 cos θ at every wall, of mean ρ; a path of \
             cosine-distributed directions by ρ itself, so that every single sample is the geometric series. No path is capped here: \
             it ends when its throughput falls below 1.2 · 10⁻³⁸, the smallest normal number of f32, which is far below the rounding of the sum.",
            "E|X|³ is finite while ρ³ E w³ = 2ρ³ < 1. For ρ = 0.8 it is infinite, and it is unknown how fast the distribution of the mean of N samples approaches the normal one. That row uses a bound by O. Catoni, which needs only the variance, holds for every N and is about as sharp.",
        ],
        source: "The furnace test. Camera inside a sphere, L_e = 1. O. Catoni, “Challenging the empirical mean and empirical variance”, 2012; the \
                 variance is that of section 2.",
        statements,
        figures: vec![running_means(validation)],
        remark: None,
    }
}

/// Whether the third moment of samples by uniform directions is finite: E (2 cos θ)³ = 2.
fn has_third_moment(albedo: f64) -> bool {
    2.0 * albedo.powi(3) < 1.0
}

/// Running means of single pixels with the 95 % band around the exact value.
fn running_means(validation: &Validation) -> Figure {
    const ALBEDO: f64 = 0.5;
    let count = validation.spp(12_000);
    let pixels = samples(&check::furnace(ALBEDO), validation.path(Directions::Uniform), count);
    let numbers: Vec<usize> = (0..60).map(|i| f64::from(count).powf(f64::from(i) / 59.0) as usize).collect();
    let (exact, variance) = (furnace(1.0, ALBEDO), furnace_variance(1.0, ALBEDO, 4.0 / 3.0));
    let band = |sign: f64| numbers.iter().map(|&n| (n as f64, exact + sign * 1.96 * (variance / n as f64).sqrt())).collect();
    let mut curves = vec![
        curve("exact, and 95 % of means", Style::Line, numbers.iter().map(|&n| (n as f64, exact)).collect()),
        curve("exact, and 95 % of means", Style::Dashed, band(1.0)),
        curve("exact, and 95 % of means", Style::Dashed, band(-1.0)),
    ];
    for pixel in [0, 341, 682] {
        let mean = |&n: &usize| (n as f64, Moments::of(pixels[pixel][..n].iter().copied()).mean);
        curves.push(curve(format!("pixel {pixel}"), Style::Line, numbers.iter().map(mean).collect()));
    }
    let caption = "Running means of three pixels (ρ = 0.5, uniform directions) against the number of samples N, with the band \
                   1.96 σ/√N by the closed form of σ (section 2), in which 95 of 100 lie at any one N.";
    plot(caption, Axis::log("samples N"), Axis::linear("radiance"), &curves)
}
