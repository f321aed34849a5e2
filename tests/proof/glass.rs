//! Glass that absorbs nothing is invisible in a uniform field, whatever its shape, roughness or nesting: a path returns the
//! radiance 1 wherever it leaves (the furnace for interfaces; the factor η² that radiance gains on entering is lost on leaving).
//! Surfaces that reflect all light are invisible too.
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette, Scene};

use crate::{
    picture::{RED, assert_all_within, picture, scene, settings},
    statistics::assert_within,
};

/// A uniform field of radiance 1 around objects between −1 and 1 on every axis.
pub fn in_white_light(camera: &str, materials: &str, spheres: &[([f64; 3], f64, &str)]) -> Scene {
    let object = |(center, radius, material): &([f64; 3], f64, &str)| {
        format!("[[objects]]\nshape.sphere = {{ center = {center:?}, radius = {radius:?} }}\nmaterial = '{material}'\n")
    };
    let objects: String = spheres.iter().map(object).collect();
    scene(&format!("camera = {{ {camera}, resolution = [32, 32] }}\nenvironment.radiance = 1.0\n{materials}\n{objects}"))
}

const ALL_OF_IT: &str = "eye = [0.0, 0.5, 4.0], look_at = [0.0, 0.0, 0.0], fov = 30.0";
pub const O: [f64; 3] = [0.0; 3];

/// A ball; a bubble in a ball, the interface described from its inside; balls in balls, off centre, denser and thinner.
fn arrangements(roughness: &str) -> Vec<Scene> {
    let glass = format!(
        "materials.glass.dielectric = {{ ior = 1.5{roughness} }}
        materials.bubble.dielectric = {{ ior = 1.0, ior_outside = 1.5{roughness} }}
        materials.diamond.dielectric = {{ ior = 2.4, ior_outside = 1.5{roughness} }}
        materials.water.dielectric = {{ ior = 1.33, ior_outside = 2.4{roughness} }}"
    );
    let ball = (O, 1.0, "glass");
    vec![
        in_white_light(ALL_OF_IT, &glass, &[ball]),
        in_white_light(ALL_OF_IT, &glass, &[ball, (O, 0.7, "bubble")]),
        in_white_light(ALL_OF_IT, &glass, &[ball, ([0.1, -0.2, 0.1], 0.7, "diamond"), ([0.3, -0.2, 0.2], 0.4, "water")]),
    ]
}

#[test]
fn smooth_glass_is_invisible_in_every_single_sample() {
    for (i, scene) in arrangements("").iter().enumerate() {
        for estimator in Estimator::ALL {
            let found = picture(scene, RenderSettings { roulette: Roulette::Off, ..settings(estimator) }, RED, 16);
            for pixel in found.pixels {
                let is_one = (pixel.mean - 1.0).abs() < 1e-5 && pixel.variance_of_mean.sqrt() < 1e-5;
                assert!(is_one, "arrangement {i}, {}: {pixel:?}", estimator.name());
            }
        }
    }
}

#[test]
fn with_roulette_it_is_invisible_on_average() {
    for (i, scene) in arrangements("").iter().enumerate() {
        for roulette in [Roulette::BY_THROUGHPUT, Roulette::fixed(0.7)] {
            let found = picture(scene, RenderSettings { roulette, ..settings(Estimator::Mis) }, RED, 256);
            assert_within(found.whole().z(1.0), &format!("arrangement {i}, {roulette:?}"));
        }
    }
}

fn assert_invisible(scene: &Scene, what: &str, estimators: &[Estimator], spp: u32) {
    for estimator in estimators {
        let found = picture(scene, settings(*estimator), RED, spp);
        let what = format!("{what}, {}", estimator.name());
        let whole = found.whole();
        println!("{what}: {:.6} ± {:.1e}, {:.2} σ", whole.mean, whole.variance_of_mean.sqrt(), whole.z(1.0));
        assert_within(whole.z(1.0), &what);
        let deviations: Vec<f64> = found.blocks(16).into_iter().map(|block| block.z(1.0)).collect();
        assert_all_within(&deviations, &format!("{what}, by blocks"));
    }
}

/// Light samples alone hit a lobe of width α with one sample in 1/α². Below this α the mean of a few thousand samples is not
/// normally distributed, and the light estimator is not tested.
const LEAST_ALPHA_FOR_LIGHT: f64 = 0.2;

fn estimators(alpha: f64) -> &'static [Estimator] {
    if alpha < LEAST_ALPHA_FOR_LIGHT { &[Estimator::Path, Estimator::Mis] } else { &Estimator::ALL }
}

#[test]
fn rough_glass_is_invisible() {
    for alpha in [0.05, 0.3, 0.8] {
        for (i, scene) in arrangements(&format!(", alpha = {alpha}")).iter().enumerate() {
            assert_invisible(scene, &format!("alpha {alpha}, arrangement {i}"), estimators(alpha), 256);
        }
    }
}

#[test]
fn balls_that_reflect_all_light_are_invisible() {
    // With the α of rough lobes.
    let materials = [
        ("lambertian = { albedo = 1.0 }", None, 64),
        ("mirror = { reflectance = 1.0 }", None, 4),
        ("conductor = { reflectance = 1.0, alpha = 0.05 }", Some(0.05), 256),
        ("conductor = { reflectance = 1.0, alpha = 0.3 }", Some(0.3), 256),
        ("conductor = { reflectance = 1.0, alpha = 1.0 }", Some(1.0), 256),
        ("plastic = { albedo = 1.0, ior = 1.5 }", None, 256),
        ("plastic = { albedo = 1.0, ior = 1.5, alpha = 0.05 }", Some(0.05), 256),
        ("plastic = { albedo = 1.0, ior = 1.5, alpha = 0.5 }", Some(0.5), 256),
    ];
    for (material, alpha, spp) in materials {
        let spheres = [([-0.4, 0.0, 0.0], 0.6, "white"), ([0.5, 0.0, 0.3], 0.5, "white")];
        let scene = in_white_light(ALL_OF_IT, &format!("materials.white.{material}"), &spheres);
        assert_invisible(&scene, material, alpha.map_or(&Estimator::ALL, estimators), spp);
    }
}
