//! Glass that absorbs, seen along its axis, against the sum over all internal reflections.
//!
//! Every ray goes through the common centre of the balls, so it hits every surface at a right angle. There R = ((n − 1)/(n + 1))²
//! of the light is reflected (Fresnel's equations at normal incidence) and 1 − R is transmitted. A distance s transmits a =
//! transmittanceˢ (Beer's law). A uniform field of radiance 1 surrounds the balls.
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette};

use crate::{
    glass::{O, in_white_light},
    picture::{BLUE, GREEN, RED, picture, settings},
    statistics::assert_within,
};

const IOR: f64 = 1.5;
const RADIUS: f64 = 0.5;
const TRANSMITTANCE: [f64; 3] = [0.9, 0.5, 0.05];

const ON_AXIS: &str = "eye = [0.0, 0.0, 3.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 1e-6";
const FROM_THE_MIDDLE: &str = "eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], fov = 60.0";

/// The radiance in a tinted ball, with clear bubbles and kernels of these radii and materials in it, as a function of R and the
/// transmittance of a metre.
fn assert_shows(camera: &str, inner: &[(f64, &str)], exact: impl Fn(f64, f64) -> f64) {
    let materials = format!(
        "materials.tinted.dielectric = {{ ior = {IOR:?}, transmittance = {TRANSMITTANCE:?} }}
        materials.bubble.dielectric = {{ ior = 1.0, ior_outside = {IOR:?} }}
        materials.kernel.dielectric = {{ ior = {IOR:?}, transmittance = {TRANSMITTANCE:?} }}"
    );
    let spheres: Vec<_> = [(RADIUS, "tinted")].iter().chain(inner).map(|(radius, material)| (O, *radius, *material)).collect();
    let scene = in_white_light(camera, &materials, &spheres);
    let r = ((IOR - 1.0) / (IOR + 1.0)).powi(2);
    for (transmittance, measure) in TRANSMITTANCE.into_iter().zip([RED, GREEN, BLUE]) {
        let expected = exact(r, transmittance);
        for estimator in Estimator::ALL {
            for roulette in [Roulette::Off, Roulette::BY_THROUGHPUT] {
                let found = picture(&scene, RenderSettings { roulette, ..settings(estimator) }, measure, 256).whole();
                let what = format!("transmittance {transmittance}, {}, {roulette:?}", estimator.name());
                println!("{what}: {:.6} ± {:.1e}, exact {expected:.6}", found.mean, found.variance_of_mean.sqrt());
                assert_within(found.z(expected), &what);
            }
        }
    }
}

#[test]
fn a_tinted_ball_shows_the_sum_over_its_internal_reflections() {
    // R is reflected outside. What enters crosses the ball, k + 1 times when it is reflected k times inside, and leaves:
    // R + (1 − R)² Σₖ Rᵏ aᵏ⁺¹.
    assert_shows(ON_AXIS, &[], |r, transmittance| {
        let a = transmittance.powf(2.0 * RADIUS);
        r + (1.0 - r).powi(2) * a / (1.0 - r * a)
    });
}

#[test]
fn the_middle_of_a_tinted_ball_sees_the_same_sum_through_one_surface() {
    // Half a crossing to the surface, through which the radiance is n² times that outside; a further crossing for every internal
    // reflection: n² (1 − R) √a Σₖ (R a)ᵏ. The path must know that it starts inside.
    assert_shows(FROM_THE_MIDDLE, &[], |r, transmittance| {
        let a = transmittance.powf(2.0 * RADIUS);
        IOR * IOR * (1.0 - r) * a.sqrt() / (1.0 - r * a)
    });
}

/// A stack of layers: its reflectance on the near and the far side, and its transmittance.
#[derive(Clone, Copy)]
struct Stack {
    near: f64,
    far: f64,
    passes: f64,
}

