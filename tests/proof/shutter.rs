//! The shutter: moving objects are visible at the times when it is open, and at no others.
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{features, replay};
use noisefall_scene::scene::{Estimator, RenderSettings, Reuse, Scene};

use crate::picture::{RED, assert_all_within, picture, scene, settings};

/// Opening and closing times, and the expected value.
const SHUTTERS: [[f64; 2]; 6] = [[0.0, 1.0], [0.25, 0.75], [0.5, 0.6], [-1.0, 0.5], [0.5, 3.0], [-2.0, 4.0]];

/// The mean of a function of time over the interval in which the shutter is open.
fn mean_over([open, close]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 4000;
    let time = |i: u32| (open + (close - open) * (f64::from(i) + 0.5) / f64::from(STEPS)).clamp(0.0, 1.0);
    (0..STEPS).map(|i| of(time(i))).sum::<f64>() / f64::from(STEPS)
}

const WIDTH: usize = 32;

/// An edge that moves from x = 0 to 0.5 at constant speed, or a camera with the same effect, in an image from −0.5 to 0.5.
fn edge(what: &str, [open, close]: [f64; 2]) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0, 0, 2], look_at = [0, 0, 0], projection.orthographic.width = 1.0, resolution = [{WIDTH}, 8], \
         shutter = [{open:?}, {close:?}]{} }}
        [[objects]]
        shape.rectangle = {{ origin = [-3, -3, 0], edge_u = [3, 0, 0], edge_v = [0, 6, 0] }}
        emission.radiance = 1.0{}",
        if what == "camera" { ", motion = [{ translate = [-0.5, 0, 0] }]" } else { "" },
        if what == "object" { "\nmotion = [{ translate = [0.5, 0, 0] }]" } else { "" },
    ))
}

/// The fraction of column `i` that the edge covers when it is at `x`.
fn covered(i: usize, x: f64) -> f64 {
    ((x + 0.5) * WIDTH as f64 - i as f64).clamp(0.0, 1.0)
}

#[test]
fn an_edge_covers_the_pixels_that_it_passes_while_the_shutter_is_open() {
    for what in ["object", "camera"] {
        for shutter in SHUTTERS {
            let found = picture(&edge(what, shutter), settings(Estimator::Path), RED, 1024);
            let expected = |i: usize| mean_over(shutter, |time| covered(i % WIDTH, 0.5 * time));
            let deviations: Vec<f64> = found.pixels.iter().enumerate().map(|(i, pixel)| pixel.z(expected(i))).collect();
            assert_all_within(&deviations, &format!("a moving {what}, shutter {shutter:?}"));
        }
    }
}

#[test]
fn a_shutter_that_closes_at_once_shows_one_pose() {
    // Columns are 1/32 wide: the edge lies between two of them.
    for what in ["object", "camera"] {
        for (shutter, x) in [([0.5, 0.5], 0.25), ([0.0, 0.0], 0.0), ([-3.0, -1.0], 0.0), ([1.0, 1.0], 0.5), ([1.0, 9.0], 0.5)] {
            let found = picture(&edge(what, shutter), settings(Estimator::Path), RED, 4);
            for (i, pixel) in found.pixels.iter().enumerate() {
                let column = i % WIDTH;
                assert_eq!(pixel.mean, covered(column, x), "a {what}, {shutter:?}, column {column}");
            }
        }
    }
}

#[test]
fn a_short_time_is_nearly_sharp() {
    let found = picture(&edge("object", [0.0, 0.0001]), settings(Estimator::Path), RED, 256);
    for (i, pixel) in found.pixels.iter().enumerate() {
        // The edge starts at 0 and reaches 5 · 10⁻⁵, which is 0.0016 of a column.
        let expected = if i % WIDTH < WIDTH / 2 { 1.0 } else { 0.0 };
        assert!((pixel.mean - expected).abs() < 0.05, "column {}: {}", i % WIDTH, pixel.mean);
    }
}

