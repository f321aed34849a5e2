//! Meshes, isosurfaces and motion against exact solutions, and against the same shapes in other representations.
use noisefall_scene::scene::{Estimator, Scene};

use crate::{
    picture::{LUMINANCE, RED, assert_all_within, picture, scene, settings},
    statistics::assert_within,
};

const SPP: u32 = 256;

/// The corners and triangles of the cube [−1, 1]³, counter-clockwise from outside.
const CUBE: &str = "mesh = { vertices = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], \
    triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [3, 7, 6], [3, 6, 2], [0, 4, 7], [0, 7, 3], [1, 2, 6], [1, 6, 5]] }";
const CUBOID: &str = "cuboid = { min = [-1, -1, -1], max = [1, 1, 1] }";
const BALL: &str = "sphere = { center = [0, 0, 0], radius = 1.0 }";
const ROUND: &str =
    "isosurface = { expression = 'x^2 + y^2 + z^2 - 1', bounds = { min = [-1.1, -1.1, -1.1], max = [1.1, 1.1, 1.1] } }";

#[test]
fn a_furnace_of_triangles_is_a_furnace() {
    for (what, shape) in [("mesh", CUBE), ("isosurface", ROUND)] {
        for list in ["", "{ scale = [1.3, 0.8, 1.1] }, { rotate = { axis = [1, 2, 3], degrees = 40 } }"] {
            let scene = scene(&format!(
                "camera = {{ eye = [0.1, 0.0, 0.2], look_at = [1.0, 0.3, 0.0], fov = 90.0, resolution = [16, 16] }}
                materials.wall.lambertian.albedo = 0.5
                [[objects]]
                shape = {{ {shape} }}
                material = 'wall'
                transform = [{list}]
                emission.radiance = 1.0
                flip = true"
            ));
            for estimator in [Estimator::Path, Estimator::Mis] {
                let found = picture(&scene, settings(estimator), RED, SPP).whole();
                assert_within(found.z(2.0), &format!("{what}, {list}, {}: {}", estimator.name(), found.mean));
            }
        }
    }
}

/// A scene with a shape that reflects and one that emits.
fn lit(solid: &str, light: &str, motion: &str) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.0, 4.0, 5.0], look_at = [0.0, 0.3, 0.0], fov = 40.0, resolution = [32, 32], shutter = [0.0, 1.0] }}
        environment.radiance = [0.1, 0.1, 0.2]
        materials.white.lambertian.albedo = 0.7
        materials.metal.conductor = {{ reflectance = 0.8, roughness = 0.7 }}
        [[objects]]
        shape.rectangle = {{ origin = [-5, -1, 5], edge_u = [10, 0, 0], edge_v = [0, 0, -10] }}
        material = 'white'
        [[objects]]
        shape = {{ {solid} }}
        material = 'metal'
        transform = [{{ scale = [0.9, 0.6, 0.7] }}, {{ rotate = {{ axis = [0, 1, 0], degrees = 30 }} }}]
        motion = [{motion}]
        [[objects]]
        shape = {{ {light} }}
        emission.radiance = 4.0
        transform = [{{ scale = 0.6 }}, {{ translate = [1.0, 2.0, 1.0] }}]
        motion = [{motion}]"
    ))
}

/// Compares two equal scenes by blocks. Each estimator of one is compared with another estimator of the other, because an error
/// in an estimator would affect both scenes equally.
fn assert_same(a: &Scene, b: &Scene, what: &str) {
    let [of_a, of_b] = [a, b].map(|scene| {
        Estimator::ALL.map(|estimator| {
            let spp = if estimator == Estimator::Path { 4 * SPP } else { SPP };
            picture(scene, settings(estimator), LUMINANCE, spp).blocks(8)
        })
    });
    for (i, j) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
        let deviations: Vec<f64> = of_a[i].iter().zip(&of_b[j]).map(|(a, b)| a.z_from(*b)).collect();
        let [a, b] = [i, j].map(|estimator| Estimator::ALL[estimator].name());
        assert_all_within(&deviations, &format!("{what}, {a} and {b}"));
    }
}

#[test]
fn a_cube_of_triangles_is_a_cuboid() {
    assert_same(&lit(CUBE, CUBE, ""), &lit(CUBOID, CUBOID, ""), "a cube of triangles");
}

#[test]
fn an_isosurface_of_a_sphere_is_a_sphere() {
    assert_same(&lit(ROUND, ROUND, ""), &lit(BALL, BALL, ""), "x² + y² + z² = 1");
}

