//! Whether an estimate of the error rests on so few samples that the error may be much larger.
//!
//! Where a few samples carry most of the variance, as in caustics that paths rarely find, most of the images have not found the light that
//! makes the error, and a pixel that has found some is bright: its error relative to itself says little. Two figures together show this.
//! If a single sample carries a pixel, the variance of its mean is the square of its mean. And with the variance vᵢ of pixel i,
//! (Σ vᵢ)²/Σ vᵢ² is the number of equally noisy pixels with the same sums.
use rayon::prelude::*;

/// Pixels whose mean has a variance above this part of its square rest on about one sample.
const ONE_SAMPLE: f64 = 0.5;
/// The part of the variance in such pixels above which the estimate is a lower bound. In the shipped scenes at 128 samples it is 0.5 to 1
/// where the estimate is about half of the error or less, and at most 0.42 elsewhere.
const MOST_OF_IT: f64 = 0.5;
/// Fewest equally noisy pixels that make a tail light, as a part of all pixels. Paths that find small lights by chance rest on single
/// samples too, but in 3 % of the pixels or more, and their error is estimated well. The pixels of caustics are 1 % and less.
const FEW_PIXELS: f64 = 0.01;
/// Fewest pixels in small images.
const FEWEST: f64 = 40.0;
/// Fewest pixels in yet smaller images, as a part of all.
const LEAST_PART: f64 = 1.0 / 16.0;

/// Whether few single samples carry the error of an image, given the variances of its pixels.
pub(super) fn has_heavy_tail(radiance: &[[f32; 3]], variance: &[[f32; 3]]) -> bool {
    // Chunks of a fixed length, so that the order of additions does not depend on the number of threads.
    let chunks = radiance.par_chunks(4096).zip(variance.par_chunks(4096));
    let sums: Vec<[f64; 3]> = chunks.map(|(radiance, variance)| add(radiance.iter().zip(variance).map(of_pixel))).collect();
    let [sum, squares, on_one_sample] = add(sums.into_iter());
    let pixels = radiance.len() as f64;
    let few = (FEW_PIXELS * pixels).max(FEWEST.min(LEAST_PART * pixels));
    on_one_sample > MOST_OF_IT * sum && sum * sum < few * squares
}

/// The variance of a pixel, its square, and the variance if it rests on about one sample.
fn of_pixel((radiance, variance): (&[f32; 3], &[f32; 3])) -> [f64; 3] {
    let [radiance, variance] = [radiance, variance].map(|rgb| rgb.iter().copied().map(f64::from).sum::<f64>());
    // Sums over the channels: three equal channels have three times the variance and nine times the square of the mean.
    let rests_on_one = 3.0 * variance > ONE_SAMPLE * radiance * radiance;
    [variance, variance * variance, if rests_on_one { variance } else { 0.0 }]
}

fn add(all: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    all.fold([0.0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gray image where some pixels have found one outlier of 64.
    fn fireflies(count: usize, found: f32) -> bool {
        let lit = |i: usize| i.is_multiple_of(7) && i / 7 < count;
        let radiance: Vec<[f32; 3]> = (0..10_000).map(|i| if lit(i) { [1.0 + found / 64.0; 3] } else { [1.0; 3] }).collect();
        let variance: Vec<_> = (0..10_000).map(|i| if lit(i) { [found * found / 4096.0; 3] } else { [1e-4; 3] }).collect();
        has_heavy_tail(&radiance, &variance)
    }

    #[test]
    fn few_bright_samples_with_most_of_the_variance_are_a_heavy_tail() {
        assert_eq!([1, 50, 99].map(|count| fireflies(count, 6400.0)), [true; 3]);
        assert_eq!([101, 1000].map(|count| fireflies(count, 6400.0)), [false; 2], "many pixels have found such light");
        assert!(!fireflies(50, 64.0), "the samples are as bright as the rest of their pixels");
    }

    /// An image without noise has no tail.
    #[test]
    fn an_exact_image_has_no_heavy_tail() {
        assert!(!has_heavy_tail(&[[1.0; 3]; 1000], &[[0.0; 3]; 1000]));
    }
}
