//! Half images and denoised images.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{add, red};
use crate::render::{
    Frame,
    denoise::{denoised, steps},
    film::Film,
    halves::Halves,
};
use noisefall_kernel::measure::SampleNoise;

const SIZE: usize = 48;

/// Noise of the two halves of an image, uniform from −`noise` to `noise`, and of known variance.
fn noisy(truth: &[[f32; 3]], noise: f32, seed: u64) -> Frame {
    let mut random = SmallRng::seed_from_u64(seed);
    let mut half = || -> Vec<[f32; 3]> {
        truth.iter().map(|pixel| pixel.map(|c| c + noise * (2.0 * random.random::<f32>() - 1.0))).collect()
    };
    let means = [half(), half()];
    let radiance = means[0].iter().zip(&means[1]).map(|(a, b)| [0, 1, 2].map(|c| 0.5 * (a[c] + b[c]))).collect();
    // A uniform distribution of width 2a has the variance a²/3; the mean of two has half of that.
    let variance = vec![[noise * noise / 6.0; 3]; truth.len()];
    let noise = SampleNoise { width: SIZE as u32, variance, ..SampleNoise::default() };
    let size = [SIZE as u32, (truth.len() / SIZE) as u32];
    let halves = Some(Halves { means, shares: vec![0.5; truth.len()] });
    Frame { width: size[0], height: size[1], full_resolution: size, radiance, halves, noise: Some(noise), ..Frame::default() }
}

/// A ramp, with a step of height 2 in its middle.
fn truth() -> Vec<[f32; 3]> {
    let pixel = |x: usize, y: usize| 0.5 + 0.2 * y as f32 / SIZE as f32 + if x < SIZE / 2 { 0.0 } else { 2.0 };
    (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| [pixel(x, y), 0.5 * pixel(x, y), 1.0])).collect()
}

fn mse(image: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let squares = image.as_flattened().iter().zip(truth.as_flattened()).map(|(a, b)| f64::from(a - b).powi(2));
    squares.sum::<f64>() / (3 * truth.len()) as f64
}

#[test]
fn a_constant_image_stays() {
    let truth = vec![[0.25, 0.5, 1.0]; SIZE * 20];
    let found = denoised(&noisy(&truth, 0.0, 1), &|| false).expect("it has halves");
    assert!(found.as_flattened().iter().zip(truth.as_flattened()).all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn noise_falls_and_edges_stay() {
    let truth = truth();
    for seed in [7, 8] {
        let frame = noisy(&truth, 0.3, seed);
        let found = denoised(&frame, &|| false).expect("it has halves");
        let [before, after] = [mse(&frame.radiance, &truth), mse(&found, &truth)];
        assert!(after < 0.2 * before, "seed {seed}: {before} to {after}");
        // The means of the columns on both sides of the step differ by the step.
        let column = |x: usize| (0..SIZE).map(|y| found[y * SIZE + x][0]).sum::<f32>() / SIZE as f32;
        assert!((column(SIZE / 2) - column(SIZE / 2 - 1) - 2.0).abs() < 0.1, "seed {seed}");
    }
    let exact = denoised(&noisy(&truth, 0.0, 1), &|| false).expect("it has halves");
    assert!(mse(&exact, &truth) < 1e-4, "without noise hardly anything is smoothed");
}

#[test]
fn the_steps_of_denoising_are_known_before() {
    let frame = noisy(&vec![[0.5; 3]; SIZE * SIZE], 0.1, 1);
    let asked = std::sync::atomic::AtomicUsize::new(0);
    let count = || asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == usize::MAX;
    assert!(denoised(&frame, &count).is_some());
    assert_eq!(asked.into_inner(), steps([frame.width, frame.height]));
}

#[test]
fn cancelled_images_and_those_without_halves_are_not_denoised() {
    let frame = noisy(&truth(), 0.3, 7);
    assert!(denoised(&frame, &|| true).is_none());
    assert!(denoised(&Frame { halves: None, ..frame }, &|| false).is_none());
}

#[test]
fn halves_are_means_of_samples_of_their_own() {
    let mut film = Film::new([3, 2]);
    let mean = |x: u32, y: u32, samples: std::ops::Range<u32>| {
        let count = samples.len() as f32;
        samples.map(|sample| red(x, y, sample)).sum::<f32>() / count
    };
    // The first half ends at a power of two.
    for (spp, first) in
        [(1, None), (2, Some(1)), (3, Some(2)), (4, Some(2)), (5, Some(2)), (6, Some(4)), (7, Some(4)), (8, Some(4))]
    {
        let before = film.tiles[0].spp;
        add(&mut film.tiles[0], before..spp);
        film.tiles[0].double(1.0);
        let halves = Halves::of_film(&film);
        assert_eq!(halves.is_some(), first.is_some(), "{spp}");
        let (Some(halves), Some(first)) = (halves, first) else { continue };
        for (pixel, (x, y)) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)].into_iter().enumerate() {
            let [a, b] = [0, 1].map(|half| halves.means[half][pixel][0]);
            let exact = [mean(x, y, 0..first), mean(x, y, first..spp)];
            assert!((a - exact[0]).abs() < 1e-3 && (b - exact[1]).abs() < 1e-3, "{spp} samples: {a} {b}, exact {exact:?}");
            assert!((halves.shares[pixel] - first as f32 / spp as f32).abs() < 1e-6);
        }
    }
}
