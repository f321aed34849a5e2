//! Cosine against uniform directions.
use crate::validate::{Section, Statement, Validation, check};
use noisefall_scene::{
    sampling::Directions,
    scene::{RenderSettings, Scene},
};

const ALBEDO: f64 = 0.8;
/// Sines of the angle between the zenith and the edge of the light; 1 is the whole sky.
const LIGHTS: [f64; 4] = [0.3, 0.6, 0.9, 1.0];

/// A floor under a sphere of radiance 1, or under a sky. The camera sees so small a part of the floor that all pixels are equal.
pub fn ground(sine: f64) -> Scene {
    let light = if sine < 1.0 {
        format!("[[objects]]\nshape.sphere = {{ center = [0.0, 1.0, 0.0], radius = {sine:?} }}\nemission.radiance = 1.0")
    } else {
        "[environment]\nradiance = 1.0".to_owned()
    };
    check::scene(&format!(
        "camera = {{ eye = [0.0, 0.04, 1.0], look_at = [0.0, 0.0, 0.0], fov = 0.001, resolution = [32, 32] }}
        materials.ground.lambertian.albedo = {ALBEDO}
        [[objects]]
        shape.disk = {{ center = [0.0, 0.0, 0.0], normal = [0.0, 1.0, 0.0], radius = 100.0 }}
        material = 'ground'
        {light}"
    ))
}

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    for sine in LIGHTS {
        let scene = ground(sine);
        let cos = (1.0 - sine * sine).sqrt();
        let mean = ALBEDO * sine * sine;
        // Mean squares of the samples by uniform and cosine directions.
        let squares = [ALBEDO * ALBEDO * sine * sine, 4.0 / 3.0 * ALBEDO * ALBEDO * (1.0 - cos.powi(3))];
        let mut found = Vec::new();
        for (directions, square) in [Directions::Cosine, Directions::Uniform].into_iter().zip(squares) {
            let settings = RenderSettings { max_bounces: Some(1), ..validation.path(directions) };
            let moments = validation.moments(&scene, settings, 1200);
            let name = format!("light to {:.1}°, {directions:?} directions", sine.asin().to_degrees()).to_lowercase();
            let variance = square - mean * mean;
            if variance < 1e-9 {
                statements.push(Statement::within(format!("{name}: mean"), moments.mean, mean, 1e-6));
                statements.push(Statement::within(format!("{name}: variance"), moments.variance, 0.0, 1e-10).of_the_same());
            } else {
                statements.push(Statement::mean_with(format!("{name}: mean"), &moments, mean, variance));
                statements.push(Statement::variance(format!("{name}: variance"), &moments, variance).of_the_same());
            }
            found.push((moments, variance));
        }
        if let [(cosine, exact_cosine), (uniform, exact_uniform)] = &found[..]
            && *exact_cosine > 1e-9
        {
            let ratio = uniform.variance / cosine.variance;
            let relative = |m: &noisefall_kernel::measure::Moments| (m.fourth / (m.variance * m.variance) - 1.0) / m.count;
            let error = ratio * (relative(cosine) + relative(uniform)).sqrt();
            let what = format!("light to {:.1}°: variance of uniform over that of cosine directions", sine.asin().to_degrees());
            statements.push(Statement::z(what, ratio, error, exact_uniform / exact_cosine).of_the_same());
        }
    }
    Section {
        title: "Cosine against uniform directions",
        claim: "Both give the same mean; the ratio of their variances is known exactly.",
        derivation: &[
            "Ground of albedo ρ lies under a light of radiance 1 that fills the sky from the zenith to the angle α. It reflects L = (ρ/π) ∫ cos θ dω = ρ sin²α. Here ρ = 0.8 and sin α = 0.3, 0.6, 0.9 and 1.",
            "Cosine directions, p = cos θ/π, have the samples f cos θ/p = ρ inside the light and 0 outside: E X² = ρ² sin²α. Uniform \
             directions, p = 1/(2π), have 2ρ cos θ inside: E X² = 4ρ² ∫ μ² dμ from cos α to 1 = (4/3) ρ² (1 − cos³α).",
            "Under a whole sky the first variance is 0 and the second ρ²/3. For a small light overhead the ratio tends to 2: there cosine sampling has twice the density.",
        ],
        source: "Both densities over the hemisphere integrate to 1; the section on sampled directions tests them.",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}
