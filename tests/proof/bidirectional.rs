//! Replays of bidirectional paths: the terms add up to the renderer's sum bit for bit, and pdfs and weights are exact.
use std::f64::consts::{FRAC_1_PI, PI};

use glam::{DVec3, Vec3};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{
    Batch, BidirectionalSample, PathPoint, Replay, Splat, StrategyTerm, TILE, Work, pixel_samples, replay, trace,
};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Reuse, Scene};

use crate::picture::scene;

/// A closed room with walls of four kinds, so that many vertices are connected and their queues fill.
const ROOM: &str = r#"
[camera]
eye = [0.1, 0.0, 0.9]
look_at = [0.0, 0.0, -1.0]
fov = 90.0
resolution = [32, 32]
[materials]
white = { lambertian = { albedo = 0.9 } }
glossy = { conductor = { reflectance = 0.95, roughness = 0.5 } }
coated = { rough_plastic = { albedo = 0.9, ior = 1.5, roughness = 0.3 } }
clay = { principled = { base_color = 0.9, base_diffuse_roughness = 0.5 } }
[[objects]]
shape = { cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] } }
material = "white"
[[objects]]
shape = { sphere = { center = [0.5, -0.6, -0.4], radius = 0.35 } }
material = "glossy"
[[objects]]
shape = { sphere = { center = [-0.5, -0.6, -0.4], radius = 0.35 } }
material = "coated"
[[objects]]
shape = { sphere = { center = [0.0, 0.4, -0.6], radius = 0.35 } }
material = "clay"
[[objects]]
shape = { sphere = { center = [0.0, 0.8, 0.2], radius = 0.1 } }
emission = { radiance = 20.0 }
"#;

/// A ball that shines on a floor.
const BALL_AND_FLOOR: &str = r#"
[camera]
eye = [0.0, 2.0, 3.0]
look_at = [0.0, 0.0, 0.0]
fov = 40.0
resolution = [32, 32]
[materials]
white = { lambertian = { albedo = 0.5 } }
[[objects]]
shape = { rectangle = { origin = [-9.0, 0.0, 9.0], edge_u = [18.0, 0.0, 0.0], edge_v = [0.0, 0.0, -18.0] } }
material = "white"
[[objects]]
shape = { sphere = { center = [0.3, 1.0, 0.0], radius = 0.5 } }
emission = { radiance = 2.0 }
"#;
const CENTER: DVec3 = DVec3::new(0.3, 1.0, 0.0);
const RADIUS: f64 = 0.5;

fn settings(scene: &Scene, estimator: Estimator) -> RenderSettings {
    RenderSettings { estimator, reuse: Reuse::Off, adaptive: false, ..scene.settings }
}

/// The sum of what the sample of the pixel finds.
pub fn sum(terms: &[StrategyTerm]) -> [f32; 3] {
    let own = terms.iter().filter(|term| term.t >= 2);
    own.fold([0.0; 3], |sum, term| [0, 1, 2].map(|c| sum[c] + term.contribution[c]))
}

#[test]
fn the_terms_of_the_strategies_add_up_to_the_samples_of_the_renderer_bit_for_bit() {
    let scene = scene(ROOM);
    let rays = scene.rays(&scene.camera);
    for estimator in [Estimator::Bidirectional, Estimator::LightTracing, Estimator::Caustics] {
        let settings = settings(&scene, estimator);
        assert!(scene.traces_light_paths(&settings));
        let mut batch = Batch::default();
        let tile = Work::tile(&scene, &rays, &settings, [0, 0], [TILE, TILE], 3);
        assert_eq!(trace(SimdLevel::best(), &tile, &mut batch, &|| false), Ok(()));
        let (mut connected, mut splats) = (0, 0);
        for [x, y] in (0..TILE).step_by(3).flat_map(|y| (0..TILE).step_by(5).map(move |x| [x, y])) {
            let Replay { radiance, bidirectional: Some(both), .. } = replay(&scene, &rays, &settings, [x, y], 3) else {
                panic!("{} traces light paths", estimator.name())
            };
            let [r, g, b, _] = batch.radiance()[(y * TILE + x) as usize];
            assert_eq!((sum(&both.strategies), radiance), ([r, g, b], [r, g, b]), "{} {x},{y}", estimator.name());
            assert_eq!(pixel_samples(&scene, &rays, &settings, [x, y], 3..4, &|| false), Some(vec![radiance]));
            connected += both.strategies.iter().filter(|term| term.s > 1 && term.t > 1).count();
            for term in both.strategies.iter().filter(|term| term.visible && term.t == 1) {
                let is_term = |splat: &Splat| Some(splat.place) == term.place && splat.light == term.contribution;
                assert!(batch.splats.iter().any(is_term), "{term:?}");
                splats += 1;
            }
        }
        assert_eq!((connected > 200, splats > 20), (estimator == Estimator::Bidirectional, estimator != Estimator::Caustics));
    }
}

