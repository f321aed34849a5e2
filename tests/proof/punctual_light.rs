//! Light from a spherical light, above or partly below the horizon, on diffuse ground: ρ E/π with E in closed form.
use std::f64::consts::PI;

use noisefall_kernel::measure::exact::horizon_sphere_irradiance;
use noisefall_scene::scene::{Estimator, RenderSettings, Scene};

use crate::{
    picture::{Mean, RED, WITH_CAMERA_PATHS, picture, scene, settings},
    statistics::assert_within,
};

const LIGHT: f64 = 0.3;
const DISTANCE: f64 = 1.0;
const RADIANCE: f64 = 7.0;
const ALBEDO: f64 = 0.8;

fn irradiance(cos: f64) -> f64 {
    horizon_sphere_irradiance(RADIANCE, LIGHT, DISTANCE, cos)
}

/// Integrates the irradiance over the light's cone. On the circle at the angle ρ from its axis the cosine with the normal is
/// A + B cos φ, A = cos θ cos ρ, B = sin θ sin ρ; its positive part adds up to 2 (A φ₀ + B sin φ₀) with φ₀ = acos(−A/B).
fn irradiance_by_integration(cos: f64) -> f64 {
    const STEPS: u32 = 200_000;
    let sin = (1.0 - cos * cos).sqrt();
    let width = (LIGHT / DISTANCE).asin() / f64::from(STEPS);
    let circle = |i: u32| {
        let rho = (f64::from(i) + 0.5) * width;
        let (a, b) = (cos * rho.cos(), sin * rho.sin());
        let phi = if b > 0.0 { (-a / b).clamp(-1.0, 1.0).acos() } else { PI };
        2.0 * (a * phi + b * phi.sin()) * rho.sin()
    };
    RADIANCE * width * (0..STEPS).map(circle).sum::<f64>()
}

/// Zenith angles above the horizon, partly below it, and just before the light sets at 90° + 17.46°.
const DEGREES: [f64; 10] = [0.0, 30.0, 60.0, 72.0, 75.0, 80.0, 90.0, 95.0, 100.0, 104.0];

#[test]
fn the_closed_form_is_the_integral_over_the_visible_part_of_the_light() {
    for degrees in DEGREES.into_iter().chain([72.54, 72.55, 107.0]) {
        let cos = degrees.to_radians().cos();
        let (closed, integral) = (irradiance(cos), irradiance_by_integration(cos));
        assert!((closed - integral).abs() < 1e-6 * RADIANCE, "{degrees}°: {closed} and {integral}");
    }
}

/// A diffuse sphere below the origin. The camera sees so small a part of it that all pixels are equal.
fn lit_point(radius: f64, fov: f64, degrees: f64) -> Scene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [x, y] = [DISTANCE * sin, DISTANCE * cos];
    scene(&format!(
        "camera = {{ eye = [0.0, 1.0, 2.0], look_at = [0.0, 0.0, 0.0], fov = {fov}, resolution = [32, 32] }}
        materials.ground.lambertian.albedo = {ALBEDO}
        [[objects]]
        shape.sphere = {{ center = [0.0, {}, 0.0], radius = {radius:?} }}
        material = 'ground'
        [[objects]]
        shape.sphere = {{ center = [{x:?}, {y:?}, 0.0], radius = {LIGHT} }}
        emission.radiance = {RADIANCE:?}",
        -radius
    ))
}

fn z_of_radiance(scene: &Scene, estimator: Estimator, cos: f64, spp: u32) -> (f64, Mean) {
    let settings = RenderSettings { max_bounces: Some(1), ..settings(estimator) };
    let found = picture(scene, settings, RED, spp).whole();
    (found.z(ALBEDO / PI * irradiance(cos)), found)
}

#[test]
fn ground_and_a_small_ball_are_as_bright_as_the_light_above_the_horizon_makes_them() {
    for (what, radius, fov) in [("ground", 1e5, 0.01), ("ball", 0.01, 0.001)] {
        for degrees in DEGREES {
            let scene = lit_point(radius, fov, degrees);
            for estimator in WITH_CAMERA_PATHS {
                let (z, found) = z_of_radiance(&scene, estimator, degrees.to_radians().cos(), 256);
                println!(
                    "{what}, {degrees}°, {}: {:.6} ± {:.1e}, {z:.2} σ",
                    estimator.name(),
                    found.mean,
                    found.variance_of_mean.sqrt()
                );
                assert_within(z, &format!("{what}, light at {degrees}°, {}", estimator.name()));
            }
        }
    }
}

#[test]
fn a_light_that_has_set_lights_nothing() {
    for (radius, fov) in [(1e5, 0.01), (0.01, 0.001)] {
        for estimator in Estimator::ALL {
            let found =
                picture(&lit_point(radius, fov, 108.0), RenderSettings { max_bounces: Some(1), ..settings(estimator) }, RED, 64);
            assert!(found.pixels.iter().all(|pixel| pixel.mean == 0.0), "{}", estimator.name());
        }
    }
}
