//! Exact means of an image over the unit square.
use super::words::{TexelFilter, Wrap};

/// One axis of an image: what continues it, how it is interpolated, and its number of texels.
#[derive(Clone, Copy)]
pub struct Axis {
    /// Continuation of the image beyond its edges.
    pub wrap: Wrap,
    /// Interpolation between texels.
    pub filter: TexelFilter,
    /// Number of texels.
    pub size: u32,
}

impl Axis {
    /// The mean weight of each texel over an interval of coordinates.
    pub fn weights(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        /// A point counts as an interval of this many texels.
        const LEAST: f64 = 1e-6;
        let size = f64::from(self.size);
        let low = from.min(to) * size;
        let length = ((to - from).abs() * size).max(LEAST);
        let mut weights = vec![0.0; self.size as usize];
        let [low, high] = match self.wrap {
            Wrap::Repeat => self.without_periods([low, length], size, &mut weights),
            Wrap::Mirror => self.without_periods([low, length], 2.0 * size, &mut weights),
            Wrap::Clamp | Wrap::Black => self.near_image([low, low + length], &mut weights),
        };
        // A texel reaches no farther than one beyond its edges.
        for texel in (low.floor() as i64 - 1)..=(high.floor() as i64 + 1) {
            if let Some(index) = self.index(texel) {
                weights[index] += self.integral(high - texel as f64) - self.integral(low - texel as f64);
            }
        }
        weights.iter_mut().for_each(|weight| *weight /= length);
        weights
    }

    /// Adds whole periods to the weights, in which all texels count alike. Returns the rest of the interval.
    fn without_periods(&self, [low, length]: [f64; 2], period: f64, weights: &mut [f64]) -> [f64; 2] {
        let whole = (length / period).floor();
        weights.fill(whole * period / f64::from(self.size));
        let low = low.rem_euclid(period);
        [low, low + (length - whole * period).max(0.0)]
    }

    /// Adds what is far beyond the image to the weights. Returns the rest of the interval.
    fn near_image(&self, [low, high]: [f64; 2], weights: &mut [f64]) -> [f64; 2] {
        let (start, end) = (-1.0, f64::from(self.size) + 1.0);
        if self.wrap == Wrap::Clamp {
            weights[0] += (high.min(start) - low).max(0.0);
            weights[self.size as usize - 1] += (high - low.max(end)).max(0.0);
        }
        [low.clamp(start, end), high.clamp(start, end)]
    }

    /// The texel in the place of one that may be beyond the image; `None` is black.
    fn index(&self, texel: i64) -> Option<usize> {
        let size = i64::from(self.size);
        let index = match self.wrap {
            Wrap::Repeat => texel.rem_euclid(size),
            Wrap::Mirror => {
                let within = texel.rem_euclid(2 * size);
                within.min(2 * size - 1 - within)
            }
            Wrap::Clamp => texel.clamp(0, size - 1),
            Wrap::Black => texel,
        };
        usize::try_from(index).ok().filter(|index| *index < self.size as usize)
    }

    /// The integral of a texel's weight up to a distance from its start: of a triangle around its centre for bilinear
    /// interpolation, of a box without one.
    fn integral(&self, distance: f64) -> f64 {
        match self.filter {
            TexelFilter::Nearest => distance.clamp(0.0, 1.0),
            TexelFilter::Bilinear => {
                let from_centre = (distance - 0.5).clamp(-1.0, 1.0);
                let part = 1.0 - from_centre.abs();
                if from_centre < 0.0 { 0.5 * part * part } else { 1.0 - 0.5 * part * part }
            }
        }
    }
}

/// The weighted sum of texels, row by row, with the weights of their columns and rows.
pub fn weighted_sum(texels: &[[f32; 4]], columns: &[f64], rows: &[f64]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (row, weight_of_row) in texels.chunks_exact(columns.len()).zip(rows).filter(|(_, weight)| **weight != 0.0) {
        for (texel, weight) in row.iter().zip(columns) {
            (0..3).for_each(|channel| sum[channel] += weight_of_row * weight * f64::from(texel[channel]));
        }
    }
    sum
}
