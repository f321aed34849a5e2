//! BSDFs against their formulas.
use std::f64::consts::PI;

use glam::DVec3;

use super::energy::ball;
use crate::validate::{
    Section, Statement, Validation,
    check::{RED, Random, lanes, largest, wide},
    microfacets::{albedo, average, dielectric, direction, interface_albedo, metal, over_hemisphere, reflection, refraction},
};
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};
use noisefall_kernel::measure::{Moments, picture};
use noisefall_scene::{
    material::{
        Bsdf, Conductor, Dielectric, LambertianBsdf, Local, Materials, Mirror, Plastic, Reflectance, RoughDielectric, Shade, ggx,
    },
    sampling::Directions,
};

const IOR: f64 = 1.5;
const GOLD: ([f32; 3], [f32; 3]) = ([0.143, 0.374, 1.442], [3.983, 2.386, 1.603]);
const COSINES: [f64; 5] = [1.0, 0.8, 0.5, 0.25, 0.1];
/// Relative errors of f in f32.
const ROUNDING: f64 = 1e-5;
/// Relative error of tables. It is largest at α = 0.1, where the table varies most within a cell.
const TABLES: f64 = 1e-2;
/// f of a diffuse surface of albedo 0.05. Errors of smaller f are relative to this.
const FAINT: f64 = 0.05 / PI;

