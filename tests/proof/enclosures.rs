//! Closed shapes other than spheres: furnaces, darkness, invisible glass, and the view from inside.
use noisefall_kernel::measure::exact::furnace;
use noisefall_scene::{
    sampling::Directions,
    scene::{Estimator, RenderSettings, Roulette, Scene},
};

use crate::{
    picture::{Mean, RED, assert_all_within, picture, scene, settings},
    statistics::assert_within,
};

/// Closed shapes around the origin, at least half a metre away from it.
const CLOSED: [(&str, &str); 6] = [
    ("cuboid", "shape.cuboid = { min = [-1.0, -0.7, -1.5], max = [0.8, 0.6, 1.2] }"),
    (
        "sheared cuboid",
        "shape.cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }
        transform = [{ matrix = [[1.0, 0.4, 0.0, 0.1], [0.0, 0.8, 0.3, 0.0], [0.2, 0.0, 1.1, -0.1], [0.0, 0.0, 0.0, 1.0]] }]",
    ),
    (
        "mirrored cuboid",
        "shape.cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }
        transform = [{ rotate = { axis = [1.0, 2.0, 3.0], degrees = 40.0 } }, { scale = [1.0, -0.8, 1.3] }]",
    ),
    ("capped cylinder", "shape.cylinder = { base = [0.1, -0.9, 0.0], top = [0.0, 0.8, 0.2], radius = 0.9 }"),
    (
        "stretched cylinder",
        "shape.cylinder = { base = [0.0, -1.0, 0.0], top = [0.0, 1.0, 0.0], radius = 1.0 }
        transform = [{ rotate = { axis = [1.0, 0.5, 0.0], degrees = 50.0 } }, { scale = [0.7, 1.0, 1.4] }]",
    ),
    (
        "ellipsoid",
        "shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }
        transform = [{ scale = [0.6, 1.0, 1.7] }, { rotate = { axis = [1.0, 2.0, -1.0], degrees = 60.0 } }]",
    ),
];

const INSIDE: &str = "eye = [0.1, -0.05, 0.2], look_at = [0.6, 0.3, -0.2], fov = 90.0, resolution = [32, 32]";
const OUTSIDE: &str = "eye = [1.5, 2.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 45.0, resolution = [32, 32]";

/// A camera at the centre that looks at the centre of a wall.
const AWAY_FROM_CORNERS: &str = "eye = [0.0, 0.0, 0.0], look_at = [0.3, 0.2, -1.0], fov = 10.0, resolution = [32, 32]";

const LE: f64 = 1.0;
const ALBEDO: f64 = 0.6;

fn glowing(camera: &str, shape: &str) -> Scene {
    scene(&format!(
        "camera = {{ {camera} }}
        materials.wall.lambertian.albedo = {ALBEDO}
        [[objects]]
        {shape}
        material = 'wall'
        flip = true
        emission.radiance = {LE:?}"
    ))
}

fn exactly(found: &[Mean], expected: f64) -> bool {
    let is_it = |pixel: &Mean| (pixel.mean - expected).abs() < 1e-5 * expected && pixel.variance_of_mean.sqrt() < 1e-5 * expected;
    found.iter().all(is_it)
}

#[test]
fn a_closed_room_of_any_shape_is_a_furnace() {
    for (what, shape) in CLOSED {
        let room = glowing(INSIDE, shape);
        // With the path estimator every sample is the series itself.
        let still = RenderSettings { roulette: Roulette::Off, ..settings(Estimator::Path) };
        assert!(exactly(&picture(&room, still, RED, 16).pixels, furnace(LE, ALBEDO)), "{what}");
        for directions in [Directions::Uniform, Directions::Cosine] {
            // Light samples alone have infinite variance in corners, where walls come arbitrarily close to each other.
            for estimator in [Estimator::Path, Estimator::Mis] {
                let found = picture(&room, RenderSettings { directions, ..settings(estimator) }, RED, 36);
                let what = format!("{what}, {}, {directions:?}", estimator.name());
                println!("{what}: {:.2} σ", found.whole().z(furnace(LE, ALBEDO)));
                assert_within(found.whole().z(furnace(LE, ALBEDO)), &what);
                let deviations: Vec<f64> = found.blocks(8).into_iter().map(|block| block.z(furnace(LE, ALBEDO))).collect();
                assert_all_within(&deviations, &format!("{what}, by blocks"));
            }
        }
    }
}

#[test]
fn away_from_corners_light_samples_alone_find_one_reflection() {
    for (what, shape) in CLOSED {
        let room = glowing(AWAY_FROM_CORNERS, shape);
        for estimator in Estimator::ALL {
            let found = picture(&room, RenderSettings { max_bounces: Some(1), ..settings(estimator) }, RED, 256).whole();
            let what = format!("{what}, {}", estimator.name());
            println!("{what}: {:.6} ± {:.1e}", found.mean, found.variance_of_mean.sqrt());
            assert_within(found.z(LE * (1.0 + ALBEDO)), &what);
        }
    }
}

