//! Samplers and warps: distributions against pdfs, strata, and coordinates that do not depend on the order of evaluation.

use super::{Dimension, Directions, Sampler, Stream, warp};
use crate::chi_squared::chi_squared;
use noisefall_base::math::{F, One, U, colour};

/// Every test statistic here must have at least this probability; seeds are fixed.
const SIGNIFICANCE: f64 = 1e-4;

fn stream(sampler: Sampler, seed: u32, pixel: u32, index: u32) -> Stream<One> {
    Stream::new(sampler, seed, U(pixel), U(index))
}

fn point(sampler: Sampler, pixel: u32, index: u32, dimension: Dimension) -> [f64; 2] {
    let (x, y) = stream(sampler, 7, pixel, index).two(dimension);
    [x.0.into(), y.0.into()]
}

#[test]
fn the_camera_and_three_surfaces_are_near() {
    assert!(Dimension::TIME.is_near() && Dimension::direction(3).is_near());
    assert!(!Dimension::direction(4).is_near());
}

/// Behind a wall through the normal, which hides half of the sky, exactly one of the two sees the sky.
#[test]
fn opposite_points_are_as_even_as_the_points_and_on_opposite_sides_of_the_normal() {
    for index in 0..100_000 {
        let u = stream(Sampler::Independent, 1, index / 1000, index % 1000).two(Dimension::direction(1));
        let opposite = warp::opposite(u);
        assert_eq!([warp::opposite(opposite).0.0, warp::opposite(opposite).1.0], [u.0.0, u.1.0]);
        assert!([opposite.0.0, opposite.1.0].iter().all(|x| *x > 0.0 && *x < 1.0 && *x != 0.5));
        let [a, b] = [u, opposite].map(warp::cosine_hemisphere);
        assert!((a.x * b.x).0 < 0.0 && (a.y * b.y).0 < 0.0, "{index}");
    }
}

#[test]
fn directions_are_distributed_as_their_pdf() {
    const ACROSS: usize = 16;
    const AROUND: usize = 16;
    const SAMPLES: u32 = 400_000;
    for directions in Directions::ALL {
        let mut counts = vec![0.0; ACROSS * AROUND];
        for index in 0..SAMPLES {
            let u = stream(Sampler::Independent, 1, index / 1000, index % 1000).two(Dimension::direction(1));
            let d = directions.sample(u);
            let (x, y, z) = (f64::from(d.x.0), f64::from(d.y.0), f64::from(d.z.0));
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-6 && z > 0.0);
            let turn = y.atan2(x) / std::f64::consts::TAU + 0.5;
            let across = ((z * ACROSS as f64) as usize).min(ACROSS - 1);
            counts[across * AROUND + ((turn * AROUND as f64) as usize).min(AROUND - 1)] += 1.0;
        }
        let expected: Vec<f64> =
            (0..ACROSS * AROUND).map(|bin| f64::from(SAMPLES) * probability(directions, bin / AROUND, ACROSS, AROUND)).collect();
        let p = chi_squared(&counts, &expected);
        assert!(p > SIGNIFICANCE, "{directions:?}: p = {p}");
    }
}

/// The pdf integrated over one of `across` × `around` bins of equal height; dω = dz dφ.
fn probability(directions: Directions, bin: usize, across: usize, around: usize) -> f64 {
    const STEPS: usize = 64;
    let width = 1.0 / across as f64;
    let at = |step: usize| (bin as f64 + (step as f64 + 0.5) / STEPS as f64) * width;
    let mean = (0..STEPS).map(|step| f64::from(directions.pdf(F::<One>(at(step) as f32)).0)).sum::<f64>() / STEPS as f64;
    mean * width * std::f64::consts::TAU / around as f64
}

#[test]
fn pdfs_of_directions_integrate_to_one() {
    for directions in Directions::ALL {
        let whole: f64 = (0..256).map(|bin| probability(directions, bin, 256, 1)).sum();
        assert!((whole - 1.0).abs() < 1e-6, "{directions:?}: {whole}");
    }
}

#[test]
fn the_weight_of_a_direction_is_cos_over_pi_times_pdf() {
    for directions in Directions::ALL {
        for i in 1..=100 {
            let cos = F::<One>(i as f32 / 100.0);
            let expected = cos.0 / (std::f32::consts::PI * directions.pdf(cos).0);
            assert!((directions.lambertian_weight(cos).0 - expected).abs() < 1e-6);
        }
    }
}

