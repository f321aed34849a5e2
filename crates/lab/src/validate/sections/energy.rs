//! Energy.
use glam::DVec3;
use rayon::prelude::*;

use crate::{
    report::plot::{Axis, Style, curve, plot},
    validate::{
        Section, Statement, Validation,
        cells::Cells,
        check::{RED, Random, TABLES, lanes, largest, scene},
        microfacets::direction,
        statement::SIGMAS,
    },
};
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};
use noisefall_kernel::measure::{Mean, Picture, picture};
use noisefall_scene::{
    material::{Bsdf, Conductor, Dielectric, Local, Materials, Plastic, Reflectance, RoughDielectric, Shade},
    sampling::Directions,
    scene::Scene,
};

const CAPTION: &str = "The radiance of lossless balls by the cosine of the angle at which their surface is seen, each at its roughest. \
                       Exact is 1, within what the tables of lost light interpolate.";
const SIDE: usize = 48;
const MATERIALS: [(&str, &str, &[f64]); 6] = [
    ("lambertian", "lambertian = { albedo = 1.0 }", &[0.0]),
    ("mirror", "mirror = { reflectance = 1.0 }", &[0.0]),
    ("perfect metal", "conductor = { f0 = 1.0, roughness = ROUGHNESS }", &[0.1, 0.3, 0.6, 1.0]),
    ("white plastic", "plastic = { albedo = 1.0, ior = 1.5, roughness = ROUGHNESS }", &[0.0, 0.3, 0.6, 1.0]),
    ("glass", "dielectric = { ior = 1.5 }", &[0.0]),
    ("rough glass", "dielectric = { ior = 1.5, roughness = ROUGHNESS }", &[0.3, 0.6, 1.0]),
];

/// A ball of this material in a uniform field of radiance 1.
pub fn ball(material: &str) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.0, 0.0, 5.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 2.0, \
         resolution = [{SIDE}, {SIDE}] }}
        environment.radiance = 1.0
        materials.ball.{material}
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
        material = 'ball'"
    ))
}

pub fn section(validation: &Validation) -> Section {
    let (mut statements, mut curves) = (Vec::new(), Vec::new());
    for (name, text, roughnesses) in MATERIALS {
        for roughness in roughnesses {
            let scene = ball(&text.replace("ROUGHNESS", &format!("{roughness:?}")));
            let found = picture(&scene, validation.path(Directions::Cosine), RED, validation.spp(2000));
            let rings = rings(&found);
            let what = if roughnesses.len() > 1 { format!("{name}, roughness {roughness}") } else { name.to_owned() };
            let whole = Mean::of(rings.iter().map(|(_, ring)| *ring));
            // Smooth surfaces use no tables.
            let tolerance = if *roughness > 0.0 { TABLES } else { 1e-5 };
            statements.push(Statement::near(format!("{what}: mean over angles"), whole, 1.0, tolerance));
            let scores: Vec<f64> = rings.iter().map(|(_, ring)| z(*ring, tolerance)).collect();
            let sigma = largest(rings.iter().map(|(_, ring)| error(*ring, tolerance)));
            let angles =
                Statement::largest_z(format!("{what}: largest |z| of {} angles", rings.len()), &scores, SIGMAS + 0.5, sigma);
            statements.push(angles.of_the_same());
            if roughnesses.last() == Some(roughness) {
                curves.push(curve(what, Style::Line, rings.iter().map(|(cos, ring)| (*cos, ring.mean)).collect()));
            }
        }
    }
    let (tables, remark) = tables();
    statements.extend(tables);
    statements.extend(reciprocity(validation));
    Section {
        title: "Energy",
        claim: "A surface that absorbs nothing is invisible in a uniform field: it neither gains nor loses light at any angle or roughness. The BSDF is reciprocal.",
        derivation: &[
            "In a uniform field of radiance 1 a lossless surface has L/n² = 1 in every direction, so the radiance is 1 outside and n² inside glass. A ball of any lossless material is invisible against the environment. At the edge of the ball it is seen at grazing \
             angles. Light is reflected and refracted many times in a glass ball; all contributions add up to 1.",
            "Rough surfaces lose the light that scatters more than once between microfacets, unless energy compensation restores it from interpolated tables. The interpolation changes the light of a metal by up to 3 · 10⁻⁴. Renders of rough surfaces therefore allow an error of 10⁻³ besides the noise, and detect nothing smaller. Rows by quadrature, which has no noise, state the actual error. Smooth surfaces allow rounding only.",
            "Helmholtz reciprocity: f(ω_i, ω_o) = f(ω_o, ω_i) for every pair of directions on the same side.",
        ],
        source: "The white furnace; C. Kulla and A. Conty, “Revisiting Physically Based Shading at Imageworks”, SIGGRAPH 2017 courses.",
        statements,
        figures: vec![plot(CAPTION, Axis::linear("cos θ"), Axis::linear("radiance"), &curves)],
        remark,
    }
}

