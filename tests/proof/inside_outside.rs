//! Camera and light inside or outside a sphere that does not emit.
use glam::DVec3;
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::exact::{SphereLight, lamberts_ball, mean_over_pixel};
use noisefall_render::render::{
    estimate::Estimate,
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, load},
};

use crate::statistics::assert_within;

/// Albedo of the ball in `outside_lit_outside.toml`.
const ALBEDO: f64 = 0.8;
const LIGHT: SphereLight = SphereLight { center: DVec3::new(1.7, 1.4, 1.0), radius: 0.5, radiance: 8.0 };

const SIDE: u32 = 64;

fn scene(name: &str) -> Scene {
    load(format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR")).as_ref()).expect("a shipped scene compiles")
}

/// Estimates of all pixels, row by row.
fn render(scene: &Scene, directions: Directions, spp: u32) -> Vec<Estimate> {
    let camera = Camera { resolution: [SIDE, SIDE], ..scene.camera };
    let sampler = Sampler::Independent;
    let settings = RenderSettings {
        estimator: Estimator::Path,
        sampler,
        directions,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        merging: false,
        count_crossings: false,
        reuse: Reuse::Off,
        adaptive: true,
        seed: 3,
        strategy: None,
        fault: None,
    };
    let mut film = Film::new(camera.resolution);
    let threads = Threads::new(2, SimdLevel::best()).expect("two threads can be had");
    let count = threads.pass(PassJob { scene, rays: &scene.rays(&camera), settings: &settings }, &mut film, spp, &|| false);
    assert_eq!((film.invalid_samples(), count.cut_paths), (0, 0));
    let mut estimates = vec![Estimate { mean: [0.0; 3], variance_of_mean: None }; (SIDE * SIDE) as usize];
    for tile in &film.tiles {
        for row in 0..tile.size[1] {
            let start = ((tile.origin[1] + row) * SIDE + tile.origin[0]) as usize;
            for (i, estimate) in (start..).zip(tile.estimates(row as usize)) {
                estimates[i] = estimate;
            }
        }
    }
    estimates
}

/// Deviation of the sum over pixels from its exact value, in standard errors.
fn z_of_sum(pixels: impl Iterator<Item = (Estimate, f64)>) -> f64 {
    let (mut difference, mut variance) = (0.0, 0.0);
    for (estimate, exact) in pixels {
        difference += estimate.mean[0] - exact;
        variance += estimate.variance_of_mean.expect("more than one sample")[0];
    }
    difference / variance.sqrt()
}

#[test]
fn no_light_passes_a_closed_sphere() {
    for name in ["inside_lit_outside", "outside_lit_inside"] {
        let picture = render(&scene(name), Directions::Uniform, 64);
        assert!(picture.iter().all(|pixel| pixel.mean == [0.0; 3]), "{name}");
    }
}

#[test]
fn a_light_in_the_middle_lights_the_inside_evenly() {
    // The light fills the fraction F = (r/R)² of the cosine-weighted hemisphere of a wall point, and the wall fills the rest:
    // B = ρ (L F + B (1 − F)).
    let (albedo, radiance, share) = (0.5, 8.5, 0.25f64.powi(2));
    let exact = albedo * radiance * share / (1.0 - albedo * (1.0 - share));
    assert!((exact - 0.5).abs() < 1e-12);
    for directions in Directions::ALL {
        let picture = render(&scene("inside_lit_inside"), directions, 512);
        assert_within(z_of_sum(picture.iter().map(|pixel| (*pixel, exact))), &format!("the whole image, {directions:?}"));
        for (i, quarter) in picture.chunks(picture.len() / 4).enumerate() {
            assert_within(z_of_sum(quarter.iter().map(|pixel| (*pixel, exact))), &format!("quarter {i}, {directions:?}"));
        }
    }
}

#[test]
fn a_ball_lit_from_outside_is_lamberts_ball() {
    let scene = scene("outside_lit_outside");
    let picture = render(&scene, Directions::Cosine, 1024);
    let camera = Camera { resolution: [SIDE; 2], ..scene.camera };
    let exact = |pixel: usize| {
        let place = [pixel as u32 % SIDE, pixel as u32 / SIDE];
        mean_over_pixel(&camera, place, |o, d| lamberts_ball(ALBEDO, LIGHT, o, d))
    };
    let lit: Vec<_> = picture.iter().enumerate().filter_map(|(i, pixel)| Some((*pixel, exact(i)?))).collect();
    assert!(lit.len() > 150, "the ball is in the image: {}", lit.len());
    assert_within(z_of_sum(lit.iter().copied()), "the lit part of the ball");
    for (i, part) in lit.chunks(lit.len().div_ceil(4)).enumerate() {
        assert_within(z_of_sum(part.iter().copied()), &format!("part {i} of the ball"));
    }
}
