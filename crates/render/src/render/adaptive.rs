//! Adaptive sampling: more samples where there is more noise, according to a pilot whose samples are discarded.
//!
//! A block of pixels with relative variance V and time c per sample should have samples in proportion to √(V/c). If V were
//! estimated from the samples of the image itself, pixels with dark first samples would get fewer samples, and the mean would be
//! biased (D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991). A pilot with other random
//! numbers makes sample counts independent of the samples.
use rayon::prelude::*;

use super::{
    film::Film,
    threads::{PassJob, Threads},
    tile::Tile,
};
use noisefall_kernel::{
    integrator::{BLOCK, Interrupted, Segments, TILE, Work},
    measure::{Floor, relative},
};
use noisefall_scene::{sampling::Sampler, scene::RenderSettings};

/// Exponents of the minimum and maximum rate, to base two.
pub(super) const RATES: [i32; 2] = [-2, 4];
/// Width and height of the squares from which the pilot estimates noise; four make up a block.
const SQUARE: u32 = BLOCK / 2;
/// Minimum noise of a block relative to the average, because a pilot may miss it.
const LEAST: f64 = 0.05;
/// Derives the pilot's seed from that of the image.
const PILOT: u32 = 0x51ed_270b;

/// Noise and cost of the blocks of an image, row by row.
struct Pilot {
    columns: usize,
    /// Relative variances of a sample, from two halves of the pilot.
    noise: [Vec<f64>; 2],
    /// Cost of a sample, in path segments.
    cost: Vec<f64>,
}

