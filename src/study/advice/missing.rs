//! Light that settings have not found, but others have.
//!
//! Images without a caustic agree with each other, so their spread says nothing of it. An image that is darker over a whole block of pixels
//! than those of other settings, by more than their noise explains, must miss light; its error is at least what is missing.
use crate::measure::Moments;

/// Consecutive pixels that are compared by their mean.
const BLOCK: usize = 128;

/// Standard errors by which the means of a block must differ. By chance one of 700 does, and then by little.
const SIGNIFICANT: f64 = 3.0;

/// A lower bound of the relMSE of one of the images `own`, from the light that images of `other` settings have found in addition; 0 if they
/// have found none. Images are means per channel of each pixel.
///
/// Where no path of a block of P pixels has found light that adds d to its mean, the variance of its pixels is at least P d². One bright sample
/// is no light that the others miss: it does not come back in the next image.
pub fn missing(own: &[&[[f32; 3]]], other: &[&[[f32; 3]]], common: &[f64], floor: f64) -> f64 {
    let starts = (0..common.len() / 3).step_by(BLOCK);
    let excess: f64 = starts.map(|start| excess(own, other, &common[3 * start..], start, floor)).sum();
    own.len() as f64 * excess / common.len().max(1) as f64
}

/// The sum over the pixels and channels of the block from pixel `start` on, of which `common` begins with the means.
fn excess(own: &[&[[f32; 3]]], other: &[&[[f32; 3]]], common: &[f64], start: usize, floor: f64) -> f64 {
    let pixels = BLOCK.min(common.len() / 3);
    let of_channel = |channel: usize| {
        let block = |image: &&[[f32; 3]]| {
            image[start..start + pixels].iter().map(|rgb| f64::from(rgb[channel])).sum::<f64>() / pixels as f64
        };
        let [own, other] = [own, other].map(|images| Moments::of(images.iter().map(block)));
        let by_chance = (own.variance / own.count + other.variance / other.count).sqrt();
        let less = other.mean - own.mean;
        let mean = common.iter().skip(channel).step_by(3).take(pixels).sum::<f64>() / pixels as f64;
        let is_missing = less > SIGNIFICANT * by_chance;
        if is_missing { (pixels as f64 * less).powi(2) / (mean * mean + floor).max(f64::MIN_POSITIVE) } else { 0.0 }
    };
    (0..3).map(of_channel).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: usize = 4 * BLOCK;

    /// Eight images of four blocks.
    fn images(pixel: impl Fn(usize, usize) -> f32) -> Vec<Vec<[f32; 3]>> {
        (0..8).map(|image| (0..PIXELS).map(|i| [pixel(image, i); 3]).collect()).collect()
    }

    fn found(own: &[Vec<[f32; 3]>], other: &[Vec<[f32; 3]>]) -> f64 {
        let [own, other]: [Vec<&[[f32; 3]]>; 2] = [own, other].map(|images| images.iter().map(Vec::as_slice).collect());
        missing(&own, &other, &[1.25; 3 * PIXELS], 0.0)
    }

    #[test]
    fn a_block_that_others_light_is_missing_and_noise_is_not() {
        let dark = images(|_, _| 1.0);
        let lit = images(|_, i| if i < BLOCK { 1.5 } else { 1.0 });
        // One block of four lacks ½ of 1.25.
        let excess = 8.0 * BLOCK as f64 * 0.25 / 1.25f64.powi(2) / 4.0;
        assert!((found(&dark, &lit) / excess - 1.0).abs() < 1e-9);
        assert_eq!(found(&lit, &dark), 0.0);
        // One bright sample in one image.
        assert_eq!(found(&dark, &images(|image, i| if (image, i) == (3, 7) { 1e3 } else { 1.0 })), 0.0);
    }
}
