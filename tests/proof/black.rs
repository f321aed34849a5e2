//! Black surfaces: a coat, and the rise of Fresnel's reflectance, remain.
use noisefall_kernel::measure::exact::fresnel;
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette, Scene};

use crate::picture::{BLUE, Measure, RED, assert_all_within, picture, scene, settings};

/// A flat surface of this material, seen by parallel rays at the angle θ in a uniform field of radiance 1.
fn seen_at(material: &str, theta: f64) -> Scene {
    let [sin, cos] = [theta.sin(), theta.cos()].map(|x| 100.0 * x);
    scene(&format!(
        "camera = {{ eye = [{sin}, 0.0, {cos}], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 1.0, resolution = [8, 8] }}
        environment.radiance = 1.0
        textures.squares.checker = {{ even = 0.0, odd = 0.0, scale = 4.0 }}
        materials.m.{material}
        [[objects]]
        shape.disk = {{ center = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], radius = 1e3 }}
        material = 'm'"
    ))
}

fn assert_every_sample_is(expected: f64, scene: &Scene, what: &str) {
    for estimator in Estimator::ALL {
        let settings = RenderSettings { roulette: Roulette::Off, ..settings(estimator) };
        for pixel in picture(scene, settings, RED, 4).pixels {
            let is_exact = (pixel.mean - expected).abs() < 1e-5 && pixel.variance_of_mean < 1e-12;
            assert!(is_exact, "{what}, {}: {pixel:?} in place of {expected}", estimator.name());
        }
    }
}

const ANGLES: [f64; 5] = [0.0, 0.5, 1.0, 1.3, 1.5];

#[test]
fn the_coat_of_black_plastic_reflects_the_fresnel_fraction() {
    for theta in ANGLES {
        let (reflected, _) = fresnel(1.5, theta);
        for albedo in ["0.0", "{ texture = 'squares' }"] {
            let scene = seen_at(&format!("plastic = {{ albedo = {albedo}, ior = 1.5 }}"), theta);
            assert_every_sample_is(reflected, &scene, &format!("albedo {albedo} at {theta}"));
        }
    }
}

#[test]
fn a_smooth_metal_that_is_black_from_the_front_shines_at_grazing_angles() {
    for theta in ANGLES {
        let rise = (1.0 - theta.cos()).powi(5);
        for f0 in ["0.0", "{ texture = 'squares' }"] {
            assert_every_sample_is(
                rise,
                &seen_at(&format!("conductor = {{ f0 = {f0} }}"), theta),
                &format!("f0 {f0} at {theta}"),
            );
        }
    }
}

#[test]
fn black_surfaces_without_coat_or_rise_reflect_nothing() {
    for material in ["lambertian.albedo = 0.0", "mirror.reflectance = 0.0", "conductor = { reflectance = 0.0, alpha = 0.3 }"] {
        assert_every_sample_is(0.0, &seen_at(material, 1.0), material);
    }
}

/// Black in red and of full albedo in blue. The coat reflects the same light in both.
const HALF_BLACK: [(&str, &str); 2] = [
    ("plastic = { albedo = [0.0, 0.0, 0.3], ior = 1.5, alpha = 0.3 }", "plastic = { albedo = 0.0, ior = 1.5, alpha = 0.3 }"),
    ("conductor = { f0 = [0.0, 0.0, 0.3], alpha = 0.3 }", "conductor = { f0 = 0.0, alpha = 0.3 }"),
];

#[test]
fn a_channel_that_is_black_is_the_same_whether_the_others_are_or_not() {
    for (coloured, black) in HALF_BLACK {
        for theta in ANGLES {
            let of = |material: &str, estimator: Estimator, seed: u32, measure: Measure| {
                picture(&seen_at(material, theta), RenderSettings { seed, ..settings(estimator) }, measure, 1024).whole()
            };
            let deviations = Estimator::ALL.map(|estimator| of(black, estimator, 5, RED).z_from(of(coloured, estimator, 6, RED)));
            assert_all_within(&deviations, &format!("{black} at {theta}"));
            assert!(of(coloured, Estimator::Mis, 6, BLUE).mean > of(coloured, Estimator::Mis, 6, RED).mean);
        }
    }
}
