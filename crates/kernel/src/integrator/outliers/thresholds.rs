//! The radiance above which the samples of the pixels of a tile are bright.
use crate::integrator::slots::{BLOCK, BLOCKS, TILE};

/// Outliers are this many times as bright as is typical around their pixel. Twice as much and half as much are less efficient where
/// it was tried (`benches/LOG.md`).
const FACTOR: f32 = 8.0;
/// The brightest part of the samples of a block, which does not count as typical.
const OUTLIERS: f64 = 0.05;
/// Lower bound of a block's typical radiance, relative to the tile's.
const LEAST: f32 = 0.1;

/// Thresholds of r + g + b, for each pixel of a tile. They come from a pilot with a seed of its own.
pub struct Thresholds(Vec<f32>);

impl Thresholds {
    /// Those by a sample of each pixel, at row · [`TILE`] + column.
    pub fn of_pilot([width, height]: [u32; 2], radiance: &[[f32; 4]]) -> Self {
        let samples: Vec<f32> = radiance.iter().map(|sample| brightness(sample).unwrap_or(0.0)).collect();
        let places = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let mut blocks: [Vec<f32>; BLOCKS] = Default::default();
        places().for_each(|(x, y)| blocks[block_of(x, y)].push(samples[slot(x, y)]));
        blocks.iter_mut().for_each(|block| block.sort_unstable_by(f32::total_cmp));
        let mut all = blocks.concat();
        // A stable sort merges what is sorted already.
        all.sort_by(f32::total_cmp);
        let least = LEAST * typical(&all);
        let blocks = blocks.map(|block| typical(&block).max(least));
        let mut thresholds = vec![0.0; slot(0, height)];
        for (x, y) in places() {
            let around = median_around(&samples, [x, y], [width, height]);
            thresholds[slot(x, y)] = FACTOR * blocks[block_of(x, y)].max(around);
        }
        Thresholds(thresholds)
    }

    /// Sets one threshold for all pixels.
    #[cfg(test)]
    pub fn uniform(threshold: f32) -> Self {
        Thresholds(vec![threshold; (TILE * TILE) as usize])
    }

    /// The threshold of a pixel, given by its column and row in the tile.
    pub fn at(&self, [x, y]: [u32; 2]) -> f32 {
        self.0[slot(x, y)]
    }
}

fn slot(x: u32, y: u32) -> usize {
    (y * TILE + x) as usize
}

fn block_of(x: u32, y: u32) -> usize {
    (y / BLOCK * (TILE / BLOCK) + x / BLOCK) as usize
}

/// r + g + b of a valid sample.
pub fn brightness([r, g, b, _]: &[f32; 4]) -> Option<f32> {
    let is_valid = [r, g, b].iter().all(|x| x.is_finite() && **x >= 0.0);
    let sum = r + g + b;
    (is_valid && sum.is_finite()).then_some(sum)
}

/// The mean of all samples, which are sorted, but the brightest.
fn typical(samples: &[f32]) -> f32 {
    let kept = &samples[..samples.len() - (samples.len() as f64 * OUTLIERS) as usize];
    if kept.is_empty() { 0.0 } else { kept.iter().sum::<f32>() / kept.len() as f32 }
}

/// The median of the 3 × 3 pixels around one, or of those of them that are in the tile. Of an even number it is the larger one.
fn median_around(samples: &[f32], [x, y]: [u32; 2], [width, height]: [u32; 2]) -> f32 {
    let [columns, rows] = [(x, width), (y, height)].map(|(x, end)| x.saturating_sub(1)..end.min(x + 2));
    let row = |y: u32| &samples[slot(columns.start, y)..slot(columns.end, y)];
    if columns.len() == 3 && rows.len() == 3 {
        let [above, here, below] = [y - 1, y, y + 1].map(row);
        return median_of_columns([0, 1, 2].map(|x| [above[x], here[x], below[x]]));
    }
    let mut around: Vec<f32> = rows.flat_map(row).copied().collect();
    around.sort_unstable_by(f32::total_cmp);
    around[around.len() / 2]
}

/// The median of nine numbers: that of the largest of the least, the median of the medians, and the least of the largest of three columns.
fn median_of_columns(columns: [[f32; 3]; 3]) -> f32 {
    let [a, b, c] = columns.map(sorted);
    sorted([sorted([a[0], b[0], c[0]])[2], sorted([a[1], b[1], c[1]])[1], sorted([a[2], b[2], c[2]])[0]])[1]
}

fn sorted([a, b, c]: [f32; 3]) -> [f32; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), low.max(high.min(c)), high.max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of 1 with two outliers on the left, and a block of samples of 40 that is wider than three pixels on the right.
    fn pilot() -> Vec<[f32; 4]> {
        let mut radiance = vec![[1.0, 0.0, 0.0, 0.0]; (TILE * TILE) as usize];
        radiance[slot(2, 3)] = [900.0; 4];
        radiance[slot(5, 1)] = [f32::NAN; 4];
        (10..14).flat_map(|y| (20..24).map(move |x| (x, y))).for_each(|(x, y)| radiance[slot(x, y)] = [20.0, 20.0, 0.0, 0.0]);
        radiance
    }

    #[test]
    fn outliers_raise_no_threshold_and_bright_areas_do() {
        let thresholds = Thresholds::of_pilot([32, 20], &pilot());
        assert!([[2, 3], [1, 3], [5, 1]].iter().all(|place| thresholds.at(*place) < 8.1));
        assert_eq!([[21, 11], [22, 12]].map(|place| thresholds.at(place)), [320.0; 2]);
    }

    #[test]
    fn the_median_is_the_middle_of_the_samples_around_a_pixel() {
        let samples: Vec<f32> = (0..TILE * TILE).map(|at| (at.wrapping_mul(2_654_435_761) >> 20) as f32).collect();
        let size = [32, 20];
        for (x, y) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))) {
            let is_near = |(i, j): &(u32, u32)| i.abs_diff(x) < 2 && j.abs_diff(y) < 2;
            let places = (0..size[1]).flat_map(|j| (0..size[0]).map(move |i| (i, j)));
            let mut around: Vec<f32> = places.filter(is_near).map(|(i, j)| samples[slot(i, j)]).collect();
            around.sort_by(f32::total_cmp);
            assert_eq!(median_around(&samples, [x, y], size), around[around.len() / 2], "{x} {y}");
        }
    }

    #[test]
    fn a_black_block_has_a_part_of_the_mean_of_the_tile_and_a_black_tile_none() {
        let mut radiance = vec![[0.5, 0.5, 0.0, 0.0]; (TILE * TILE) as usize];
        (0..8).flat_map(|y| (0..8).map(move |x| (x, y))).for_each(|(x, y)| radiance[slot(x, y)] = [0.0; 4]);
        let threshold = Thresholds::of_pilot([32, 32], &radiance).at([1, 1]);
        assert!((0.7..0.8).contains(&threshold), "{threshold}");
        assert_eq!(Thresholds::of_pilot([32, 32], &[[0.0; 4]; 1024]).at([9, 9]), 0.0);
    }
}