#[test]
fn sums_of_many_connections_have_the_same_bits_for_any_number_of_lanes() {
    let scene = scene(ROOM);
    let (rays, settings) = (scene.rays(&scene.camera), settings(&scene, Estimator::Bidirectional));
    let traced = |level| {
        let mut batch = Batch::default();
        let tile = Work::tile(&scene, &rays, &settings, [0, 0], [TILE, TILE], 0);
        assert_eq!(trace(level, &tile, &mut batch, &|| false), Ok(()));
        (batch.radiance().to_vec(), batch.rays)
    };
    let reference = traced(SimdLevel::Scalar);
    for level in SimdLevel::available() {
        assert!(traced(level) == reference, "{level:?}");
    }
}

/// The pdf of camera paths at a first surface, per area, in closed form.
fn camera_density(camera: &Camera, p: DVec3, n: DVec3) -> f64 {
    let forward = (camera.look_at - camera.eye).normalize();
    let way = p - camera.eye;
    let cos = way.normalize().dot(forward);
    let pixel = 2.0 * (camera.fov.to_radians() / 2.0).tan() / f64::from(camera.resolution[1]);
    way.normalize().dot(n).abs() / (way.length_squared() * pixel * pixel * cos.powi(3))
}

/// The pdfs of the three strategies for the path over a point of the ball and one of the floor, and that of the light sample alone.
fn exact_pdfs(camera: &Camera, ball: DVec3, floor: DVec3) -> [f64; 3] {
    let n = (ball - CENTER) / RADIUS;
    let way = ball - floor;
    let (square, d) = (way.length_squared(), way.normalize());
    let (cos_floor, cos_ball) = (d.y, -d.dot(n));
    let camera_pdf = camera_density(camera, floor, DVec3::Y);
    let to_center = (CENTER - floor).length();
    let cone = 2.0 * PI * (1.0 - (1.0 - (RADIUS / to_center).powi(2)).sqrt());
    let area = 4.0 * PI * RADIUS * RADIUS;
    let pixels = f64::from(camera.resolution[0] * camera.resolution[1]);
    [
        camera_pdf * cos_floor * FRAC_1_PI * cos_ball / square,
        camera_pdf * cos_ball / (square * cone),
        pixels * cos_ball * cos_floor / (PI * area * square),
    ]
}

fn at(point: &PathPoint) -> DVec3 {
    Vec3::from(point.position).as_dvec3()
}

#[test]
fn pdfs_and_weights_are_those_of_the_closed_forms() {
    let scene = scene(BALL_AND_FLOOR);
    let rays = scene.rays(&scene.camera);
    let settings = RenderSettings { max_bounces: Some(1), ..settings(&scene, Estimator::Bidirectional) };
    let mut tested = [0; 2];
    for sample in 0..20 {
        for pixel in [[4, 20], [12, 25], [16, 14], [22, 20], [28, 28]] {
            let Some(BidirectionalSample { light, camera, strategies }) =
                replay(&scene, &rays, &settings, pixel, sample).bidirectional
            else {
                panic!("it traces light paths")
            };
            for term in &strategies {
                let (ball, floor, own) = match (term.s, term.t) {
                    (0, 3) => (at(&camera[1]), at(&camera[0]), 0),
                    (2, 1) => (at(&light[0]), at(&light[1]), 2),
                    _ => continue,
                };
                let pdfs = exact_pdfs(&scene.camera, ball, floor);
                let weight = pdfs[own] / pdfs.iter().sum::<f64>();
                let pdf = term.pdf.expect("a pdf");
                assert!((pdf / pdfs[own] - 1.0).abs() < 1e-4, "{term:?}: {pdfs:?}");
                assert!((f64::from(term.weight) / weight - 1.0).abs() < 1e-3, "{term:?}: {weight}");
                tested[own / 2] += 1;
            }
        }
    }
    assert!(tested[0] > 10 && tested[1] > 10, "{tested:?}");
}