#[test]
fn every_sampler_is_uniform_in_every_dimension() {
    const BINS: usize = 64;
    const PIXELS: u32 = 4096;
    for sampler in Sampler::ALL {
        for dimension in [Dimension::PIXEL, Dimension::direction(1), Dimension::direction(9)] {
            let (mut pairs, mut single) = (vec![0.0; BINS], vec![0.0; BINS]);
            for pixel in 0..PIXELS {
                // One sample a pixel: samples of one pixel are not independent, and chi² is for independent ones.
                let [x, y] = point(sampler, pixel, pixel % 13, dimension);
                pairs[(x * 8.0) as usize * 8 + (y * 8.0) as usize] += 1.0;
                let u = stream(sampler, 7, pixel, pixel % 13).one(Dimension::roulette(2));
                single[(u.0 * BINS as f32) as usize] += 1.0;
            }
            let expected = vec![f64::from(PIXELS) / BINS as f64; BINS];
            let p = chi_squared(&pairs, &expected).min(chi_squared(&single, &expected));
            assert!(p > SIGNIFICANCE, "{} in {dimension:?}: p = {p}", sampler.name());
        }
    }
}

/// Every coordinate that a path reads up to its third surface.
fn coordinates() -> Vec<(Dimension, usize)> {
    let camera = [(Dimension::PIXEL, 2), (Dimension::LENS, 2), (Dimension::TIME, 1)];
    let surface = |bounce| {
        [
            (Dimension::direction(bounce), 2),
            (Dimension::roulette(bounce), 1),
            (Dimension::lobe(bounce), 1),
            (Dimension::light_choice(bounce), 1),
            (Dimension::light(bounce), 2),
            (Dimension::cell(bounce), 2),
        ]
    };
    camera.into_iter().chain((1..=3).flat_map(surface)).collect()
}

#[test]
fn no_two_coordinates_of_a_sample_are_correlated() {
    const SAMPLES: u32 = 8192;
    const CELLS: usize = 4;
    let columns = |sampler: Sampler| -> Vec<(String, Vec<u8>)> {
        let column = |dimension: Dimension, width: usize, axis: usize| {
            let value = |index: u32| {
                let stream = stream(sampler, 7, index / 16, index % 16);
                let (x, y) = if width == 1 { (stream.one(dimension), F(0.0)) } else { stream.two(dimension) };
                ([x.0, y.0][axis] * CELLS as f32) as u8
            };
            (format!("{dimension:?}.{axis}"), (0..SAMPLES).map(value).collect())
        };
        coordinates()
            .into_iter()
            .flat_map(|(dimension, width)| (0..width).map(move |axis| column(dimension, width, axis)))
            .collect()
    };
    for sampler in Sampler::ALL {
        let columns = columns(sampler);
        let pairs = columns.len() * (columns.len() - 1) / 2 * Sampler::ALL.len();
        for (i, (a, of_a)) in columns.iter().enumerate() {
            for (b, of_b) in &columns[i + 1..] {
                let mut counts = vec![0.0; CELLS * CELLS];
                of_a.iter().zip(of_b).for_each(|(x, y)| counts[usize::from(*x) * CELLS + usize::from(*y)] += 1.0);
                let p = chi_squared(&counts, &vec![f64::from(SAMPLES) / counts.len() as f64; counts.len()]);
                assert!(p > SIGNIFICANCE / pairs as f64, "{}, {a} and {b}: p = {p}", sampler.name());
            }
        }
    }
}

#[test]
fn a_pixel_revisited_out_of_order_has_the_same_numbers() {
    for sampler in Sampler::ALL {
        let visit = |index: u32| point(sampler, 77, index, Dimension::direction(3)).map(f64::to_bits);
        let forwards: Vec<_> = (0..1000).map(visit).collect();
        let mut backwards: Vec<_> = (0..1000).rev().map(visit).collect();
        backwards.reverse();
        assert_eq!(forwards, backwards);
        assert!(forwards.windows(2).all(|pair| pair[0] != pair[1]), "{} repeats itself", sampler.name());
    }
}

#[test]
fn another_seed_or_pixel_gives_other_numbers() {
    for sampler in Sampler::ALL {
        let at = |seed, pixel| stream(sampler, seed, pixel, 5).one(Dimension::roulette(1)).0;
        assert_ne!(at(0, 0), at(1, 0));
        assert_ne!(at(0, 0), at(0, 1));
    }
}

/// Whether 2^(across + down) points lie one each in the cells of a grid of 2^across × 2^down.
fn one_in_each_cell(points: &[[f64; 2]], across: u32, down: u32) -> bool {
    let mut seen = vec![false; 1 << (across + down)];
    points.iter().all(|[x, y]| {
        let cell = ((x * f64::from(1 << across)) as usize) << down | (y * f64::from(1 << down)) as usize;
        !std::mem::replace(&mut seen[cell], true)
    })
}

