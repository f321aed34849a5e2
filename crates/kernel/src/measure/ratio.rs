//! The ratio of the errors of two images, and how sure it is.
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{SampleNoise, error::relative};

/// An error that is a mean over blocks of an image, and the same without each of the blocks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockErrors {
    /// The error of the image.
    pub whole: f64,
    /// The error without each block of [`SampleNoise::BLOCK`] pixels, row by row from the top left.
    pub without: Vec<f64>,
}

/// The natural logarithm of a ratio, with what it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogRatio {
    /// The logarithm.
    pub value: f64,
    /// Its standard error by chance.
    pub standard_error: f64,
    /// Degrees of freedom of the standard error.
    pub degrees: f64,
    /// Its standard error by the models from which both errors were estimated; 0 if they are known.
    pub model_error: f64,
}

/// The quantile of Student's t that encloses 95 % on both sides.
pub fn student_95(degrees: f64) -> f64 {
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |t| t.inverse_cdf(0.975))
}

impl BlockErrors {
    /// The relMSE of an image of this width against a reference of the same size, with a floor as in [`super::compare`].
    pub fn rel_mse(picture: &[[f32; 3]], reference: &[[f32; 3]], width: usize, floor: f64) -> BlockErrors {
        let error = |(x, r): (&[f32; 3], &[f32; 3])| {
            (0..3).map(|c| relative(f64::from(x[c] - r[c]).powi(2), f64::from(r[c]), floor)).sum::<f64>() / 3.0
        };
        let errors: Vec<f64> = picture.iter().zip(reference).map(error).collect();
        let count = errors.len() as f64;
        let sum: f64 = errors.iter().sum();
        let blocks = SampleNoise::block_means(&errors, width).into_iter().zip(SampleNoise::block_sizes(width, errors.len()));
        BlockErrors { whole: sum / count, without: blocks.map(|(mean, size)| (sum - mean * size) / (count - size)).collect() }
    }
}

impl LogRatio {
    /// ln(a/b) of two images of the same size, with its standard error by the jackknife over blocks (R. G. Miller, "Jackknifing
    /// Variances", 1968). Both leave out the same block, so what makes both noisy in the same places cancels. `None` without noise or
    /// with a single block.
    pub fn jackknife(a: &BlockErrors, b: &BlockErrors) -> Option<LogRatio> {
        let blocks = a.without.len();
        let log = |a: f64, b: f64| Some((a / b).ln()).filter(|log| log.is_finite());
        let value = log(a.whole, b.whole)?;
        if blocks < 2 || blocks != b.without.len() {
            return None;
        }
        let without = a.without.iter().zip(&b.without).map(|(a, b)| log(*a, *b)).collect::<Option<Vec<f64>>>()?;
        let mean = without.iter().sum::<f64>() / blocks as f64;
        let squares: f64 = without.iter().map(|log| (log - mean).powi(2)).sum();
        let degrees = (blocks - 1) as f64;
        Some(LogRatio { value, standard_error: (squares * degrees / blocks as f64).sqrt(), degrees, model_error: 0.0 })
    }

    /// The ratio and the ends of its 95 % confidence interval.
    pub fn interval(&self) -> [f64; 3] {
        let [chance, model] =
            [student_95(self.degrees) * self.standard_error, student_95(f64::from(u16::MAX)) * self.model_error];
        let half = chance.hypot(model);
        [self.value, self.value - half, self.value + half].map(f64::exp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Floor, compare};
    use noisefall_base::math::{One, U};
    use noisefall_scene::sampling::hash::{hash, unit};

    /// Images of 96 × 64 pixels of independent noise around 1, whose variance is 1/12 of the square of this width.
    fn noise(seed: u32, width: f32) -> Vec<[f32; 3]> {
        let uniform = |i: u32| unit(hash(U::<One>(seed * 100_003 + i))).0;
        (0..96 * 64).map(|i| [0, 1, 2].map(|c| 1.0 + width * (uniform(3 * i + c) - 0.5))).collect()
    }

    fn errors(picture: &[[f32; 3]]) -> BlockErrors {
        BlockErrors::rel_mse(picture, &vec![[1.0; 3]; picture.len()], 96, 0.01)
    }

    #[test]
    fn the_error_of_all_blocks_is_rel_mse_and_one_left_out_is_that_of_the_others() {
        let (picture, truth) = (noise(1, 0.5), vec![[1.0; 3]; 96 * 64]);
        let found = errors(&picture);
        assert!((found.whole / compare(&picture, &truth, Floor::Absolute(0.01)).rel_mse - 1.0).abs() < 1e-6);
        let is_outside = |i: &usize| i % 96 >= 32 || i / 96 >= 32;
        let others: Vec<[f32; 3]> = (0..picture.len()).filter(is_outside).map(|i| picture[i]).collect();
        let exact = compare(&others, &truth[..others.len()], Floor::Absolute(0.01)).rel_mse;
        assert!(found.without.len() == 6 && (found.without[0] / exact - 1.0).abs() < 1e-6, "{found:?} {exact}");
    }

    /// Of 200 ratios of equal errors, 10 lie outside their 95 % intervals: more than 26 do with a probability of 10⁻⁵.
    #[test]
    fn intervals_of_equal_errors_hold_1_as_often_as_they_say() {
        let outside = |pair: u32| {
            let [a, b] = [2 * pair, 2 * pair + 1].map(|seed| errors(&noise(seed, 0.5)));
            let [_, low, high] = LogRatio::jackknife(&a, &b).expect("there is noise").interval();
            low > 1.0 || high < 1.0
        };
        let count = (0..200).filter(|pair| outside(*pair)).count();
        assert!((1..=26).contains(&count), "{count}");
    }

    #[test]
    fn a_ratio_that_is_known_is_found() {
        let ratio = LogRatio::jackknife(&errors(&noise(5, 0.8)), &errors(&noise(6, 0.4))).expect("there is noise");
        let [ratio, low, high] = ratio.interval();
        assert!(low < 4.0 && 4.0 < high && (ratio / 4.0 - 1.0).abs() < 0.1, "{ratio} {low} {high}");
    }

    #[test]
    fn images_without_noise_or_with_one_block_have_no_ratio() {
        let (none, some) = (errors(&vec![[1.0; 3]; 96 * 64]), errors(&noise(1, 0.5)));
        assert!(LogRatio::jackknife(&none, &some).is_none() && LogRatio::jackknife(&some, &none).is_none());
        let small = BlockErrors::rel_mse(&noise(1, 0.5)[..64], &[[1.0; 3]; 64], 8, 0.01);
        assert!(LogRatio::jackknife(&small, &small).is_none());
    }

    #[test]
    fn errors_of_models_widen_the_interval() {
        let ratio = LogRatio { value: 0.0, standard_error: 0.03, degrees: 1e6, model_error: 0.04 };
        let [_, low, high] = ratio.interval();
        assert!((high.ln() - 1.96 * 0.05).abs() < 1e-3 && (low * high - 1.0).abs() < 1e-9);
    }
}
