//! Two mirrors that face each other and emit: the radiance is a geometric series.
//!
//! Mirrors a and b of reflectances r_a, r_b and radiances L_a, L_b, both huge, so that a ray at right angles to one meets the other
//! at a right angle. Looking at a: L = L_a + r_a (L_b + r_b L), so that L = (L_a + r_a L_b)/(1 − r_a r_b). With a cap at n
//! reflections it is the sum of the first n + 1 terms L_a, r_a L_b, r_a r_b L_a, … There is no chance in any of it: every single
//! sample is that number, by every estimator.
use noisefall_kernel::measure::exact::{furnace, furnace_capped};
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette, Scene};

use crate::{
    picture::{BLUE, GREEN, Measure, RED, picture, scene, settings},
    statistics::samples,
};

/// Rounding of single precision over the terms of a sum.
const ROUNDING: f64 = 2e-6;

/// Reflectance and radiance of a mirror, per channel.
#[derive(Clone, Copy)]
struct MirrorLight {
    reflectance: [f64; 3],
    radiance: [f64; 3],
}

fn off(estimator: Estimator, max_bounces: Option<u32>) -> RenderSettings {
    RenderSettings { roulette: Roulette::Off, max_bounces, ..settings(estimator) }
}

/// From the middle of a gap of a metre between the outsides of two spheres of 1000 km, or the insides of two caps of them.
fn gap(inside: bool, at: MirrorLight, behind: MirrorLight) -> Scene {
    const RADIUS: f64 = 1e6;
    let distance = if inside { RADIUS - 0.5 } else { RADIUS + 0.5 };
    // Seen from inside, the mirror ahead is the one whose centre lies behind, and its normal must point to the camera.
    let side = if inside { -1.0 } else { 1.0 };
    let object = |name: &str, z: f64, mirror: &MirrorLight| {
        format!(
            "[[objects]]
            shape.sphere = {{ center = [0.0, 0.0, {z:?}], radius = {RADIUS:?} }}
            material = '{name}'
            flip = {inside}
            {}",
            if mirror.radiance == [0.0; 3] { String::new() } else { format!("emission.radiance = {:?}", mirror.radiance) }
        )
    };
    scene(&format!(
        "camera = {{ eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 0.5], fov = 0.001, resolution = [8, 4] }}
        materials.at.mirror.reflectance = {:?}
        materials.behind.mirror.reflectance = {:?}
        {}
        {}",
        at.reflectance,
        behind.reflectance,
        object("at", side * distance, &at),
        object("behind", -side * distance, &behind)
    ))
}

fn assert_every_sample_is(exact: f64, scene: &Scene, settings: RenderSettings, measure: Measure) {
    let found = picture(scene, settings, measure, 4);
    for pixel in &found.pixels {
        let error = (pixel.mean / exact - 1.0).abs();
        assert!(
            error < ROUNDING && pixel.variance_of_mean.sqrt() < ROUNDING * exact,
            "{pixel:?} in place of {exact}, {settings:?}"
        );
    }
}

#[test]
fn equal_mirrors_sum_the_series_of_the_furnace() {
    let mirror = |r: f64| MirrorLight { reflectance: [r, 0.5, 0.25], radiance: [1.5, 1.0, 1.0] };
    for inside in [false, true] {
        for r in [0.125, 0.75, 0.9375] {
            let scene = gap(inside, mirror(r), mirror(r));
            for estimator in Estimator::ALL {
                assert_every_sample_is(furnace(1.5, r), &scene, off(estimator, None), RED);
                assert_every_sample_is(furnace(1.0, 0.5), &scene, off(estimator, None), GREEN);
                for cap in 0..=8 {
                    assert_every_sample_is(furnace_capped(1.5, r, cap), &scene, off(estimator, Some(cap)), RED);
                }
            }
        }
    }
}

#[test]
fn with_powers_of_one_half_every_sample_is_exact_to_the_last_bit() {
    let mirror = MirrorLight { reflectance: [0.5; 3], radiance: [1.0; 3] };
    let scene = gap(false, mirror, mirror);
    for estimator in Estimator::ALL {
        for cap in [0, 1, 2, 5, 20] {
            let exact = furnace_capped(1.0, 0.5, cap);
            assert!(samples(&scene, off(estimator, Some(cap)), 4).iter().flatten().all(|x| *x == exact), "cap {cap}");
        }
        assert!(samples(&scene, off(estimator, None), 4).iter().flatten().all(|x| *x == 2.0));
    }
}

#[test]
fn different_mirrors_alternate_and_their_colours_do_not_mix() {
    let a = MirrorLight { reflectance: [0.9, 0.5, 0.25], radiance: [2.0, 0.0, 3.0] };
    let b = MirrorLight { reflectance: [0.8, 0.75, 0.0], radiance: [0.5, 1.0, 0.0] };
    let dark = MirrorLight { radiance: [0.0; 3], ..b };
    for (at, behind) in [(a, b), (b, a), (a, dark), (dark, a)] {
        for inside in [false, true] {
            let scene = gap(inside, at, behind);
            for (channel, measure) in [RED, GREEN, BLUE].into_iter().enumerate() {
                let value = |mirror: &MirrorLight| (mirror.reflectance[channel], mirror.radiance[channel]);
                let ((r_at, l_at), (r_behind, l_behind)) = (value(&at), value(&behind));
                let exact = (l_at + r_at * l_behind) / (1.0 - r_at * r_behind);
                let to_second_order = l_at + r_at * l_behind + r_at * r_behind * l_at;
                for estimator in Estimator::ALL {
                    if exact > 0.0 {
                        assert_every_sample_is(exact, &scene, off(estimator, None), measure);
                        assert_every_sample_is(to_second_order, &scene, off(estimator, Some(2)), measure);
                    } else {
                        let found = picture(&scene, off(estimator, None), measure, 4);
                        assert!(found.pixels.iter().all(|pixel| pixel.mean == 0.0));
                    }
                }
            }
        }
    }
}

#[test]
fn inside_a_closed_mirror_every_direction_sums_the_series() {
    let scene = scene(
        "camera = { eye = [0.3, -0.2, 0.4], look_at = [1.0, 0.3, 0.0], fov = 120.0, resolution = [16, 16] }
        materials.mirror.mirror.reflectance = 0.875
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }
        material = 'mirror'
        flip = true
        emission.radiance = 1.0",
    );
    for estimator in Estimator::ALL {
        assert_every_sample_is(furnace(1.0, 0.875), &scene, off(estimator, None), RED);
        assert_every_sample_is(furnace_capped(1.0, 0.875, 10), &scene, off(estimator, Some(10)), RED);
    }
}
