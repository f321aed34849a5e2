//! A plate of smooth glass with light from one side: Fresnel's equations and the sum over all reflections between its faces.
//!
//! Each face reflects R(θ), the mean of both polarisations, and a crossing lets a pass. Of what comes from beyond the plate
//! (1 − R)² a Σ (R a)²ᵏ arrives, that is (1 − R)/(1 + R) if a = 1; of what comes from the viewer's side R + (1 − R)² R a² Σ (R a)²ᵏ
//! returns, 2 R/(1 + R) if a = 1 (G. G. Stokes, 1862).
use noisefall_kernel::measure::exact::fresnel;
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette};

use crate::picture::{RED, assert_all_within, picture, scene, settings};

const THICKNESS: f64 = 0.1;

/// Checks the light of a wall on this side of the plate, or beyond it, that the plate shows at the angle `degrees`.
fn assert_shows(ior: f64, transmittance: f64, degrees: f64, beyond: bool) {
    let theta = degrees.to_radians();
    let (r, inside) = fresnel(ior, theta);
    let a = transmittance.powf(THICKNESS / inside);
    let echoes = 1.0 / (1.0 - (r * a).powi(2));
    let exact = if beyond { (1.0 - r).powi(2) * a * echoes } else { r + (1.0 - r).powi(2) * r * a * a * echoes };
    let (eye, wall) = ([2.0 * theta.sin(), 0.0, 2.0 * theta.cos()], if beyond { -3.0 } else { 3.0 });
    let scene = scene(&format!(
        "camera = {{ eye = {eye:?}, look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 0.1, resolution = [32, 32] }}
        materials.glass.dielectric = {{ ior = {ior:?}, transmittance = {transmittance:?} }}
        [[objects]]
        shape.cuboid = {{ min = [-100.0, -100.0, {:?}], max = [100.0, 100.0, 0.0] }}
        material = 'glass'
        [[objects]]
        shape.rectangle = {{ origin = [-90.0, -90.0, {wall:?}], edge_u = [180.0, 0.0, 0.0], edge_v = [0.0, 180.0, 0.0] }}
        emission.radiance = 1.0
        flip = {}",
        -THICKNESS, !beyond
    ));
    let mut deviations = Vec::new();
    for estimator in Estimator::ALL {
        for roulette in [Roulette::Off, Roulette::BY_THROUGHPUT] {
            let found = picture(&scene, RenderSettings { roulette, ..settings(estimator) }, RED, 64).whole();
            let what = format!("{}, {roulette:?}", estimator.name());
            println!("{what}: {:.6} ± {:.1e}, exact {exact:.6}", found.mean, found.variance_of_mean.sqrt());
            deviations.push(found.z(exact));
        }
    }
    let side = if beyond { "through" } else { "off" };
    assert_all_within(&deviations, &format!("{side} {ior}, {transmittance}, {degrees}°, by estimator and roulette"));
}

#[test]
fn a_plate_reflects_and_transmits_by_the_fresnel_equations() {
    for beyond in [false, true] {
        for degrees in [0.0, 30.0, 56.31, 75.0, 85.0] {
            assert_shows(1.5, 1.0, degrees, beyond);
            assert_shows(1.5, 1e-3, degrees, beyond);
        }
        assert_shows(2.4, 1.0, 60.0, beyond);
    }
    assert_shows(1.0, 0.01, 40.0, true);
}