/// The standard error of a mean near 1, with the error of tables included.
fn error(found: Mean, tolerance: f64) -> f64 {
    found.variance_of_mean.sqrt().hypot(tolerance / SIGMAS)
}

/// The deviation of a mean from 1 in such standard errors.
fn z(found: Mean, tolerance: f64) -> f64 {
    (found.mean - 1.0) / error(found, tolerance)
}

/// Albedos of lossless surfaces by quadrature, and a sentence about the one with the largest error.
fn tables() -> (Vec<Statement>, Option<String>) {
    const ROUGHNESSES: [f64; 4] = [0.1, 0.3, 0.6, 1.0];
    let cases: Vec<(&str, f64)> = ["perfect metal", "white plastic", "rough glass from outside", "rough glass from inside"]
        .into_iter()
        .flat_map(|kind| ROUGHNESSES.map(|roughness| (kind, roughness)))
        .collect();
    let found: Vec<(f64, f64)> = cases.par_iter().map(|(kind, roughness)| farthest_albedo(kind, *roughness)).collect();
    let row = |((kind, roughness), (gain, mu)): (&(&str, f64), &(f64, f64))| {
        let what = format!("{kind}, roughness {roughness}: largest |albedo − 1| by quadrature, at cos θ = {mu}");
        Statement::below(what, gain.abs(), TABLES / 2.0)
    };
    let worst = cases.iter().zip(&found).max_by(|a, b| a.1.0.abs().total_cmp(&b.1.0.abs()));
    let remark = worst.map(|((kind, roughness), (gain, mu))| {
        format!("By quadrature, tables are farthest off for {kind} of roughness {roughness}, seen at cos θ = {mu}: by {gain:+.1e} of the light.")
    });
    (cases.iter().zip(&found).map(row).collect(), remark)
}

/// The largest error of the albedo over all angles, and its cosine.
fn farthest_albedo(kind: &str, roughness: f64) -> (f64, f64) {
    let alpha = (roughness * roughness) as f32;
    let front = !kind.ends_with("inside");
    let material = match kind {
        "perfect metal" => Conductor::new(Reflectance::Constant(Textured::grey(1.0)), alpha, true).into(),
        "white plastic" => Plastic::new([1.0; 3], 1.5, alpha).into(),
        _ => Dielectric::new(1.5, alpha, true).into(),
    };
    let materials = Materials::new(&[material]);
    let at = Local { material: U(0), colour: V::splat(One, [1.0; 3]), alpha: F(alpha), front: M(front) };
    let of = |mu: f64| match kind {
        "perfect metal" => albedo(&Conductor::at(One, &materials, Directions::Bsdf, &at), alpha, mu, None),
        "white plastic" => albedo(&Plastic::at(One, &materials, Directions::Bsdf, &at), alpha, mu, None),
        _ => albedo(
            &RoughDielectric::at(One, &materials, Directions::Bsdf, &at),
            alpha,
            mu,
            Some(if front { 1.5 } else { 1.0 / 1.5 }),
        ),
    };
    let gains = [1.0, 0.8, 0.6, 0.4, 0.2, 0.1].map(|mu| (of(mu) - 1.0, mu));
    gains.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).unwrap_or_default()
}

/// ∫ f |cos θ_i| dω_i, without the change of radiance by refraction.
fn albedo(bsdf: &impl Bsdf<One>, alpha: f32, mu: f64, eta: Option<f64>) -> f64 {
    const STEPS: usize = 40;
    let wo = direction(mu, 0.6);
    let side = |grid: usize, w: DVec3| (w.z < 0.0) == (grid == 1);
    let reflected = |w: DVec3| {
        let scale = if w.z < 0.0 { eta.unwrap_or(0.0).powi(2) } else { 1.0 };
        f64::from(bsdf.eval(lanes(wo), lanes(w)).0.x.0) * scale
    };
    let grids = Cells::of_lobes(wo, f64::from(alpha).clamp(0.04, 0.6), eta, STEPS);
    let of =
        |(i, grid): (usize, &Cells)| -> f64 { grid.integrals(&|w| if side(i, w) { reflected(w) } else { 0.0 }).iter().sum() };
    grids.iter().enumerate().map(of).sum()
}