/// Enables adaptive sampling of a film, if the settings ask for it and the pilot does not advise against it.
pub(super) fn spread(
    threads: &Threads,
    job: PassJob,
    film: &mut Film,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<(), Interrupted> {
    if film.is_piloted
        || !job.settings.adaptive
        || job.scene.path_reuse(job.rays, job.settings).correlates()
        || job.scene.traces_light_paths(job.settings)
    {
        return Ok(());
    }
    let pilot = pilot(threads, job, film, interrupted)?;
    let smoothed = [1, 2, 4].map(|width| pilot.noise.each_ref().map(|noise| smooth(noise, pilot.columns, width)));
    let gains = smoothed.each_ref().map(|noise| pilot.gain_by(noise));
    let best = (0..3).max_by(|&a, &b| gains[a].total_cmp(&gains[b])).unwrap_or(0);
    film.is_piloted = true;
    if gains[best] < 1.0 {
        return Ok(());
    }
    let [a, b] = &smoothed[best];
    let noise: Vec<f64> = a.iter().zip(b).map(|(a, b)| a + b).collect();
    let rates = rates(&pilot.needs(&noise));
    let columns = pilot.columns;
    for tile in &mut film.tiles {
        let at = tile.origin.map(|x| (x / BLOCK) as usize);
        let wide = tile.size[0].div_ceil(BLOCK) as usize;
        for (i, block) in tile.blocks.iter_mut().enumerate() {
            block.rate = rates[(at[1] + i / wide) * columns + at[0] + i % wide];
        }
    }
    Ok(())
}

/// Traces one sample of every pixel.
fn pilot(threads: &Threads, job: PassJob, film: &Film, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<Pilot, Interrupted> {
    let PassJob { scene, rays, settings } = job;
    let settings = RenderSettings { sampler: Sampler::Independent, seed: settings.seed ^ PILOT, ..*settings };
    let of_tile = |tile: &Tile| {
        let work = Work::tile(scene, rays, &settings, tile.origin, tile.size, 0);
        threads.trace_counting(&work, interrupted, |radiance, segments| {
            let of_block = |block| (squares_of_block(tile, block, radiance), cost_of_block(tile, block, &segments));
            (0..tile.blocks.len()).map(of_block).collect::<Vec<_>>()
        })
    };
    let tiles = threads.install(|| film.tiles.par_iter().map(of_tile).collect::<Result<Vec<_>, _>>())?;
    let squares = tiles.iter().flatten().flat_map(|(squares, _)| squares);
    let (sum, count) =
        squares.fold((0.0, 0.0), |(sum, count), square| (sum + square.n * square.square_of_mean(), count + square.n));
    let floor = Floor::DEFAULT.of(sum / (3.0 * f64::max(count, 1.0)));
    let columns = film.resolution[0].div_ceil(BLOCK) as usize;
    let none = vec![0.0; columns * film.resolution[1].div_ceil(BLOCK) as usize];
    let mut pilot = Pilot { columns, noise: [none.clone(), none.clone()], cost: none };
    for (tile, blocks) in film.tiles.iter().zip(tiles) {
        for (i, ([a, b, c, d], cost)) in blocks.into_iter().enumerate() {
            let [x, y] = tile.area().corner(i).map(|x| (x / BLOCK) as usize);
            let place = y * columns + x;
            // Two pairs of squares that lie across from each other.
            let noise = [[a, d], [b, c]].map(|pair| pair.iter().map(|square| square.relative_variance(floor)).sum());
            (0..2).for_each(|half| pilot.noise[half][place] = noise[half]);
            pilot.cost[place] = cost;
        }
    }
    Ok(pilot)
}

/// Path segments of a pixel.
fn cost_of_block(tile: &Tile, block: usize, segments: &Segments) -> f64 {
    /// Cost of generating the camera ray and of adding to the film.
    const BESIDES: f64 = 0.5;
    let [column, row] = tile.area().place(block).map(|x| x / BLOCK);
    BESIDES + f64::from(segments.0[(row * TILE / BLOCK + column) as usize]) / tile.area().block_pixels(block) as f64
}

/// The four squares of a block, row by row. `radiance` is indexed by row · [`TILE`] + column of the tile.
fn squares_of_block(tile: &Tile, block: usize, radiance: &[[f32; 4]]) -> [Square; 4] {
    let [left, top] = tile.area().place(block);
    let square = |x: u32, y: u32| {
        let [left, top] = [left + x * SQUARE, top + y * SQUARE];
        let rows = top..(top + SQUARE).min(tile.size[1]);
        let columns = left..(left + SQUARE).min(tile.size[0]);
        let slots = rows.flat_map(|row| columns.clone().map(move |column| (row * TILE + column) as usize));
        Square::of(slots.map(|slot| radiance[slot]))
    };
    [square(0, 0), square(1, 0), square(0, 1), square(1, 1)]
}

/// One sample of each pixel of a square.
#[derive(Default)]
struct Square {
    n: f64,
    mean: [f64; 3],
    variance: [f64; 3],
}

impl Square {
    fn of(samples: impl Iterator<Item = [f32; 4]>) -> Square {
        let (mut n, mut sums, mut squares) = (0.0, [0.0; 3], [0.0; 3]);
        for sample in samples.filter(|sample| sample[..3].iter().all(|x| (0.0..1e18).contains(x))) {
            n += 1.0;
            for channel in 0..3 {
                let x = f64::from(sample[channel]);
                sums[channel] += x;
                squares[channel] += x * x;
            }
        }
        if n < 2.0 {
            return Square::default();
        }
        let mean = sums.map(|sum: f64| sum / n);
        let variance = |channel: usize| (squares[channel] - mean[channel] * sums[channel]).max(0.0) / (n - 1.0);
        Square { n, mean, variance: [0, 1, 2].map(variance) }
    }

    /// The squared mean, summed over the channels; the mean is less noisy than the samples.
    fn square_of_mean(&self) -> f64 {
        self.mean.iter().map(|mean| mean * mean).sum()
    }

    /// The variance of a sample over the squared mean with the floor of relMSE, summed over the channels.
    fn relative_variance(&self, floor: f64) -> f64 {
        self.mean.iter().zip(self.variance).map(|(mean, variance)| relative(variance, *mean, floor)).sum()
    }
}

/// Averages over squares of `width` × `width` blocks.
fn smooth(noise: &[f64], columns: usize, width: usize) -> Vec<f64> {
    let rows = noise.len() / columns;
    let mut smooth = vec![0.0; noise.len()];
    for (top, left) in (0..rows).step_by(width).flat_map(|y| (0..columns).step_by(width).map(move |x| (y, x))) {
        let square =
            (top..(top + width).min(rows)).flat_map(|y| (left..(left + width).min(columns)).map(move |x| y * columns + x));
        let square: Vec<usize> = square.collect();
        let mean = square.iter().map(|&place| noise[place]).sum::<f64>() / square.len() as f64;
        square.iter().for_each(|&place| smooth[place] = mean);
    }
    smooth
}

impl Pilot {
    /// The factor by which relMSE × time falls if one half of the pilot distributes samples, evaluated with the noise of the
    /// other half.
    fn gain_by(&self, smoothed: &[Vec<f64>; 2]) -> f64 {
        let gain = |half: usize| {
            let (needs, noise) = (self.needs(&smoothed[half]), &self.noise[1 - half]);
            let after: f64 = noise.iter().zip(&needs).map(|(noise, need)| noise / need).sum();
            let time: f64 = self.cost.iter().zip(&needs).map(|(cost, need)| cost * need).sum();
            let before = noise.iter().sum::<f64>() * self.cost.iter().sum::<f64>();
            if after > 0.0 { before / (after * time) } else { 1.0 }
        };
        (gain(0) * gain(1)).sqrt()
    }

    /// Values proportional to the ideal sample counts of blocks with this noise.
    fn needs(&self, noise: &[f64]) -> Vec<f64> {
        let least = LEAST * noise.iter().sum::<f64>() / noise.len() as f64;
        noise.iter().zip(&self.cost).map(|(noise, cost)| ((noise + least) / cost).sqrt().max(f64::MIN_POSITIVE)).collect()
    }
}

/// Powers of two in proportion to `needs`, with an average of at most 1. Sobol points are best at powers of two.
fn rates(needs: &[f64]) -> Vec<i8> {
    let [lowest, highest] = RATES.map(f64::from);
    let at = |scale: f64| needs.iter().map(move |need| (need.log2() + scale).round().clamp(lowest, highest));
    let average = needs.iter().sum::<f64>() / needs.len() as f64;
    // Halving finds the largest scale; at the lowest one all rates are the lowest.
    let (mut low, mut high) = (-average.log2() + 2.0 * lowest, -average.log2() + 2.0 * highest);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        let mean = at(middle).map(f64::exp2).sum::<f64>() / needs.len() as f64;
        if mean > 1.0 { high = middle } else { low = middle }
    }
    at(low).map(|rate| rate as i8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_follow_the_needs_and_cost_no_more_than_one_sample_a_pixel() {
        let needs: Vec<f64> = (0..400).map(|i| 2f64.powf(f64::from(i % 7) * 0.9)).collect();
        let rates = rates(&needs);
        let mean = rates.iter().map(|rate| f64::from(*rate).exp2()).sum::<f64>() / 400.0;
        assert!((0.8..=1.0).contains(&mean), "{mean}");
        assert!(needs.iter().zip(&rates).all(|(a, rate)| needs.iter().zip(&rates).all(|(b, other)| a > b || rate <= other)));
    }

    #[test]
    fn one_noisy_quarter_gains_and_noise_alone_does_not() {
        let gain = |values: [fn(usize) -> f64; 2], cost: fn(usize) -> f64| {
            let noise = values.map(|value| (0..64).map(value).collect::<Vec<f64>>());
            let pilot = Pilot { columns: 8, noise: noise.clone(), cost: (0..64).map(cost).collect() };
            pilot.gain_by(&noise)
        };
        let quarter: [fn(usize) -> f64; 2] = [|i| if i < 16 { 100.0 } else { 1.0 }; 2];
        assert!(gain(quarter, |_| 1.0) > 2.0);
        // Noise that costs as much as it is.
        assert!(gain(quarter, |i| if i < 16 { 100.0 } else { 1.0 }) < 1.1);
        let chance: [fn(usize) -> f64; 2] = [|i| if i % 5 == 0 { 100.0 } else { 1.0 }, |i| if i % 7 == 1 { 100.0 } else { 1.0 }];
        assert!(gain(chance, |_| 1.0) < 1.0);
    }

    #[test]
    fn a_block_costs_the_segments_of_its_own_pixels() {
        // Its blocks are three in a row, the last one 3 pixels wide, and of the second row 5 high.
        let tile = Tile::new([64, 32], [19, 13]);
        let mut segments = Segments::default();
        (segments.0[1], segments.0[4], segments.0[6]) = (64, 80, 45);
        assert_eq!([0, 1, 3, 5].map(|block| cost_of_block(&tile, block, &segments)), [0.5, 1.5, 2.5, 3.5]);
    }

    fn square(values: &[f32]) -> Square {
        Square::of(values.iter().map(|x| [*x, 2.0, 0.0, 0.0]))
    }

    #[test]
    fn squares_have_the_mean_and_variance_of_valid_samples() {
        let four = square(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!((four.n, four.mean, four.variance), (4.0, [2.5, 2.0, 0.0], [5.0 / 3.0, 0.0, 0.0]));
        assert_eq!(four.square_of_mean(), 6.25 + 4.0);
        assert!((four.relative_variance(0.75) - 5.0 / 3.0 / 7.0).abs() < 1e-12);
        let odd = square(&[1.0, f32::NAN, -1.0, f32::INFINITY, 1e19, 3.0]);
        assert_eq!((odd.n, odd.mean[0], odd.variance[0]), (2.0, 2.0, 2.0));
        assert_eq!((square(&[5.0]).n, square(&[5.0]).mean), (0.0, [0.0; 3]), "one sample says nothing of noise");
    }

    #[test]
    fn the_squares_of_a_block_are_quarters_of_its_own_pixels() {
        // Its last block is 3 pixels wide and 5 high.
        let tile = Tile::new([64, 32], [19, 13]);
        let radiance: Vec<[f32; 4]> =
            (0..TILE * TILE).map(|slot| [(slot % TILE + 100 * (slot / TILE)) as f32, 0.0, 0.0, 0.0]).collect();
        let squares = |block: usize| squares_of_block(&tile, block, &radiance).map(|square| (square.n, square.mean[0]));
        assert_eq!(squares(1), [(16.0, 159.5), (16.0, 163.5), (16.0, 559.5), (16.0, 563.5)]);
        assert_eq!(squares(5), [(12.0, 967.0), (0.0, 0.0), (3.0, 1217.0), (0.0, 0.0)]);
    }

    #[test]
    fn noise_is_smoothed_over_squares_of_blocks() {
        let noise: Vec<f64> = (1..10).map(f64::from).collect();
        assert_eq!(smooth(&noise, 3, 1), noise);
        assert_eq!(smooth(&noise, 3, 2), [3.0, 3.0, 4.5, 3.0, 3.0, 4.5, 7.5, 7.5, 9.0]);
    }

    #[test]
    fn one_half_places_samples_and_the_other_measures_the_gain() {
        let noise = [vec![3.0, 1.0], vec![1.0, 3.0]];
        let pilot = Pilot { columns: 2, noise: noise.clone(), cost: vec![1.0, 4.0] };
        // A twentieth of the mean noise, 2, is added.
        assert_eq!(pilot.needs(&noise[0]), [3.1f64.sqrt(), (1.1f64 / 4.0).sqrt()]);
        let gain = |a: f64, b: f64, noise: [f64; 2]| {
            let (a, b) = (a.sqrt(), (b / 4.0).sqrt());
            4.0 * 5.0 / ((noise[0] / a + noise[1] / b) * (a + 4.0 * b))
        };
        let exact = (gain(3.1, 1.1, [1.0, 3.0]) * gain(1.1, 3.1, [3.0, 1.0])).sqrt();
        assert!((pilot.gain_by(&noise) / exact - 1.0).abs() < 1e-12, "{} {exact}", pilot.gain_by(&noise));
    }

    #[test]
    fn no_block_has_more_than_sixteen_or_less_than_a_quarter_of_the_average() {
        let with = |need: f64| [vec![1.0; 63], vec![need]].concat();
        assert_eq!(rates(&with(100.0)), [vec![-1; 63], vec![4]].concat());
        assert_eq!(rates(&with(1e-6)), [vec![0; 63], vec![-2]].concat());
    }
}