#[test]
fn no_light_passes_a_closed_shape() {
    const LIGHT_INSIDE: &str = "shape.sphere = { center = [0.1, 0.0, 0.1], radius = 0.1 }";
    const LIGHT_OUTSIDE: &str = "shape.sphere = { center = [0.0, 3.5, 1.0], radius = 1.0 }";
    // Its triangles are numbered as lights, and must not be taken for walls with the same number.
    const MESH_INSIDE: &str = "shape.mesh.knot.triangles = 200\ntransform = [{ scale = 0.05 }]";
    const MESH_OUTSIDE: &str = "shape.mesh.knot.triangles = 200\ntransform = [{ scale = 0.3 }, { translate = [0.0, 3.5, 1.0] }]";
    for (what, shape) in CLOSED {
        let punctual_lights = [
            (INSIDE, LIGHT_OUTSIDE, 1.0),
            (OUTSIDE, LIGHT_INSIDE, 0.0),
            (INSIDE, MESH_OUTSIDE, 1.0),
            (OUTSIDE, MESH_INSIDE, 0.0),
        ];
        for (camera, punctual_light, sky) in punctual_lights {
            let scene = scene(&format!(
                "camera = {{ {camera} }}
                environment.radiance = {sky:?}
                materials.wall.lambertian.albedo = 0.9
                [[objects]]
                {shape}
                material = 'wall'
                [[objects]]
                {punctual_light}
                emission.radiance = 100.0"
            ));
            for estimator in Estimator::ALL {
                let found = picture(&scene, settings(estimator), RED, 64);
                let lit = found.pixels.iter().filter(|pixel| pixel.mean > 0.0).count();
                println!("{what}, {}: {lit} lit", estimator.name());
                assert!(lit == 0, "{what}, {}: {lit} pixels are lit", estimator.name());
            }
        }
    }
}

fn glass(camera: &str, shape: &str, dielectric: &str) -> Scene {
    scene(&format!(
        "camera = {{ {camera} }}
        environment.radiance = 1.0
        materials.glass.dielectric = {{ {dielectric} }}
        [[objects]]
        {shape}
        material = 'glass'"
    ))
}

#[test]
fn clear_glass_of_any_shape_is_invisible() {
    for (what, shape) in CLOSED {
        for (camera, dielectrics) in [(OUTSIDE, &["ior = 1.5", "ior = 0.7", "ior = 1.0"][..]), (INSIDE, &["ior = 1.0"])] {
            for dielectric in dielectrics {
                for estimator in Estimator::ALL {
                    let still = RenderSettings { roulette: Roulette::Off, ..settings(estimator) };
                    let found = picture(&glass(camera, shape, dielectric), still, RED, 16);
                    assert!(exactly(&found.pixels, 1.0), "{what}, {dielectric}, {}", estimator.name());
                }
            }
        }
        let rough = glass(OUTSIDE, shape, "ior = 1.5, alpha = 0.3");
        for estimator in Estimator::ALL {
            let found = picture(&rough, settings(estimator), RED, 64).whole();
            println!("rough {what}, {}: {:.6} ± {:.1e}", estimator.name(), found.mean, found.variance_of_mean.sqrt());
            assert_within(found.z(1.0), &format!("rough {what}, {}", estimator.name()));
        }
    }
}

#[test]
fn from_inside_a_block_of_glass_the_world_is_seen_in_cones_and_nothing_beside_them() {
    // Reflections only change the signs of the components of a direction. If one of them exceeds cos θ_c = √(1 − 1/n²), the path
    // leaves in the end, with n² times the radiance outside. Otherwise it is totally reflected for ever.
    const IOR: f64 = 1.5;
    let block = "shape.cuboid = { min = [-1.0, -0.7, -1.5], max = [0.8, 0.6, 1.2] }";
    let look = |at: &str, fov: f64| format!("eye = [0.1, -0.05, 0.2], look_at = {at}, fov = {fov:?}, resolution = [32, 32]");
    for estimator in Estimator::ALL {
        let still = RenderSettings { roulette: Roulette::Off, ..settings(estimator) };
        for at in ["[0.1, -0.05, 9.0]", "[-9.0, -0.05, 0.2]", "[0.1, 9.0, 0.3]"] {
            let found = picture(&glass(&look(at, 56.0), block, "ior = 1.5"), still, RED, 16);
            assert!(exactly(&found.pixels, IOR * IOR), "towards {at}, {}", estimator.name());
        }
        let trapped = RenderSettings { max_bounces: Some(200), ..still };
        let found = picture(&glass(&look("[5.1, 4.95, 5.2]", 14.0), block, "ior = 1.5"), trapped, RED, 4);
        assert!(found.pixels.iter().all(|pixel| pixel.mean == 0.0), "{}", estimator.name());
    }
}

#[test]
fn the_middle_of_a_tinted_block_knows_where_it_is() {
    // n² (1 − R) √a Σₖ (R a)ᵏ, as in a ball: half a crossing to the surface, a whole one for every internal reflection.
    const IOR: f64 = 1.5;
    const TRANSMITTANCE: f64 = 0.3;
    let shapes = [
        "shape.cuboid = { min = [-2.0, -1.0, -0.5], max = [3.0, 1.0, 0.5] }",
        "shape.cylinder = { base = [0.3, 0.0, -0.5], top = [0.3, 0.0, 0.5], radius = 1.0 }",
        "shape.cylinder = { base = [0.0, -1.0, 0.0], top = [0.0, 1.0, 0.0], radius = 0.5 }",
        "shape.sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 }\ntransform = [{ scale = [2.0, 1.3, 1.0] }]",
    ];
    let camera = "eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], projection.orthographic.width = 1e-6, resolution = [32, 32]";
    let r = ((IOR - 1.0) / (IOR + 1.0)).powi(2);
    let exact = IOR * IOR * (1.0 - r) * TRANSMITTANCE.sqrt() / (1.0 - r * TRANSMITTANCE);
    for shape in shapes {
        let scene = glass(camera, shape, &format!("ior = {IOR:?}, transmittance = {TRANSMITTANCE:?}"));
        for estimator in Estimator::ALL {
            let found = picture(&scene, settings(estimator), RED, 64).whole();
            println!(
                "{shape}, {}: {:.6} ± {:.1e}, exact {exact:.6}",
                estimator.name(),
                found.mean,
                found.variance_of_mean.sqrt()
            );
            assert_within(found.z(exact), &format!("{shape}, {}", estimator.name()));
        }
    }
}