#[test]
fn moving_lights_light_by_where_they_are_while_it_is_open() {
    // A spherical light above the horizon: E = π L (r/d)² cos θ. It moves along x from −1 to 2, two metres above.
    let irradiance = |time: f64| {
        let x = 3.0 * time - 1.0;
        let d2 = x * x + 4.0;
        std::f64::consts::PI * 50.0 * 0.01 / d2 * 2.0 / d2.sqrt()
    };
    for shutter in SHUTTERS.into_iter().chain([[0.75, 0.75]]) {
        let [open, close] = shutter;
        let expected = 0.5 / std::f64::consts::PI * mean_over(shutter, irradiance);
        for estimator in [Estimator::Path, Estimator::Light, Estimator::Mis] {
            let scene = scene(&format!(
                "camera = {{ eye = [0, 1, 3], look_at = [0, 0, 0], projection.orthographic.width = 1e-3, resolution = [16, 16], \
                 shutter = [{open:?}, {close:?}] }}
                materials.floor.lambertian.albedo = 0.5
                [[objects]]
                shape.disk = {{ center = [0, 0, 0], normal = [0, 1, 0], radius = 1.0 }}
                material = 'floor'
                [[objects]]
                shape.sphere = {{ center = [-1, 2, 0], radius = 0.1 }}
                emission.radiance = 50.0
                motion = [{{ translate = [3, 0, 0] }}]"
            ));
            let spp = if estimator == Estimator::Path { 4096 } else { 128 };
            let z = picture(&scene, settings(estimator), RED, spp).whole().z(expected);
            assert_all_within(&[z], &format!("{}, {shutter:?}", estimator.name()));
        }
    }
}

/// Moving objects of every kind, including a light and the camera, frozen halfway or static at the same pose. There is one light,
/// because a moving light among several is chosen by all its positions.
fn halfway(frozen: bool) -> Scene {
    let object = |shape: &str, place: &str, rest: &str| {
        let way = match frozen {
            true => "motion = [{ rotate = { axis = [0, 1, 0], degrees = 60 } }, { translate = [0.4, 0.2, 0] }]",
            false => "",
        };
        let there = if frozen { "" } else { ", { rotate = { axis = [0, 1, 0], degrees = 30 } }, { translate = [0.2, 0.1, 0] }" };
        format!("[[objects]]\nshape.{shape}\ntransform = [{place}{there}]\n{way}\n{rest}\n")
    };
    let camera = match frozen {
        true => "eye = [0, 1.5, 5], look_at = [0, 0.5, 0], shutter = [0.5, 0.5], motion = [{ translate = [0.2, -0.4, 0.6] }]",
        false => "eye = [0.1, 1.3, 5.3], look_at = [0.1, 0.3, 0.3]",
    };
    let round = "isosurface = { expression = 'x^2 + y^2 + z^2 - 0.2', bounds = { min = [-1, -1, -1], max = [1, 1, 1] } }";
    let mesh = "mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }";
    scene(&format!(
        "camera = {{ {camera}, fov = 45.0, resolution = [32, 24] }}
        materials.white.lambertian.albedo = 0.7
        materials.red.lambertian.albedo = [0.7, 0.2, 0.2]
        [[objects]]
        shape.rectangle = {{ origin = [-5, 0, 5], edge_u = [10, 0, 0], edge_v = [0, 0, -10] }}
        material = 'white'
        {}{}{}{}",
        object("cuboid = { min = [-1.2, 0, -0.5], max = [-0.4, 0.9, 0.3] }", "{ scale = 1 }", "material = 'red'"),
        object(round, "{ translate = [0.7, 0.6, 0.4] }", "material = 'white'"),
        object(mesh, "{ translate = [-0.2, 0.3, 0.8] }", "material = 'red'"),
        object("sphere = { center = [0.3, 2.2, 0.8], radius = 0.3 }", "{ scale = 1 }", "emission.radiance = 9.0"),
    ))
}