/// Means over rings of pixels that see the ball at about the same angle, with the cosine of that angle.
fn rings(found: &Picture) -> Vec<(f64, Mean)> {
    const RINGS: usize = 12;
    let mut rings = vec![Vec::new(); RINGS];
    for (i, pixel) in found.pixels.iter().enumerate() {
        let place = |x: usize| (x as f64 + 0.5) / SIDE as f64 * 2.0 - 1.0;
        let square = place(i % SIDE).powi(2) + place(i / SIDE).powi(2);
        if square < 1.0 {
            let cos = (1.0 - square).sqrt();
            rings[((cos * RINGS as f64) as usize).min(RINGS - 1)].push((cos, *pixel));
        }
    }
    let ring = |pixels: Vec<(f64, Mean)>| {
        let cos = pixels.iter().map(|(cos, _)| cos).sum::<f64>() / pixels.len() as f64;
        (cos, Mean::of(pixels.into_iter().map(|(_, mean)| mean)))
    };
    rings.into_iter().filter(|pixels| !pixels.is_empty()).map(ring).collect()
}

fn reciprocity(validation: &Validation) -> Vec<Statement> {
    let alpha = 0.25;
    let gold = Reflectance::index([0.143, 0.374, 1.442], [3.983, 2.386, 1.603]);
    let materials = Materials::new(&[Conductor::new(gold, alpha, true).into(), Plastic::new([0.8, 0.3, 0.1], 1.5, alpha).into()]);
    let at =
        |material: u32| Local { material: U(material), colour: V::splat(One, [0.8, 0.3, 0.1]), alpha: F(alpha), front: M(true) };
    let count = validation.spp(20_000);
    vec![
        asymmetry("gold", (count, validation.random()), &Conductor::at(One, &materials, Directions::Bsdf, &at(0))),
        asymmetry("plastic", (count, validation.random()), &Plastic::at(One, &materials, Directions::Bsdf, &at(1))),
    ]
}

/// The largest relative change of f when its directions are exchanged.
fn asymmetry(name: &str, (count, random): (u32, Random), bsdf: &impl Bsdf<One>) -> Statement {
    let direction = |i: u32| Directions::Cosine.sample(random.direction(i).0);
    let worst = (0..count).map(|i| {
        let (a, b) = (direction(2 * i), direction(2 * i + 1));
        let f = |wo: V<One>, wi: V<One>| f64::from(bsdf.eval(wo, wi).0.x.0) / f64::from(wi.z.0);
        relative_difference(f(a, b), f(b, a))
    });
    Statement::below(format!("{name}: largest relative difference of f when directions are exchanged"), largest(worst), 2e-4)
}

/// The difference relative to the larger number; 0 if both are tiny.
fn relative_difference(a: f64, b: f64) -> f64 {
    // `min` and `max` ignore NaN.
    if (a + b).is_nan() {
        return f64::NAN;
    }
    if a.min(b) > 1e-12 { (a - b).abs() / a.max(b) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_parts_of_the_larger_number_and_nan_is_not_0() {
        assert_eq!([(3.0, 4.0), (4.0, 3.0), (0.0, 1e-13)].map(|(a, b)| relative_difference(a, b)), [0.25, 0.25, 0.0]);
        let nan = [(f64::NAN, f64::NAN), (f64::NAN, 1.0), (0.0, f64::NAN)].map(|(a, b)| relative_difference(a, b));
        assert!(nan.iter().all(|x| x.is_nan()) && largest([0.1, nan[0], 0.2]).is_nan(), "{nan:?}");
    }

    /// A point of the unit ball at the distance r from the axis has the height √(1 − r²), which is the cosine.
    #[test]
    fn rings_have_the_mean_cosine_of_their_pixels() {
        let place = |x: usize| (2.0 * x as f64 + 1.0) / SIDE as f64 - 1.0;
        let height = |i: usize| (1.0 - place(i % SIDE).powi(2) - place(i / SIDE).powi(2)).max(0.0).sqrt();
        let pixels = (0..SIDE * SIDE).map(|i| Mean { mean: height(i), variance_of_mean: 0.0 }).collect();
        let rings = rings(&Picture::new(SIDE, pixels));
        assert!(rings.len() > 6);
        for (cos, found) in rings {
            assert!((found.mean - cos).abs() < 1e-9, "{cos}: {}", found.mean);
        }
    }
}