#[test]
fn sobol_points_have_one_in_every_elementary_interval_far_beyond_two_to_the_sixteenth() {
    for pixel in 0..8 {
        for log_count in 1..=10 {
            // The last block is as late as a block can be.
            for first in [0u32, 3 << 10, 1 << 17, 1 << 25, u32::MAX - ((1 << 10) - 1)] {
                let points: Vec<_> = (0..1u32 << log_count)
                    .map(|i| point(Sampler::Sobol, pixel, first + i, Dimension::direction(pixel)))
                    .collect();
                for across in 0..=log_count {
                    assert!(one_in_each_cell(&points, across, log_count - across), "{pixel} {log_count} {first} {across}");
                }
            }
        }
    }
}

#[test]
fn blue_noise_has_all_strata_of_sobol_points() {
    for pixel in 0..8 {
        for dimension in [Dimension::PIXEL, Dimension::light(1), Dimension::direction(1), Dimension::direction(2)] {
            let points: Vec<_> = (0..256).map(|i| point(Sampler::BlueNoise, pixel, 512 + i, dimension)).collect();
            for across in 0..=8 {
                assert!(one_in_each_cell(&points, across, 8 - across), "{pixel} {dimension:?} {across}");
            }
        }
    }
}

/// Every coordinate of a pixel is that of Sobol points after an exclusive or, which is the same for all its samples.
#[test]
fn blue_noise_shifts_each_coordinate_of_sobol_points() {
    // Fewer bits than f32 keeps.
    let bits = |sampler, pixel, index, dimension| point(sampler, pixel, index, dimension).map(|x| (x * 65536.0) as u32);
    for dimension in [Dimension::PIXEL, Dimension::direction(1), Dimension::direction(9)] {
        for pixel in [0, 77, 5 << 16 | 3] {
            let shift = |index: u32| {
                let [[a, b], [c, d]] = [Sampler::BlueNoise, Sampler::Sobol].map(|sampler| bits(sampler, pixel, index, dimension));
                [a ^ c, b ^ d]
            };
            assert!((1..64).all(|index| shift(index) == shift(0)), "{dimension:?} of pixel {pixel}");
        }
    }
}

/// Variance of the mean of smooth integrands over blocks of 4 × 4 pixels at one sample per pixel, relative to independent
/// samples.
fn variance_of_blocks(sampler: Sampler, dimension: Dimension) -> f64 {
    const BLOCKS: u32 = 32;
    const SIDE: u32 = 4;
    let integrand = |[x, y]: [f64; 2]| (x - 0.3).powi(2) + 0.7 * x * y + (2.0 * y).sin();
    let value = |x: u32, y: u32| integrand(point(sampler, y << 16 | x, 0, dimension));
    let moments = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64
    };
    let all: Vec<f64> = (0..BLOCKS * SIDE).flat_map(|y| (0..BLOCKS * SIDE).map(move |x| value(x, y))).collect();
    let at = |x: u32, y: u32| all[(y * BLOCKS * SIDE + x) as usize];
    let block = |i: u32| {
        let [x, y] = [i % BLOCKS * SIDE, i / BLOCKS * SIDE];
        (0..SIDE * SIDE).map(|j| at(x + j % SIDE, y + j / SIDE)).sum::<f64>() / f64::from(SIDE * SIDE)
    };
    let blocks: Vec<f64> = (0..BLOCKS * BLOCKS).map(block).collect();
    moments(&blocks) / (moments(&all) / f64::from(SIDE * SIDE))
}

#[test]
fn one_sample_a_pixel_has_little_error_at_low_frequencies_with_blue_noise_and_white_noise_without() {
    for dimension in [Dimension::PIXEL, Dimension::LENS, Dimension::light(1), Dimension::direction(1)] {
        // The variance of 1024 block means is known to 4.4 %: 4σ.
        assert!((variance_of_blocks(Sampler::Sobol, dimension) - 1.0).abs() < 0.18);
        let blue = variance_of_blocks(Sampler::BlueNoise, dimension);
        println!("{dimension:?}: {blue:.3}");
        assert!(blue < 0.1, "{dimension:?}: {blue}");
    }
}

#[test]
fn stratified_points_have_one_in_every_cell_of_every_grid() {
    for pixel in 0..8 {
        // The last one has more samples than half of their bits can count.
        for (level, blocks) in (1..=6).map(|level| (level, &[0u32, 1, 7, 12345][..])).chain([(9, &[1][..])]) {
            for &block in blocks {
                let first = block << (2 * level);
                let points: Vec<_> =
                    (0..1u32 << (2 * level)).map(|i| point(Sampler::Stratified, pixel, first + i, Dimension::PIXEL)).collect();
                assert!(one_in_each_cell(&points, level, level), "{pixel} {level} {block}");
            }
        }
    }
}

#[test]
fn luminance_weights_sum_to_one() {
    assert!((colour::luminance([1.0; 3]) - 1.0).abs() < 1e-6);
}
