//! The noise of an image's means, from the variance of its samples.

/// The variances of an image's means, from the variance of its samples.
///
/// They are exact for independent samples, and upper bounds for stratified and Sobol samples. The noise of pixels that share
/// paths is correlated, so the variance of a mean over pixels is larger than without correlation; blocks are uncorrelated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleNoise {
    /// Width of the image in pixels.
    pub width: u32,
    /// Variance of the mean of every pixel, per channel; row by row from the top left.
    pub variance: Vec<[f32; 3]>,
    /// Variance of the mean over the pixels and channels of every block of [`SampleNoise::BLOCK`] pixels, row by row. Blocks at the right
    /// and at the bottom may be smaller.
    pub blocks: Vec<f64>,
    /// Degrees of freedom of each of `blocks`: few if they come from samples of a whole block, because its pixels are correlated;
    /// practically infinite if they come from the samples of all its pixels.
    pub block_degrees: f64,
    /// Effective number of samples in the variance; infinite if nothing varies. A small number means that most of the variance
    /// comes from few samples, and that it is probably inaccurate.
    pub effective_samples: f64,
}

impl SampleNoise {
    /// Width and height of a block in pixels.
    pub const BLOCK: usize = 32;

    /// Variance of the mean over all pixels and channels.
    pub fn variance_of_mean(&self) -> f64 {
        let pixels = self.variance.len() as f64;
        let part = |(block, variance): (usize, &f64)| variance * (self.pixels_of(block) / pixels).powi(2);
        self.blocks.iter().enumerate().map(part).sum()
    }

    /// The means of an image, or of a difference, over the pixels and channels of each block.
    pub fn block_means(values: &[f64], width: usize) -> Vec<f64> {
        let band = |rows: &[f64]| {
            let columns = 0..width.div_ceil(Self::BLOCK);
            let block = |column: usize| {
                let runs = rows.chunks(width).map(|row| &row[column * Self::BLOCK..width.min((column + 1) * Self::BLOCK)]);
                let (sum, count) = runs.flatten().fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
                sum / count
            };
            columns.map(block).collect::<Vec<f64>>()
        };
        values.chunks(width * Self::BLOCK).flat_map(band).collect()
    }

    /// The numbers of pixels of all blocks of an image, row by row.
    pub fn block_sizes(width: usize, pixels: usize) -> impl Iterator<Item = f64> {
        let [columns, rows] = [width, pixels / width].map(|side| side.div_ceil(Self::BLOCK));
        (0..columns * rows).map(move |block| Self::block_size(block, [width, pixels / width]))
    }

    fn pixels_of(&self, block: usize) -> f64 {
        Self::block_size(block, [self.width as usize, self.variance.len() / self.width as usize])
    }

    fn block_size(block: usize, [width, height]: [usize; 2]) -> f64 {
        let columns = width.div_ceil(Self::BLOCK);
        let side = |place: usize, all: usize| (all - place * Self::BLOCK).min(Self::BLOCK) as f64;
        side(block % columns, width) * side(block / columns, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_count_by_their_pixels() {
        // Blocks of 32 × 32, 8 × 32, 32 × 4 and 8 × 4 pixels.
        let noise =
            SampleNoise { width: 40, variance: vec![[0.0; 3]; 40 * 36], blocks: vec![1.0, 4.0, 9.0, 16.0], ..Default::default() };
        let sizes = [32.0 * 32.0, 8.0 * 32.0, 32.0 * 4.0, 8.0 * 4.0];
        let exact: f64 =
            sizes.iter().zip(&noise.blocks).map(|(size, variance)| variance * size * size).sum::<f64>() / 1440f64.powi(2);
        assert!((noise.variance_of_mean() / exact - 1.0).abs() < 1e-12);
    }

    #[test]
    fn means_of_blocks_are_those_of_their_own_pixels() {
        let value =
            |i: usize| [[1.0, 2.0], [3.0, 5.0]][i / 40 / 32][i % 40 / 32] + if i.is_multiple_of(2) { 0.25 } else { -0.25 };
        let values: Vec<f64> = (0..40 * 36).map(value).collect();
        assert_eq!(SampleNoise::block_means(&values, 40), [1.0, 2.0, 3.0, 5.0]);
    }
}