#[test]
fn a_motion_that_ends_where_it_begins_at_all_times_shows_nothing() {
    let turn = "{ rotate = { axis = [0, 1, 0], degrees = 0 } }, { translate = [0, 0, 0] }, { scale = 1 }";
    assert_same(&lit(CUBOID, BALL, turn), &lit(CUBOID, BALL, ""), "no motion");
}

#[test]
fn shapes_move_alike_whatever_they_are_made_of() {
    let motion =
        "{ rotate = { axis = [0, 1, 0.2], degrees = 50 } }, { translate = [0.6, 0.1, 0.0] }, { scale = [1.1, 0.9, 1.0] }";
    assert_same(&lit(CUBE, CUBE, motion), &lit(CUBOID, CUBOID, motion), "moving cubes");
    assert_same(&lit(ROUND, ROUND, motion), &lit(BALL, BALL, motion), "moving balls");
}

#[test]
fn a_moving_edge_covers_the_pixels_that_it_passes() {
    // An edge moves from x = 0 to 0.5 at constant speed, so a position x in between is covered for the fraction 1 − 2x of the
    // time.
    const WIDTH: usize = 32;
    let scene = |what: &str| {
        scene(&format!(
            "camera = {{ eye = [0, 0, 2], look_at = [0, 0, 0], projection.orthographic.width = 1.0, resolution = [{WIDTH}, 8], \
             shutter = [0.0, 1.0]{} }}
            [[objects]]
            shape.rectangle = {{ origin = [-3, -3, 0], edge_u = [3, 0, 0], edge_v = [0, 6, 0] }}
            emission.radiance = 1.0{}",
            if what == "camera" { ", motion = [{ translate = [-0.5, 0, 0] }]" } else { "" },
            if what == "object" { "\nmotion = [{ translate = [0.5, 0, 0] }]" } else { "" },
        ))
    };
    for what in ["object", "camera"] {
        let found = picture(&scene(what), settings(Estimator::Path), RED, 1024);
        let mut deviations = Vec::new();
        for (i, pixel) in found.pixels.iter().enumerate() {
            let [from, to] = [0.0, 1.0].map(|side| ((i % WIDTH) as f64 + side) / WIDTH as f64 - 0.5);
            // The integral of the covered fraction over the pixel.
            let covered = |x: f64| if x < 0.0 { x } else { x - x * x };
            deviations.push(pixel.z((covered(to) - covered(from)) / (to - from)));
        }
        assert_all_within(&deviations, &format!("a moving {what}"));
    }
}

#[test]
fn every_estimator_finds_the_light_of_a_light_that_moves() {
    const SIDE: usize = 8;
    // A ball rises from close above a white floor. Parallel rays look down beside it.
    let scene = scene(&format!(
        "camera = {{ eye = [2.5, 20, 0], look_at = [2.5, 0, 0], up = [0, 0, -1], projection.orthographic.width = 2.0, \
         resolution = [{SIDE}, {SIDE}], shutter = [0.0, 1.0] }}
        materials.white.lambertian.albedo = 1.0
        [[objects]]
        shape.disk = {{ center = [0, 0, 0], normal = [0, 1, 0], radius = 20 }}
        material = 'white'
        [[objects]]
        shape = {{ {BALL} }}
        emission.radiance = 1.0
        transform = [{{ translate = [0, 1.3, 0] }}]
        motion = [{{ translate = [0, 5, 0] }}]"
    ));
    // The mean over time and over the pixel of the exact radiance (r/d)² cos θ = h/d³.
    let exact = |pixel: usize| {
        const SUB: usize = 8;
        const STEPS: usize = 1000;
        let place = |pixel: usize, sub: usize| 2.0 * (pixel as f64 + (sub as f64 + 0.5) / SUB as f64) / SIDE as f64;
        let at = |i: usize| {
            let (sub, step) = (i / STEPS, i % STEPS);
            let [x, z] = [1.5 + place(pixel % SIDE, sub % SUB), place(pixel / SIDE, sub / SUB) - 1.0];
            let h = 1.3 + 5.0 * (step as f64 + 0.5) / STEPS as f64;
            h / (h * h + x * x + z * z).powf(1.5)
        };
        (0..SUB * SUB * STEPS).map(at).sum::<f64>() / (SUB * SUB * STEPS) as f64
    };
    for estimator in Estimator::ALL {
        let found = picture(&scene, settings(estimator), RED, 8192);
        let deviations: Vec<f64> = (0..SIDE * SIDE).map(|i| found.pixels[i].z(exact(i))).collect();
        assert_all_within(&deviations, &format!("a rising ball, {}", estimator.name()));
    }
}
