//! Noise: the estimated relMSE, the variances of means over pixels, and adaptive sampling.
use std::sync::atomic::{AtomicU32, Ordering};

use crate::render::{
    error_estimator::rel_mse_estimate_in,
    film::Film,
    frame::Frame,
    path_reuse::resolved,
    region::Region,
    threads::{PassJob, Threads},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::{Moments, exact::furnace_variance};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, load, parse},
};

pub fn shipped(name: &str) -> Scene {
    load(format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR")).as_ref()).expect("a shipped scene")
}

fn render(scene: &Scene, settings: &RenderSettings, resolution: [u32; 2], spp: u32) -> Film {
    let rays = scene.rays(&Camera { resolution, ..scene.camera });
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let mut film = Film::new(resolution);
    threads.pass(PassJob { scene, rays: &rays, settings }, &mut film, spp, &|| false);
    film
}

fn frame(film: &Film) -> Frame {
    let [width, height] = film.resolution;
    Frame::of_film(film, 0, [width, height], [width, height])
}

/// Independent samples of the furnace, whose variance is known.
const UNIFORM: RenderSettings = RenderSettings {
    merging: false,
    estimator: Estimator::Path,
    sampler: Sampler::Independent,
    directions: Directions::Uniform,
    roulette: Roulette::Off,
    max_bounces: None,
    count_crossings: false,
    reuse: Reuse::Off,
    adaptive: false,
    seed: 3,
    fault: None,
    strategy: None,
};

/// The variance of one sample of the furnace over the square of its mean, 2, and 1 % of that.
fn rel_mse_of_furnace(spp: u32) -> f64 {
    furnace_variance(1.0, 0.5, 4.0 / 3.0) / (4.0 * 1.01) / f64::from(spp)
}

#[test]
fn the_estimate_is_the_variance_of_independent_samples_at_any_number_of_them() {
    let scene = shipped("furnace");
    for spp in [2, 3, 4, 7, 8, 24] {
        let mut ratios = Vec::new();
        for seed in 0..6 {
            let found = frame(&render(&scene, &RenderSettings { seed, ..UNIFORM }, [96, 64], spp)).rel_mse_estimate;
            ratios.push(found.expect("two samples") / rel_mse_of_furnace(spp));
        }
        let found = Moments::of(ratios);
        // Its own scatter says how well it is known, but for what few samples per pixel do to squares of means.
        let tolerance = 4.0 * (found.variance / 6.0).sqrt() + 0.02;
        assert!((found.mean - 1.0).abs() < tolerance && tolerance < 0.12, "{spp}: {} ± {tolerance}", found.mean);
    }
}

/// A wall that emits 2, the left half of which is a light of the same kind that is noisy.
#[test]
fn a_region_has_an_estimate_of_its_own_by_the_floor_of_the_whole() {
    let scene = shipped("furnace");
    let film = render(&scene, &UNIFORM, [128, 64], 16);
    let whole = frame(&film).rel_mse_estimate.expect("samples");
    let all = Region { from: [0, 0], to: [128, 64] };
    assert_eq!(rel_mse_estimate_in(&film, &all), Some(whole));
    let half = Region { from: [0, 0], to: [64, 64] };
    let of_half = rel_mse_estimate_in(&film, &half).expect("samples");
    assert!(of_half != whole && (of_half / whole - 1.0).abs() < 0.2, "{of_half} {whole}");
    assert_eq!(rel_mse_estimate_in(&film, &Region { from: [128, 0], to: [140, 9] }), None);
}

/// A room with its light this many times as bright.
fn room(scale: f32) -> Scene {
    let text = include_str!("../../../../../scenes/cornell_spheres.toml");
    let emission = "emission = { radiance = [15.0, 13.0, 10.5] }";
    assert!(text.contains(emission));
    let [r, g, b] = [15.0, 13.0, 10.5].map(|c: f32| f64::from(c * scale));
    parse("room.toml", text.replace(emission, &format!("emission = {{ radiance = [{r:?}, {g:?}, {b:?}] }}"))).expect("a scene")
}

#[test]
fn the_noise_figure_does_not_depend_on_the_unit_of_radiance() {
    for (adaptive, reuse) in [(false, Reuse::Auto), (true, Reuse::Off)] {
        let figure = |scale: f32| {
            let scene = room(scale);
            let rays = scene.rays(&scene.camera);
            let settings = resolved(&scene, &rays, &RenderSettings { adaptive, reuse, ..scene.settings });
            let film = render(&scene, &settings, [64, 48], 24);
            (frame(&film).rel_mse_estimate.expect("samples"), film.samples(), settings.reuse)
        };
        let unit = figure(1.0);
        for power in [-20, 12] {
            assert_eq!(figure(2f32.powi(power)), unit, "a power of two changes no bit");
        }
        for scale in [1e-3, 1e3] {
            let (found, samples, reuse) = figure(scale);
            assert!((found / unit.0 - 1.0).abs() < 1e-3 && (samples, reuse) == (unit.1, unit.2), "{scale}: {found} {unit:?}");
        }
    }
}

/// The estimated noise does not depend on when a render was interrupted, nor on how many threads it has.
#[test]
fn interruptions_change_no_bit_of_the_estimated_noise() {
    let scene = room(1.0);
    let rays = scene.rays(&Camera { resolution: [75, 50], ..scene.camera });
    for (adaptive, reuse) in [(false, Reuse::Suffixes), (true, Reuse::Off)] {
        let settings = RenderSettings { adaptive, reuse, ..scene.settings };
        let film = |threads: usize, pause: u32| {
            let threads = Threads::new(threads, SimdLevel::best()).expect("threads");
            let (mut film, asked) = (Film::new([75, 50]), AtomicU32::new(0));
            while film.spp() < 20 {
                let interrupted = || asked.fetch_add(1, Ordering::Relaxed) % pause == pause - 1;
                threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 20, &interrupted);
            }
            threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 20, &|| false);
            let Frame { rel_mse_estimate, noise, .. } = frame(&film);
            (rel_mse_estimate, noise)
        };
        let whole = film(1, u32::MAX);
        assert!(whole.0.is_some() && whole.1.is_some());
        assert!([(2, 211), (1, 257), (2, 499)].into_iter().all(|(threads, pause)| film(threads, pause) == whole), "{adaptive}");
    }
}