pub fn section(validation: &Validation) -> Section {
    let mut statements = diffuse(validation);
    statements.push(mirror(validation));
    for alpha in [0.1, 0.36, 1.0] {
        statements.extend(metals(validation, alpha));
    }
    for eta in [IOR, 1.0 / IOR] {
        statements.extend(interfaces(validation, eta));
    }
    statements.extend(coats());
    statements.push(black_plastic(validation));
    Section {
        title: "Surfaces and their formulas",
        claim: "BSDFs agree with their formulas: f at pairs of directions, and its integral by quadrature.",
        derivation: &[
            "Microfacets have f = F D G/(4 cos θ_o cos θ_i), with D = α²/(π cos⁴θ (α² + tan²θ)²) and G = G₁(ω_o) G₁(ω_i), \
             G₁ = 2/(1 + √(1 + α² tan²θ)); those that refract have f = (1 − F) D G |ω_o·h ω_i·h|/(|cos θ_o cos θ_i| (ω_o·h + η ω_i·h)²). \
             The report evaluates these in f64, in separate code, and compares the renderer with them. \
             ∫ D cos θ dω = 1.",
            "The albedo is ∫ f cos θ_i dω_i, by quadrature over facets with u = tan²θ/(α² + tan²θ), in which D cos θ dω is uniform. The mean weight of samples must equal this number: a wrong D or G changes it even if the program's own tables agree with each other.",
            "Energy compensation restores the loss of single scattering, 1 − E(μ), as (1 − E(ω_o))(1 − E(ω_i)) F_s/(π (1 − E_avg)) with \
             F_s = F_avg² E_avg/(1 − F_avg (1 − E_avg)). Plastic has a base ρ T(ω_o) T(ω_i)/(π (η² (1 − ρ) + ρ T_avg)) under its coat, \
             where T(μ) = 1 − E(μ) is the transmittance of the coat. Here E is integrated for each direction, while the renderer interpolates tables. Errors are relative to f, or to f of a diffuse surface of albedo 0.05 if f is smaller.",
            "Black plastic reflects with its coat alone: in a uniform field of 1, the image of a distant smooth ball has the mean radiance 2 ∫ F(μ) μ dμ.",
        ],
        source: "B. Walter et al., “Microfacet Models for Refraction through Rough Surfaces”, 2007; E. Heitz, “Understanding the \
                 Masking-Shadowing Function in Microfacet-Based BRDFs”, 2014; C. Kulla and A. Conty, 2017; W. G. Egan and T. Hilgeman, 1979.",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}

fn local(colour: f32, alpha: f64, front: bool) -> Local<One> {
    Local { material: U(0), colour: V::splat(One, [colour; 3]), alpha: F(alpha as f32), front: M(front) }
}

/// The red channel of f.
fn f(bsdf: &impl Bsdf<One>, wo: DVec3, wi: DVec3) -> f64 {
    f64::from(bsdf.eval(lanes(wo), lanes(wi)).0.x.0) / wi.z.abs()
}

/// The mean weight of samples seen at cosine `mu`, without the factor 1/η² of radiance, against an integral.
fn sampled(what: String, (count, random): (u32, Random), bsdf: &impl Bsdf<One>, mu: f64, eta: f64, exact: f64) -> Statement {
    let wo = lanes(direction(mu, 0.6));
    let weight = |i: u32| {
        let (u, lobe) = random.direction(i);
        let sample = bsdf.sample(wo, u, lobe);
        f64::from(sample.weight.x.0) * if sample.wi.z.0 < 0.0 { eta * eta } else { 1.0 }
    };
    let found = Moments::of((0..count).map(weight));
    Statement::z(what, found.mean, (found.variance / found.count).sqrt(), exact)
}

/// The largest relative error of pairs of a number and the exact one.
fn worst(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    largest(pairs.map(|(found, exact)| (found / exact - 1.0).abs()))
}

fn diffuse(validation: &Validation) -> Vec<Statement> {
    let mut statements = Vec::new();
    for directions in Directions::ALL {
        let bsdf = LambertianBsdf { albedo: V::splat(One, [0.6; 3]), directions };
        let wo = direction(0.7, 0.0);
        let what = |text: &str| format!("lambertian, {} directions: {text}", directions.name());
        let reflected = over_hemisphere(|wi| f64::from(bsdf.eval(lanes(wo), lanes(wi)).0.x.0));
        let density = over_hemisphere(|wi| f64::from(bsdf.eval(lanes(wo), lanes(wi)).1.0));
        statements.push(Statement::within(what("∫ f cos θ dω"), reflected, 0.6, 1e-5));
        statements.push(Statement::within(what("∫ p dω"), density, 1.0, 1e-5));
        let (count, random) = (validation.spp(20_000), validation.random());
        let weights = (0..count).map(|i| {
            let (u, lobe) = random.direction(i);
            let sample = bsdf.sample(lanes(wo), u, lobe);
            let cos = wide(sample.wi).z;
            let p = if directions == Directions::Uniform { 1.0 / (2.0 * PI) } else { cos / PI };
            (f64::from(sample.weight.x.0), 0.6 / PI * cos / p)
        });
        statements.push(Statement::below(what("largest relative error of a weight against f cos θ/p"), worst(weights), 1e-6));
    }
    statements
}

/// Directions and weights at a smooth metal.
fn mirror(validation: &Validation) -> Statement {
    let fresnel = Reflectance::index(GOLD.0, GOLD.1);
    let materials = Materials::new(&[Conductor::new(fresnel, 0.0, true).into()]);
    let gold = Mirror::at(One, &materials, Directions::Bsdf, &local(1.0, 0.0, true));
    let random = validation.random();
    let error = |i: u32| {
        let wo = Directions::Uniform.sample(random.direction(i).0);
        let sample = gold.sample(wo, (F(0.5), F(0.5)), F(0.5));
        let (out, wi, weight) = (wide(wo), wide(sample.wi), wide(sample.weight).to_array());
        let turned = (wi - DVec3::new(-out.x, -out.y, out.z)).length();
        let channel = |c: usize| (weight[c] - metal(out.z, f64::from(GOLD.0[c]), f64::from(GOLD.1[c]))).abs();
        (0..3).map(channel).fold(turned, f64::max)
    };
    let what = "smooth gold: largest error of a direction, or of a weight against Fresnel’s equations";
    Statement::below(what, largest((0..validation.spp(20_000)).map(error)), 5e-6)
}

/// Rough metals: single scattering, and with energy compensation.
fn metals(validation: &Validation, alpha: f64) -> Vec<Statement> {
    let what = |text: &str| format!("metal, α = {alpha}: {text}");
    let metal_of = |fresnel, compensated| Materials::new(&[Conductor::new(fresnel, alpha as f32, compensated).into()]);
    let perfect = metal_of(Reflectance::Constant(Textured::grey(1.0)), false);
    let single = Conductor::at(One, &perfect, Directions::Bsdf, &local(1.0, alpha, true));
    let random = validation.random();
    // In u = tan²/(α² + tan²) cos θ dω is π α² cos⁴θ/(1 − u)² du.
    let area = (0..1000).map(|i| {
        let u = (f64::from(i) + 0.5) / 1000.0;
        let cos = (1.0 + alpha * alpha * u / (1.0 - u)).sqrt().recip();
        f64::from(ggx::d(F::<One>(alpha as f32), lanes(direction(cos, 0.0))).0) * PI * (alpha * cos * cos / (1.0 - u)).powi(2)
    });
    let pair = |i: u32| {
        let [wo, wi] = [2 * i, 2 * i + 1].map(|i| wide(Directions::Uniform.sample(random.direction(i).0)));
        (f(&single, wo, wi), reflection(alpha, wo, wi, |_| 1.0))
    };
    let pairs = worst((0..validation.spp(20_000)).map(pair));
    let mut statements = vec![
        Statement::within(what("∫ D cos θ dω"), area.sum::<f64>() / 1000.0, 1.0, 1e-5),
        Statement::below(what("largest relative error of f, single scattering"), pairs, ROUNDING),
    ];
    for mu in [0.9, 0.3] {
        let exact = albedo(alpha, mu, |_| 1.0);
        let samples = (validation.spp(600) * 1000, validation.random());
        statements.push(sampled(what(&format!("albedo at cos θ = {mu}")), samples, &single, mu, 1.0, exact));
    }
    let gold = metal_of(Reflectance::index(GOLD.0, GOLD.1), true);
    let whole = Conductor::at(One, &gold, Directions::Bsdf, &local(1.0, alpha, true));
    let red = |cos: f64| metal(cos, f64::from(GOLD.0[0]), f64::from(GOLD.1[0]));
    let lost = COSINES.map(|mu| 1.0 - albedo(alpha, mu, |_| 1.0));
    let mean_lost = average(96, |mu| 1.0 - albedo(alpha, mu, |_| 1.0));
    let mean = average(200, red);
    let again = mean * mean * (1.0 - mean_lost) / (1.0 - mean * mean_lost) / (PI * mean_lost);
    let exact = |o: usize, i: usize, wo: DVec3, wi: DVec3| reflection(alpha, wo, wi, red) + again * lost[o] * lost[i];
    statements.push(Statement::below(
        what("gold: largest relative error of f, with energy compensation"),
        worst(grid(&whole, exact).into_iter()),
        TABLES,
    ));
    statements
}

/// Pairs of f and its exact value for directions with [`COSINES`]. Errors of values below [`FAINT`] are relative to that.
fn grid(bsdf: &impl Bsdf<One>, exact: impl Fn(usize, usize, DVec3, DVec3) -> f64) -> Vec<(f64, f64)> {
    let pairs = (0..COSINES.len()).flat_map(|o| (0..COSINES.len()).flat_map(move |i| [0.1, 1.0, 3.0].map(|turn| (o, i, turn))));
    let pair = |(o, i, turn): (usize, usize, f64)| {
        let (wo, wi) = (direction(COSINES[o], 0.0), direction(COSINES[i], PI - turn));
        let exact = exact(o, i, wo, wi);
        (exact + (f(bsdf, wo, wi) - exact) * (exact / exact.max(FAINT)), exact)
    };
    pairs.map(pair).collect()
}

/// Rough glass with single scattering, seen from outside (η > 1) and from inside.
fn interfaces(validation: &Validation, eta: f64) -> Vec<Statement> {
    let alpha = 0.3;
    let glass = Dielectric::new(IOR as f32, alpha as f32, false).into();
    let materials = Materials::new(&[glass]);
    let bsdf = RoughDielectric::at(One, &materials, Directions::Bsdf, &local(1.0, alpha, eta > 1.0));
    let side = if eta > 1.0 { "from outside" } else { "from inside" };
    let what = |text: &str| format!("rough glass, α = {alpha}, {side}: {text}");
    let random = validation.random();
    let pair = |i: u32| {
        let (u, lobe) = random.direction(2 * i);
        let wo = Directions::Uniform.sample(u);
        let sample = bsdf.sample(wo, random.direction(2 * i + 1).0, lobe);
        let (wo, wi) = (wide(wo), wide(sample.wi));
        let exact = |wo: DVec3| {
            if wi.z > 0.0 { reflection(alpha, wo, wi, |cos| dielectric(cos, eta).0) } else { refraction(alpha, wo, wi, eta) }
        };
        // f at grazing facets is many orders of magnitude smaller.
        let is_rare = sample.weight.x.0 == 0.0 || exact(wo) * wi.z.abs() < 1e-3;
        if is_rare { (1.0, 1.0) } else { (beyond_digits(f(&bsdf, wo, wi), wo, exact), exact(wo)) }
    };
    let mut statements = vec![Statement::below(
        what("largest relative error of f, single scattering"),
        worst((0..validation.spp(20_000)).map(pair)),
        10.0 * ROUNDING,
    )];
    for mu in [0.9, 0.3] {
        let exact = interface_albedo(alpha, mu, eta);
        let samples = (validation.spp(600) * 1000, validation.random());
        statements.push(sampled(what(&format!("albedo at cos θ = {mu}")), samples, &bsdf, mu, eta, exact));
    }
    statements
}

/// Moves `found` towards the exact number by the change that rounding of the direction makes. Next to total reflection 1 − F
/// falls as a square root, so rounding changes it much.
fn beyond_digits(found: f64, w: DVec3, exact: impl Fn(DVec3) -> f64) -> f64 {
    const DIGITS: f64 = 4.0 * f32::EPSILON as f64;
    let at = exact(w);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let spread = largest(axes.map(|axis| (exact(w + axis * DIGITS) - at).abs()));
    at + ((found - at).abs() - spread).max(0.0)
}

/// Plastic, smooth and rough.
fn coats() -> Vec<Statement> {
    let (rho, coat) = (0.8, |cos: f64| dielectric(cos, IOR).0);
    let of = |alpha: f64| {
        let material = Plastic::new([rho as f32; 3], IOR as f32, alpha as f32).into();
        let materials = Materials::new(&[material]);
        let bsdf = Plastic::at(One, &materials, Directions::Bsdf, &local(rho as f32, alpha, true));
        let is_rough = alpha > 0.0;
        let passes = |mu: f64| 1.0 - if is_rough { albedo(alpha, mu, coat) } else { coat(mu) };
        let through = COSINES.map(passes);
        let mean = average(if is_rough { 64 } else { 400 }, passes);
        let base = rho / (PI * (IOR * IOR * (1.0 - rho) + rho * mean));
        let exact = |o: usize, i: usize, wo: DVec3, wi: DVec3| {
            base * through[o] * through[i] + if is_rough { reflection(alpha, wo, wi, coat) } else { 0.0 }
        };
        let what = if is_rough { format!("plastic, α = {alpha}") } else { "smooth plastic".to_owned() };
        Statement::below(
            format!("{what}: largest relative error of f"),
            worst(grid(&bsdf, exact).into_iter()),
            if is_rough { TABLES } else { ROUNDING },
        )
    };
    [0.0, 0.1, 0.5].map(of).into()
}

/// A ball with a coat over a black base, in front of a uniform background.
fn black_plastic(validation: &Validation) -> Statement {
    let scene = ball("plastic = { albedo = 0.0, ior = 1.5 }");
    let found = picture(&scene, validation.path(Directions::Cosine), RED, validation.spp(2000)).whole();
    let disk = PI / 4.0;
    let exact = disk * average(2000, |mu| dielectric(mu, IOR).0) + 1.0 - disk;
    Statement::mean("black plastic: mean of an image with its ball and the field around it", found, exact)
}

#[cfg(test)]
mod tests {
    use super::beyond_digits;

    #[test]
    fn only_differences_beyond_the_last_digit_are_errors() {
        let w = glam::DVec3::new(0.0, 0.0, 0.25);
        // A square root of the height changes by 4ε/(2 · 0.5).
        let spread = 4.0 * f64::from(f32::EPSILON);
        let found = |error: f64| beyond_digits(0.5 + error, w, |w| w.z.max(0.0).sqrt()) - 0.5;
        assert_eq!([0.0, 0.9 * spread, -0.9 * spread].map(found), [0.0; 3]);
        assert!((found(1e-3) + spread - 1e-3).abs() < 1e-9 && (found(-1e-3) + spread - 1e-3).abs() < 1e-9);
    }
}