#[test]
fn a_frozen_scene_equals_the_static_one() {
    let (frozen, standing) = (halfway(true), halfway(false));
    for (estimator, reuse) in [
        (Estimator::Path, Reuse::Off),
        (Estimator::Light, Reuse::Off),
        (Estimator::Mis, Reuse::Off),
        (Estimator::Mis, Reuse::Suffixes),
    ] {
        let settings = RenderSettings { reuse, ..settings(estimator) };
        // Directions towards moving lights are sampled in their own space, so the samples differ.
        let [a, b] = [&frozen, &standing].map(|scene| picture(scene, settings, RED, 256));
        let deviations: Vec<f64> = a.pixels.iter().zip(&b.pixels).map(|(a, b)| a.z_from(*b)).collect();
        assert_all_within(&deviations, &format!("{}, {reuse:?}", estimator.name()));
    }
}

#[test]
fn features_and_replays_show_the_frozen_pose() {
    let scenes = [halfway(true), halfway(false)];
    let [frozen, standing] =
        [0, 1].map(|i| features(SimdLevel::best(), &scenes[i], &scenes[i].camera, &|| false).expect("nobody interrupts"));
    let close = |a: &[f32; 3], b: &[f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
    let same = |i: usize| {
        let (a, b) = (frozen.depth[i], standing.depth[i]);
        (a == b || (a - b).abs() < 1e-4 * b)
            && frozen.object[i] == standing.object[i]
            && close(&frozen.normal[i], &standing.normal[i])
    };
    let differ = (0..frozen.depth.len()).filter(|i| !same(*i)).count();
    assert!(differ * 100 < frozen.depth.len(), "{differ} pixels differ");
    let settings = settings(Estimator::Mis);
    let mut compared = 0;
    for pixel in (0..32).flat_map(|x| (0..24).map(move |y| [x, y])).step_by(17) {
        let [a, b] = [0, 1].map(|i| {
            let rays = scenes[i].rays(&scenes[i].camera);
            replay(&scenes[i], &rays, &settings, pixel, 3).vertices[0].distance
        });
        let same = match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() < 1e-4 * b,
            (a, b) => a == b,
        };
        compared += usize::from(same);
    }
    assert!(compared >= 44, "{compared} of 46 are the same");
}

#[test]
fn a_sequence_of_features_opens_where_the_shutter_opens() {
    // Features of blurred images show the first pose.
    let (open, frozen) = (edge("object", [0.5, 1.0]), edge("object", [0.5, 0.5]));
    let depth = |scene: &Scene| features(SimdLevel::best(), scene, &scene.camera, &|| false).expect("nobody interrupts").depth;
    assert_eq!(depth(&open), depth(&frozen));
    assert_eq!(depth(&open).iter().filter(|depth| depth.is_finite()).count(), 8 * 3 * WIDTH / 4);
}

#[test]
fn the_medium_around_the_eye_depends_on_time() {
    // A ball that tints without refraction. Halfway, the eye is at its centre, because the camera or the ball has moved there.
    for (what, shutter, expected) in
        [("ball", [0.5, 0.5], 0.25), ("ball", [0.0, 0.0], 1.0), ("eye", [0.5, 0.5], 0.25), ("eye", [0.0, 0.0], 1.0)]
    {
        let [open, close] = shutter;
        let (eye, ball) = match what {
            "ball" => ("", "motion = [{ translate = [0, 20, 0] }]"),
            _ => ("motion = [{ translate = [0, -20, 0] }],", ""),
        };
        let scene = scene(&format!(
            "camera = {{ eye = [0, 10, 0], look_at = [0, 10, -1], {eye} fov = 40.0, resolution = [8, 8], shutter = [{open:?}, {close:?}] }}
            environment.radiance = 1.0
            materials.tint.dielectric = {{ ior = 1.0, transmittance = 0.25 }}
            [[objects]]
            shape.sphere = {{ center = [0, 0, 0], radius = 1.0 }}
            material = 'tint'
            {ball}"
        ));
        let found = picture(&scene, settings(Estimator::Path), RED, 4);
        let off = found.pixels.iter().map(|pixel| (pixel.mean - expected).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5, "{what}, {shutter:?}: {off} off {expected}");
    }
}
