//! Closed rooms: integrating sphere and mirrors.
use std::f64::consts::PI;

use crate::validate::{
    Section, Statement, Validation,
    check::{RED, scene},
};
use noisefall_kernel::measure::{exact::furnace_capped, picture};
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette, Scene};

pub fn section(validation: &Validation) -> Section {
    let mut statements = integrating_sphere(validation);
    statements.extend(mirrors(validation));
    Section {
        title: "Integrating sphere and mirrors",
        claim: "An integrating sphere and a pair of mirrors agree with their closed forms.",
        derivation: &[
            "Every point of a sphere sees every other point with the same form factor: the irradiance is the same everywhere, and E/π = H = mean(L_e)/(1 − mean(ρ)) \
             with means over its area, however emission and albedo are distributed. Averaged over the wall, that is, over all directions from the centre, the radiance is H again. Here 5 × 5 cells of albedo 0.9 and 0.2 and 3 × 3 cells of emission \
             0.25 and 2 alternate.",
            "Two mirrors that face each other, both with reflectance r and emitting L_e, have the radiance L_e Σ rᵏ, or its partial sum with a cap of n bounces. Every single sample is that number. Here r = 0.75 and L_e = 1.",
        ],
        source: "W. E. Sumpner, 1892, for the integrating sphere.",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}

/// Values of even and odd cells, and the number of strips.
type Checker = (f64, f64, u32);

/// The mean of a checker in (u, v) over the area of a sphere, for an odd number of strips. Along each strip of v one colour has
/// one cell more than the other, and a strip has the area ½ (cos πv₀ − cos πv₁).
fn mean((even, odd, strips): Checker) -> f64 {
    let edge = |j: u32| (PI * f64::from(j) / f64::from(strips)).cos();
    let strip = |j: u32| {
        let evens = (0..strips).filter(|i| (i + j).is_multiple_of(2)).count() as f64 / f64::from(strips);
        (edge(j) - edge(j + 1)) / 2.0 * (evens * even + (1.0 - evens) * odd)
    };
    (0..strips).map(strip).sum()
}

const REFLECTED: Checker = (0.9, 0.2, 5);
const EMITTED: Checker = (0.25, 2.0, 3);

/// The irradiance of the wall divided by π: H.
fn mixed() -> f64 {
    mean(EMITTED) / (1.0 - mean(REFLECTED))
}

/// A sphere with these checkers, seen from its centre.
fn sphere(camera: &str) -> Scene {
    let text = |(even, odd, strips): Checker| format!("checker = {{ even = {even:?}, odd = {odd:?}, scale = {strips}.0 }}");
    scene(&format!(
        "camera = {{ eye = [0.0, 0.0, 0.0], {camera} }}
        textures.albedo.{}
        textures.radiance.{}
        materials.wall.lambertian.albedo.texture = 'albedo'
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
        material = 'wall'
        flip = true
        emission.texture = 'radiance'",
        text(REFLECTED),
        text(EMITTED)
    ))
}

/// A view of the wall inside even cells of both checkers, and its radiance.
pub fn wall_of_sphere() -> (Scene, f64) {
    (sphere("look_at = [-1.0, 0.0, 0.0], fov = 5.0, resolution = [64, 64]"), EMITTED.0 + REFLECTED.0 * mixed())
}

/// All directions from the centre: six views of 90°, with pixels weighted by their solid angle.
fn integrating_sphere(validation: &Validation) -> Vec<Statement> {
    const SIDE: u32 = 32;
    let exact = mean(EMITTED) + mean(REFLECTED) * mixed();
    let views = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let mut statements = Vec::new();
    for estimator in Estimator::ALL {
        let (mut sum, mut variance, mut whole) = (0.0, 0.0, 0.0);
        for at in views {
            let up = if at[1] == 0 { [0, 1, 0] } else { [0, 0, 1] };
            let scene = sphere(&format!("look_at = {at:?}, up = {up:?}, fov = 90.0, resolution = [{SIDE}, {SIDE}]"));
            let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..validation.settings(estimator) };
            let weights: Vec<(usize, f64)> = (0..(SIDE * SIDE) as usize)
                .map(|i| {
                    let place = |x: u32| (f64::from(x) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
                    let (x, y) = (place(i as u32 % SIDE), place(i as u32 / SIDE));
                    (i, (1.0 + x * x + y * y).powf(-1.5))
                })
                .collect();
            let weight: f64 = weights.iter().map(|(_, weight)| weight).sum();
            let found = picture(&scene, settings, RED, validation.spp(600)).weighted(&weights);
            sum += weight * found.mean;
            variance += weight * weight * found.variance_of_mean;
            whole += weight;
        }
        // Cells may end within a pixel, which has the weight of its centre.
        let error = variance.sqrt().hypot(1e-4 * whole);
        let what = format!("textured integrating sphere, mean over all directions, {}", estimator.name());
        // The tolerance is not part of the noise.
        statements.push(Statement { z: None, ..Statement::z(what, sum / whole, error / whole, exact) });
    }
    statements
}

fn mirrors(validation: &Validation) -> Vec<Statement> {
    const RADIUS: f64 = 1e6;
    const REFLECTANCE: f64 = 0.75;
    let object = |z: f64| {
        format!(
            "[[objects]]
            shape.sphere = {{ center = [0.0, 0.0, {z:?}], radius = {RADIUS:?} }}
            material = 'mirror'
            emission.radiance = 1.0"
        )
    };
    let scene = scene(&format!(
        "camera = {{ eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 0.5], fov = 0.001, resolution = [8, 8] }}
        materials.mirror.mirror.reflectance = {REFLECTANCE}
        {}
        {}",
        object(RADIUS + 0.5),
        object(-RADIUS - 0.5)
    ));
    let mirror = |cap: u32| {
        let settings = RenderSettings { max_bounces: Some(cap), ..validation.settings(Estimator::Mis) };
        let found = picture(&scene, settings, RED, 4).whole();
        let exact = furnace_capped(1.0, REFLECTANCE, cap);
        Statement::within(format!("mirrors that face each other, cap at {cap}"), found.mean, exact, 2e-6 * exact)
    };
    [0, 1, 2, 5, 20, 100].map(mirror).into()
}