#[test]
fn an_interrupted_pilot_is_sent_again() {
    let scene = shipped("veach_plates");
    let rays = scene.rays(&Camera { resolution: [75, 50], ..scene.camera });
    let settings = RenderSettings { adaptive: true, reuse: Reuse::Off, ..scene.settings };
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let film = |at: u32| {
        let (mut film, asked) = (Film::new([75, 50]), AtomicU32::new(0));
        while film.spp() < 8 {
            let interrupted = || asked.fetch_add(1, Ordering::Relaxed) == at;
            threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 8, &interrupted);
        }
        assert!(film.is_adaptive());
        frame(&film).radiance
    };
    let whole = film(u32::MAX);
    assert!([0, 3, 20].into_iter().all(|at| film(at) == whole));
}

#[test]
fn a_picture_has_no_figure_before_light_is_found_and_a_black_one_gets_it_late() {
    let tiny = shipped("tiny_lamp");
    let figures = [2, 256].map(|spp| frame(&render(&tiny, &UNIFORM, [16, 16], spp)).rel_mse_estimate.is_some());
    assert_eq!(figures, [false, true]);
    let scene = shipped("inside_lit_outside");
    let film = render(&scene, &UNIFORM, [40, 40], 8);
    assert!(frame(&film).is_black());
    assert_eq!(frame(&film).rel_mse_estimate, None);
    assert_eq!(frame(&render(&scene, &UNIFORM, [8, 8], 1024)).rel_mse_estimate, Some(0.0));
    assert!(frame(&film).noise.is_some_and(|noise| noise.variance_of_mean() == 0.0 && noise.effective_samples == f64::INFINITY));
}

/// Means over tiles of many images scatter as each image says that they do. Returns the moments, over these images, of the variance
/// of the mean relative to what it would be if pixels were independent.
fn assert_scatter(scene: &Scene, settings: &RenderSettings, spp: u32, what: &str) -> Moments {
    const SEEDS: u32 = 32;
    const SIDE: u32 = 128;
    let (mut means, mut said, mut correlation) = (vec![Vec::new(); 16], vec![0.0; 16], Vec::new());
    let (mut wholes, mut said_of_whole, mut degrees) = (Vec::new(), 0.0, 0.0);
    for seed in 0..SEEDS {
        let frame = frame(&render(scene, &RenderSettings { seed, ..*settings }, [SIDE; 2], spp));
        let values: Vec<f64> = frame.radiance.iter().map(|rgb| rgb.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0).collect();
        let noise = frame.noise.expect("samples");
        let blocks = noisefall_kernel::measure::SampleNoise::block_means(&values, SIDE as usize);
        means.iter_mut().zip(&blocks).for_each(|(means, mean)| means.push(*mean));
        said.iter_mut().zip(&noise.blocks).for_each(|(said, variance)| *said += variance / f64::from(SEEDS));
        degrees = noise.block_degrees;
        wholes.push(blocks.iter().sum::<f64>() / 16.0);
        said_of_whole += noise.variance_of_mean() / f64::from(SEEDS);
        let sum: f64 = noise.variance.iter().map(|rgb| rgb.iter().map(|v| f64::from(*v).sqrt()).sum::<f64>().powi(2) / 9.0).sum();
        correlation.push(noise.variance_of_mean() / (sum / f64::from(SIDE.pow(4))));
    }
    // Tiles share no paths but those that light sends to other pixels. Each ratio is F of 31 degrees and those of all images.
    let bound = 4.0 * (2.0 / 16.0 * (1.0 / f64::from(SEEDS - 1) + 1.0 / (f64::from(SEEDS) * degrees))).sqrt();
    let ratios: Vec<f64> = means.into_iter().zip(&said).map(|(means, said)| Moments::of(means).variance / said).collect();
    let mean = ratios.iter().sum::<f64>() / 16.0;
    assert!((mean - 1.0).abs() < bound, "{what}: {mean} in tiles");
    // χ² of 31 degrees at 5σ, and at 4σ below and 3σ above.
    assert!(ratios.iter().all(|ratio| (0.18..2.84).contains(ratio)), "{what}: {ratios:?}");
    let of_whole = Moments::of(wholes).variance / said_of_whole;
    assert!((0.28..2.016).contains(&of_whole), "{what}: {of_whole}");
    Moments::of(correlation)
}

