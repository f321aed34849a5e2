//! A sample is a pure function of its index: threads, SIMD level, interruptions and replays do not change a bit.
use std::sync::atomic::{AtomicU32, Ordering};

use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::replay;
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, built_in},
};

const RESOLUTION: [u32; 2] = [75, 50];
const PATH_REUSE: [Reuse; 4] = [Reuse::Off, Reuse::Suffixes, Reuse::Outliers, Reuse::Both];
/// Enough samples for adaptive sampling to distribute them.
const SPP: u32 = 8;

fn settings(sampler: Sampler, reuse: Reuse) -> RenderSettings {
    RenderSettings {
        estimator: Estimator::Path,
        sampler,
        directions: Directions::Cosine,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        merging: false,
        count_crossings: false,
        reuse,
        adaptive: true,
        seed: 5,
        strategy: None,
        fault: None,
    }
}

fn camera(scene: &Scene) -> Camera {
    Camera { resolution: RESOLUTION, ..scene.camera }
}

fn film(scene: &Scene, threads: usize, level: SimdLevel, settings: &RenderSettings, spp: u32) -> Film {
    let mut film = Film::new(RESOLUTION);
    let threads = Threads::new(threads, level).expect("threads can be had");
    let job = PassJob { scene, rays: &scene.rays(&camera(scene)), settings };
    threads.pass(job, &mut film, spp, &|| false);
    film
}

fn bits(film: &Film) -> Vec<[u32; 4]> {
    let frame = Frame::of_film(film, 0, RESOLUTION, RESOLUTION);
    let pixels = frame.radiance.iter().zip(&frame.standard_error);
    pixels.map(|([r, g, b], error)| [r, g, b, error].map(|x| x.to_bits())).collect()
}

/// Asserts that any number of threads and any SIMD level give the same bits.
fn assert_same_everywhere(scene: &Scene, settings: &RenderSettings, what: &str) {
    let reference = bits(&film(scene, 1, SimdLevel::Scalar, settings, SPP));
    for level in SimdLevel::available() {
        for threads in [1, 2, 4] {
            assert!(bits(&film(scene, threads, level, settings, SPP)) == reference, "{what}, {level:?}, {threads}");
        }
    }
}

/// Asserts that a pass that is interrupted, sometimes in the middle of a path, continues to the same bits.
fn assert_goes_on(scene: &Scene, settings: &RenderSettings, what: &str) {
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let job = PassJob { scene, rays: &scene.rays(&camera(scene)), settings };
    let mut interrupted = Film::new(RESOLUTION);
    let asked = AtomicU32::new(0);
    while interrupted.spp() < SPP {
        threads.pass(job, &mut interrupted, SPP, &|| asked.fetch_add(1, Ordering::Relaxed) % 211 == 210);
    }
    assert!(bits(&interrupted) == bits(&film(scene, 1, SimdLevel::best(), settings, SPP)), "{what}");
}

#[test]
fn the_film_is_the_same_for_every_number_of_threads_and_every_simd_level() {
    let scene = built_in();
    for (sampler, reuse) in Sampler::ALL.into_iter().flat_map(|sampler| PATH_REUSE.map(|reuse| (sampler, reuse))) {
        assert_same_everywhere(&scene, &settings(sampler, reuse), &format!("{}, {reuse:?}", sampler.name()));
    }
}

#[test]
fn an_interrupted_pass_goes_on_as_if_nothing_had_happened() {
    let scene = built_in();
    for reuse in PATH_REUSE {
        assert_goes_on(&scene, &settings(Sampler::Sobol, reuse), &format!("{reuse:?}"));
    }
}

#[test]
fn replayed_samples_add_up_to_the_film() {
    let scene = built_in();
    let rays = scene.rays(&camera(&scene));
    for (sampler, reuse) in Sampler::ALL.into_iter().flat_map(|sampler| PATH_REUSE.map(|reuse| (sampler, reuse))) {
        let settings = settings(sampler, reuse);
        let film = film(&scene, 2, SimdLevel::best(), &settings, 3);
        let frame = Frame::of_film(&film, 0, RESOLUTION, RESOLUTION);
        for [x, y] in [[0, 0], [37, 25], [74, 49], [64, 31], [12, 40]] {
            let mut sum = [0f64; 3];
            for sample in 0..3 {
                let replay = replay(&scene, &rays, &settings, [x, y], sample);
                let own = replay.alone.unwrap_or(replay.radiance);
                assert_eq!(replay.vertices.last().map(|vertex| vertex.radiance), Some(own));
                (0..3).for_each(|c| sum[c] += f64::from(replay.radiance[c]));
            }
            assert_eq!(frame.radiance[(y * RESOLUTION[0] + x) as usize], sum.map(|s| (s / 3.0) as f32), "{}", sampler.name());
        }
    }
}

/// The settings of an estimator with light paths.
fn with_light_paths(estimator: Estimator) -> RenderSettings {
    RenderSettings { estimator, adaptive: false, ..settings(Sampler::Sobol, Reuse::Off) }
}

const BIDIRECTIONAL: [Estimator; 2] = [Estimator::LightTracing, Estimator::Bidirectional];

#[test]
fn paths_from_lights_bring_the_same_light_for_every_number_of_threads_and_every_simd_level() {
    let scene = built_in();
    for estimator in BIDIRECTIONAL {
        let settings = with_light_paths(estimator);
        assert!(scene.traces_light_paths(&settings));
        assert_same_everywhere(&scene, &settings, estimator.name());
    }
}

#[test]
fn an_interrupted_pass_with_paths_from_lights_goes_on_as_if_nothing_had_happened() {
    let scene = built_in();
    for estimator in BIDIRECTIONAL {
        assert_goes_on(&scene, &with_light_paths(estimator), estimator.name());
    }
}