impl Stack {
    /// Adds another stack behind a layer of transmittance `a`: the series of reflections between the two (G. G. Stokes, "On the
    /// Intensity
    /// of the Light Reflected from or Transmitted through a Pile of Plates", 1862).
    fn then(self, a: f64, next: Stack) -> Stack {
        let echoes = 1.0 / (1.0 - self.far * a * a * next.near);
        Stack {
            near: self.near + self.passes.powi(2) * a * a * next.near * echoes,
            far: next.far + next.passes.powi(2) * a * a * self.far * echoes,
            passes: self.passes * a * next.passes * echoes,
        }
    }
}

#[test]
fn shells_of_tinted_glass_and_air_are_a_pile_of_plates() {
    const BUBBLE: f64 = 0.4;
    const KERNEL: f64 = 0.15;
    for inner in [&[(BUBBLE, "bubble")][..], &[(BUBBLE, "bubble"), (KERNEL, "kernel")]] {
        assert_shows(ON_AXIS, inner, |r, transmittance| {
            let surface = Stack { near: r, far: r, passes: 1.0 - r };
            let shell = surface.then(transmittance.powf(RADIUS - BUBBLE), surface);
            let pile = if inner.len() == 1 {
                shell.then(1.0, shell)
            } else {
                let kernel = surface.then(transmittance.powf(2.0 * KERNEL), surface);
                shell.then(1.0, kernel).then(1.0, shell)
            };
            pile.near + pile.passes
        });
    }
}

#[test]
fn a_clear_ball_within_endless_fog_is_clear() {
    // A flipped sphere is fog everywhere but inside it: 3 m of ball, then 6 m of fog, then the hollow's clear metre around the light.
    let text = "camera = { eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], fov = 1.0, resolution = [4, 4] }
        materials.clear.dielectric = { ior = 1.0 }
        materials.fog.dielectric = { ior = 1.0, transmittance = 0.5 }
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 3.0 }
        material = 'clear'
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 10.0], radius = 1.0 }
        material = 'fog'
        flip = true
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 10.0], radius = 0.9 }
        emission.radiance = 1.0";
    let found = picture(&crate::picture::scene(text), settings(Estimator::Path), RED, 16).whole();
    assert!((found.mean - 0.5f64.powi(6)).abs() < 1e-4, "{}", found.mean);
}

#[test]
fn threads_forget_the_media_of_the_scene_before() {
    use noisefall_base::math::SimdLevel;
    use noisefall_render::render::{
        film::Film,
        threads::{PassJob, Threads},
    };
    let scene = |tints: usize| {
        let tint = |i: usize| format!("materials.tint{i}.dielectric = {{ ior = 1.1, transmittance = 0.{i:02} }}\n");
        let ball = |i: usize| {
            let [x, y] = [i % 5, i / 5].map(|i| i as f64 - 2.0);
            format!("[[objects]]\nshape.sphere = {{ center = [{x:?}, {y:?}, 0.0], radius = 0.45 }}\nmaterial = 'tint{i}'\n")
        };
        let numbers = || (0..25).map(|i| i % tints + 10);
        let materials: String = (10..10 + tints).map(tint).collect();
        let objects: String =
            numbers().enumerate().map(|(i, tint)| ball(i).replace(&format!("tint{i}'"), &format!("tint{tint}'"))).collect();
        let camera = "camera = { eye = [0.0, 0.0, 6.0], look_at = [0.0, 0.0, 0.0], fov = 50.0, resolution = [96, 96] }";
        crate::picture::scene(&format!("{camera}\nenvironment.radiance = 1.0\n{materials}{objects}"))
    };
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    for tints in [25, 2] {
        let scene = scene(tints);
        for seed in 0..8 {
            let settings = RenderSettings { seed, ..settings(Estimator::Mis) };
            let mut film = Film::new(scene.camera.resolution);
            let rays = scene.rays(&scene.camera);
            let count = threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 2, &|| false);
            assert_eq!(count.failure, None, "{tints} tints, seed {seed}");
        }
    }
}
