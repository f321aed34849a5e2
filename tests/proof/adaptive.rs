//! Adaptive sampling: the same image with less noise.
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::{Floor, compare};
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Scene, load},
};

use crate::{
    path_reuse::ROOM,
    picture::{assert_all_within, scene, settings},
    statistics::Moments,
};

const SIDE: u32 = 96;
/// Side of the squares over which pixels are summed.
const SQUARE: usize = 16;

struct Picture {
    radiance: Vec<[f32; 3]>,
    samples: u64,
}

fn render(threads: &Threads, scene: &Scene, settings: &RenderSettings, spp: u32) -> Picture {
    let camera = Camera { resolution: [SIDE; 2], ..scene.camera };
    let mut film = Film::new(camera.resolution);
    threads.pass(PassJob { scene, rays: &scene.rays(&camera), settings }, &mut film, spp, &|| false);
    assert!(settings.adaptive || !film.is_adaptive());
    Picture { radiance: Frame::of_film(&film, 0, [SIDE; 2], [SIDE; 2]).radiance, samples: film.samples() }
}

/// Sums over squares of an image, per channel.
fn sums(picture: &Picture) -> Vec<f64> {
    let squares = SIDE as usize / SQUARE;
    let mut sums = vec![0.0; squares * squares * 3];
    for (i, radiance) in picture.radiance.iter().enumerate() {
        let (x, y) = (i % SIDE as usize / SQUARE, i / SIDE as usize / SQUARE);
        (0..3).for_each(|c| sums[(squares * y + x) * 3 + c] += f64::from(radiance[c]));
    }
    sums
}

/// A scene with little noise in most of the image.
fn plates() -> Scene {
    load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/veach_plates.toml").as_ref()).expect("a shipped scene compiles")
}

/// Short renders, in which a bias from the first samples would be largest.
#[test]
fn adaptive_samples_give_the_same_picture() {
    const RENDERS: u32 = 90;
    let threads = Threads::new(2, SimdLevel::best()).expect("two threads can be had");
    for (scene, sampler, what) in
        [(scene(ROOM), Sampler::Independent, "independent samples"), (plates(), Sampler::Sobol, "Sobol samples")]
    {
        let of = |adaptive, first: u32| {
            let mut values = vec![Vec::new(); (SIDE as usize / SQUARE).pow(2) * 3];
            for seed in first..first + RENDERS {
                let settings = RenderSettings { sampler, adaptive, seed, ..settings(Estimator::Mis) };
                let sums = sums(&render(&threads, &scene, &settings, 6));
                values.iter_mut().zip(sums).for_each(|(values, sum)| values.push(sum));
            }
            values
        };
        let deviation = |(a, b): (Vec<f64>, Vec<f64>)| {
            let (a, b) = (Moments::of(a), Moments::of(b));
            (a.mean - b.mean) / ((a.variance + b.variance) / f64::from(RENDERS)).sqrt().max(1e-9)
        };
        let deviations: Vec<f64> = of(false, 0).into_iter().zip(of(true, RENDERS)).map(deviation).collect();
        assert_all_within(&deviations, what);
    }
}

#[test]
fn adaptive_sampling_reduces_local_noise() {
    let plates = plates();
    let threads = Threads::new(2, SimdLevel::best()).expect("two threads can be had");
    let with = |adaptive, seed, spp| {
        let settings = RenderSettings { adaptive, seed, ..settings(Estimator::Mis) };
        render(&threads, &plates, &settings, spp)
    };
    let truth = with(false, 99, 1024).radiance;
    let of = |adaptive| {
        let pictures: Vec<Picture> = (0..4).map(|seed| with(adaptive, seed, 64)).collect();
        let error: f64 = pictures.iter().map(|picture| compare(&picture.radiance, &truth, Floor::DEFAULT).rel_mse).sum();
        (error, pictures.iter().map(|picture| picture.samples).sum::<u64>())
    };
    let ((uniform, budget), (adaptive, samples)) = (of(false), of(true));
    assert!(samples <= budget, "{samples} of {budget}");
    assert!(adaptive < 0.85 * uniform, "{adaptive} {uniform}");
}
