//! Light that settings have not found, but others have.
//!
//! Images without a caustic agree with each other, so their spread says nothing of it. An image that is darker over a whole block of pixels
//! than those of other settings, by more than their noise explains, must miss light; its error is at least what is missing.
/// Consecutive pixels that are compared by their mean.
const BLOCK: usize = 128;

/// The mean of the images of some settings.
pub struct Means {
    pub radiance: Vec<f64>,
    /// relMSE of one image, from the spread of the images.
    pub rel_mse: f64,
    /// Number of images.
    pub count: f64,
}

/// A lower bound of the relMSE of an image of settings with the mean images `own`, from the light that `other` settings have found in addition.
/// 0 if they have found none.
///
/// Where no path of a block of P pixels has found light that adds d to its mean, the variance of its pixels is at least P d². Noise of both
/// makes half of the blocks differ, which is subtracted.
pub fn missing(own: &Means, other: &Means, common: &[f64], floor: f64) -> f64 {
    let blocks = own.radiance.chunks(3 * BLOCK).zip(other.radiance.chunks(3 * BLOCK)).zip(common.chunks(3 * BLOCK));
    let excess: f64 = blocks.map(|((own, other), common)| excess(own, other, common, floor)).sum();
    let by_noise = own.rel_mse / own.count + other.rel_mse / other.count;
    own.count * (excess / common.len().max(1) as f64 - by_noise).max(0.0)
}

/// The sum over the pixels and channels of a block.
fn excess(own: &[f64], other: &[f64], common: &[f64], floor: f64) -> f64 {
    let pixels = (own.len() / 3) as f64;
    let mean = |of: &[f64], channel: usize| of.iter().skip(channel).step_by(3).sum::<f64>() / pixels;
    let of_channel = |channel: usize| {
        let less = (mean(other, channel) - mean(own, channel)).max(0.0);
        (pixels * less).powi(2) / (mean(common, channel).powi(2) + floor).max(f64::MIN_POSITIVE)
    };
    (0..3).map(of_channel).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn means(pixel: impl Fn(usize) -> f64, rel_mse: f64) -> Means {
        Means { radiance: (0..3 * 4 * BLOCK).map(|i| pixel(i / 3)).collect(), rel_mse, count: 8.0 }
    }

    #[test]
    fn a_block_that_others_light_is_missing_and_noise_is_not() {
        let dark = means(|_| 1.0, 0.01);
        let lit = means(|i| if i < BLOCK { 1.5 } else { 1.0 }, 0.01);
        let common: Vec<f64> = dark.radiance.iter().zip(&lit.radiance).map(|(a, b)| (a + b) / 2.0).collect();
        // One block of four lacks ½ of 1.25.
        let excess = BLOCK as f64 * 0.25 / 1.25f64.powi(2) / 4.0;
        assert!((missing(&dark, &lit, &common, 0.0) - 8.0 * (excess - 0.0025)).abs() < 1e-9);
        assert_eq!(missing(&lit, &dark, &common, 0.0), 0.0);
        // Differences that noise explains: 1 % of the light in every other pixel, with a relMSE of 10⁻⁴ times eight images.
        let noisy = means(|i| 1.0 + if i % 2 == 0 { 0.01 } else { -0.01 }, 8e-4);
        assert_eq!(missing(&dark, &noisy, &dark.radiance, 0.0), 0.0);
    }
}