#[test]
fn means_over_blocks_scatter_as_their_variance_says() {
    let (room, pool, plates) = (room(1.0), shipped("water_pool"), shipped("veach_plates"));
    let independent = RenderSettings { sampler: Sampler::Independent, ..room.settings };
    let alone = assert_scatter(&room, &RenderSettings { reuse: Reuse::Off, ..independent }, 4, "pixels alone");
    // The channels of a sample come from one path, so what pixels say together is nearly right where they share nothing.
    assert!((0.9..1.05).contains(&alone.mean), "{}", alone.mean);
    assert_scatter(&room, &RenderSettings { reuse: Reuse::Suffixes, ..independent }, 4, "pixels that reuse paths");
    // Long paths are rare and bright, so what neighbours share is most of the noise. Rare samples are in the scatter and in what is said
    // of it, so their ratio remains near 1.
    let half = RenderSettings { roulette: Roulette::fixed(0.5), ..independent };
    let shared = assert_scatter(&room, &RenderSettings { reuse: Reuse::Suffixes, ..half }, 4, "pixels that share rare paths");
    let merging = RenderSettings { estimator: Estimator::Bidirectional, merging: true, reuse: Reuse::Off, ..half };
    let merged = assert_scatter(&pool, &merging, 8, "pixels that merge vertices of the same paths");
    for (what, correlated) in [("shared", shared), ("merged", merged)] {
        let standard_error = (correlated.variance / correlated.count).sqrt();
        assert!(correlated.mean - 1.1 > 4.0 * standard_error, "{what}: {} ± {standard_error}", correlated.mean);
    }
    let adaptive = RenderSettings { sampler: Sampler::Independent, adaptive: true, reuse: Reuse::Off, ..plates.settings };
    assert_scatter(&plates, &adaptive, 8, "samples spread by noise");
}

/// Measurements have shown where it pays: `docs/light-transport.md`, "Path reuse".
#[test]
fn paths_are_shared_where_that_pays() {
    let shares = |name: &str| {
        let scene = shipped(name);
        let settings = RenderSettings { reuse: Reuse::Auto, ..scene.settings };
        resolved(&scene, &scene.rays(&scene.camera), &settings).reuse
    };
    assert_eq!(["cornell_box", "cornell_spheres"].map(shares), [Reuse::Suffixes; 2]);
    assert_eq!(["glass_and_mirror", "sky_lit", "motion_blur"].map(shares), [Reuse::Outliers; 3]);
    assert_eq!(shares("room_window"), Reuse::Both);
    assert_eq!(["bright_sky", "shapes"].map(shares), [Reuse::Off; 2]);
    let scene = shipped("cornell_box");
    let said = |reuse| resolved(&scene, &scene.rays(&scene.camera), &RenderSettings { reuse, ..scene.settings }).reuse;
    assert_eq!([Reuse::Suffixes, Reuse::Off].map(said), [Reuse::Suffixes, Reuse::Off]);
}

/// Curves of two settings compare these settings, and not path reuse with none.
#[test]
fn path_reuse_is_decided_once_for_a_scene() {
    for (name, decision) in [("cornell_box", Reuse::Suffixes), ("sky_lit", Reuse::Outliers), ("bright_sky", Reuse::Off)] {
        let scene = shipped(name);
        let rays = scene.rays(&scene.camera);
        for estimator in Estimator::ALL {
            for sampler in Sampler::ALL {
                for max_bounces in [None, Some(2), Some(9)] {
                    let settings =
                        RenderSettings { estimator, sampler, max_bounces, reuse: Reuse::Auto, ..RenderSettings::default() };
                    let resolved = resolved(&scene, &rays, &settings);
                    // Light paths are shared by all pixels already.
                    let decision = if scene.traces_light_paths(&resolved) { Reuse::Off } else { decision };
                    assert_eq!(resolved.reuse, decision, "{name}: {settings:?}");
                }
            }
        }
    }
}
