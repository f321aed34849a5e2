//! Vertex merging of the estimator `bidirectional`.
use super::{
    bidirectional::{BALL, SETTINGS, mean, scene},
    noise::shipped,
};
use crate::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{TILE, replay};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Roulette, Scene};

const CONNECTED: RenderSettings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..SETTINGS };
const MERGED: RenderSettings = RenderSettings { merging: true, ..CONNECTED };

/// A shipped scene with a small image.
fn small(name: &str, resolution: [u32; 2]) -> Scene {
    let mut scene = shipped(name);
    scene.camera = Camera { resolution, ..scene.camera };
    scene
}

#[test]
fn the_bias_shrinks_with_the_number_of_samples() {
    let scene = scene(BALL, "white");
    let [exact, variance] = mean(&scene, &RenderSettings { estimator: Estimator::Mis, seed: 1, ..CONNECTED }, 8000);
    // Light on the floor leaks below the panels by the radius, of which the square falls as the cube root of the number.
    for (spp, most) in [(64, 0.02), (4096, 0.005)] {
        let [merged, of_merged] = mean(&scene, &MERGED, spp);
        let error = 4.0 * (variance + of_merged).sqrt();
        assert!((merged - exact).abs() < error + most * exact, "{spp}: {merged}, {exact} ± {error}");
    }
}

#[test]
fn it_finds_caustics_in_mirrors_that_connections_miss() {
    for name in ["caustic_in_mirror", "water_pool"] {
        let scene = small(name, [64, 48]);
        let [variance, of_merged] = [CONNECTED, MERGED].map(|settings| mean(&scene, &settings, 64)[1]);
        assert!(of_merged < 0.5 * variance, "{name}: {of_merged}, {variance}");
    }
}

#[test]
fn the_image_has_the_same_bits_for_any_number_of_threads_and_lanes() {
    let scene = small("glass_ball_caustic", [TILE + 7, TILE + 3]);
    let rays = scene.rays(&scene.camera);
    let images = [(1, SimdLevel::Scalar), (2, SimdLevel::best())].map(|(threads, level)| {
        let threads = Threads::new(threads, level).expect("threads");
        let mut film = Film::new(rays.resolution);
        threads.pass(PassJob { scene: &scene, rays: &rays, settings: &MERGED }, &mut film, 3, &|| false);
        Frame::of_film(&film, 0, rays.resolution, rays.resolution).radiance
    });
    assert!(images[0] == images[1]);
}

#[test]
fn a_replayed_sample_has_the_light_of_its_tile() {
    let scene = small("cornell_box", [TILE + 7, TILE + 3]);
    let rays = scene.rays(&scene.camera);
    let pixel = [TILE + 2, 5];
    let [merged, connected] = [MERGED, CONNECTED].map(|settings| replay(&scene, &rays, &settings, pixel, 2));
    assert!(merged.bidirectional.is_none() && connected.bidirectional.is_some());
    assert!(merged.radiance != connected.radiance && merged.alone == connected.alone);
}

#[test]
fn it_is_labelled_as_a_bias_where_it_is_in_force() {
    assert_eq!(MERGED.bias().as_deref(), Some("vertex merging"));
    let capped = RenderSettings { max_bounces: Some(3), ..MERGED };
    assert_eq!(capped.bias().as_deref(), Some("cap at 3, vertex merging"));
    assert_eq!(RenderSettings { estimator: Estimator::Mis, ..MERGED }.bias(), None);
}
