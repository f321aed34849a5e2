//! Means of pixels and their variances, and how far the mean of a block has moved since its samples last doubled.
use super::splats::SplatEstimate;
use noisefall_kernel::measure::relative;

/// Mean of a pixel's samples and the variance of that mean, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean radiance of the samples.
    pub mean: [f64; 3],
    /// `None` before the second sample.
    pub variance_of_mean: Option<[f64; 3]>,
}

impl Estimate {
    /// The estimate with the light of splats, which is independent of that of the pixel's own samples.
    #[inline]
    pub(super) fn plus(self, splats: &SplatEstimate) -> Estimate {
        let sum = |a: [f64; 3], b: [f32; 3]| [a[0] + f64::from(b[0]), a[1] + f64::from(b[1]), a[2] + f64::from(b[2])];
        let variance_of_mean = self.variance_of_mean.map(|variance| sum(variance, splats.variance));
        Estimate { mean: sum(self.mean, splats.mean), variance_of_mean }
    }
}

/// A colour in single precision. Called for every pixel, so it is no `map`, which is not always inlined.
#[inline(always)]
pub(super) fn single([r, g, b]: [f64; 3]) -> [f32; 3] {
    [r as f32, g as f32, b as f32]
}

/// Sums over the pixels and channels of a block, each divided by the squared radiance with the floor of relMSE.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Doubling {
    /// Sum of the squared difference of the means of N and of N/2 samples.
    pub moved: f64,
    /// Sum of the variance of the mean of N samples, from the sample variance.
    pub variance: f64,
}

impl Doubling {
    /// `estimates` are those of the pixels of a block, and `before` their means at half as many samples. `floor` is the constant
    /// that relMSE adds to the squared radiance.
    pub fn new(estimates: &[Estimate], before: &[[f32; 3]], floor: f64) -> Doubling {
        let mut doubling = Doubling::default();
        (0..3).for_each(|channel| doubling.add(channel, estimates, before, floor));
        doubling
    }

    /// Adds one channel. Radiance is smoothed over the block if noise hides it.
    fn add(&mut self, channel: usize, estimates: &[Estimate], before: &[[f32; 3]], floor: f64) {
        let mean = |estimate: &Estimate| estimate.mean[channel];
        let variance = |estimate: &Estimate| estimate.variance_of_mean.map_or(0.0, |variance| variance[channel]);
        let count = estimates.len() as f64;
        let level = estimates.iter().map(mean).sum::<f64>() / count;
        let noise = estimates.iter().map(variance).sum::<f64>() / count;
        let spread = estimates.iter().map(|estimate| (mean(estimate) - level).powi(2)).sum::<f64>() / count;
        // How much the radiance itself varies over the block.
        let signal = (spread - noise).max(0.0);
        for (estimate, before) in estimates.iter().zip(before) {
            // A pixel far brighter than its neighbours by one lucky sample must not be divided by that sample's square: its
            // radiance is taken for the likelier one of its own mean and of the block's (W. James and C. Stein 1961).
            let (mean, variance) = (mean(estimate), variance(estimate));
            let trust = if variance > 0.0 { signal / (signal + variance) } else { 1.0 };
            let radiance = level + (mean - level) * trust;
            self.moved += relative((mean - f64::from(before[channel])).powi(2), radiance, floor);
            self.variance += relative(variance, radiance, floor);
        }
    }
}

/// Sums over pixels and channels of two estimates of the squared radiance.
///
/// The square of a mean of samples contains their noise, whose variance is subtracted. For stratified samples this subtracts too
/// much; the squared means of blocks, which are hardly too small, are a lower bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SquaredRadiance {
    of_pixels: f64,
    of_blocks: f64,
}

impl SquaredRadiance {
    /// The sums of a block.
    pub fn of(block: &[Estimate]) -> SquaredRadiance {
        let (mut of_pixels, mut level) = (0.0, [0.0; 3]);
        for Estimate { mean, variance_of_mean } in block {
            let variance = variance_of_mean.unwrap_or_default();
            for c in 0..3 {
                level[c] += mean[c];
                of_pixels += mean[c] * mean[c] - variance[c];
            }
        }
        let of_blocks = level.iter().map(|level| level * level).sum::<f64>() / block.len().max(1) as f64;
        SquaredRadiance { of_pixels, of_blocks }
    }

    pub fn plus(self, other: SquaredRadiance) -> SquaredRadiance {
        SquaredRadiance { of_pixels: self.of_pixels + other.of_pixels, of_blocks: self.of_blocks + other.of_blocks }
    }

    /// The mean over the pixels and channels of an image.
    pub fn mean(self, resolution: [u32; 2]) -> f64 {
        self.of_pixels.max(self.of_blocks) / (3.0 * resolution.map(f64::from).iter().product::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_and_variances_are_relative_to_radiance_smoothed_over_the_block() {
        let estimate = |red: f64| Estimate { mean: [red, 0.0, 0.0], variance_of_mean: Some([0.5, 0.0, 0.0]) };
        // Level 2, spread 1, noise ½: half of the difference from the level is believed, which leaves 1.5 and 2.5.
        let found = Doubling::new(&[estimate(1.0), estimate(3.0)], &[[0.0; 3], [2.5, 0.0, 0.0]], 0.25);
        assert!((found.moved - (1.0 / 2.5 + 0.25 / 6.5)).abs() < 1e-12 && (found.variance - 0.5 / 2.5 - 0.5 / 6.5).abs() < 1e-12);
    }
}
