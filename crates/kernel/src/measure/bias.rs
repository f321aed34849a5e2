//! The bias: the mean difference of two images, with its standard error.
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::SampleNoise;

/// Relative error of single precision, independent of the samples.
const ROUNDING: f64 = 1e-6;
/// Minimum effective number of samples of a variance. With fewer, the variance is probably far too small, because rare samples
/// have not occurred yet.
pub const LEAST_EFFECTIVE_SAMPLES: f64 = 300.0;

/// The source of a standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// None: only the two images are known, and their difference contains the bias itself.
    None,
    /// The variances of samples.
    Samples,
    /// The scatter of this number of images of the same scene with other seeds.
    Repeats(usize),
}

/// The mean difference of two images over pixels and channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Bias {
    /// The mean difference.
    pub mean: f64,
    /// The source of its standard error.
    pub evidence: Evidence,
    /// Standard error of the mean; `None` without evidence.
    pub standard_error: Option<f64>,
    /// The mean in standard errors, converted to a standard normal number of equal probability; `None` without evidence, and if
    /// samples are exact.
    pub z: Option<f64>,
    /// Whether there is no noise except rounding, so that a difference is not due to chance.
    pub is_exact: bool,
    /// Whether few samples make up most of the variance, so that the standard error is unreliable.
    pub has_heavy_tails: bool,
    /// Upper bound of the effect of rounding on the mean.
    pub rounding: f64,
    /// The means over blocks of 32 × 32 pixels in standard errors, row by row; empty if `z` is `None`.
    pub block_z: Vec<f64>,
}

impl Bias {
    /// The bias of one image minus another of the same size with independent noise. If the noise of the other one is unknown, it
    /// is assumed to be 0.
    pub fn by_samples(a: &[[f32; 3]], b: &[[f32; 3]], [noise, of_other]: [Option<&SampleNoise>; 2], width: usize) -> Bias {
        let [of_a, of_b] = [means(a), means(b)];
        let Some(noise) = noise else { return Bias::unknown(difference(&of_a, &of_b)) };
        let known: Vec<&SampleNoise> = std::iter::once(noise).chain(of_other).collect();
        let tails: f64 = tails(&known);
        let variance = known.iter().map(|noise| noise.variance_of_mean()).sum();
        let blocks = |block: usize| {
            // Of sums of variances that are known by some degrees of freedom: F. E. Satterthwaite 1946.
            let variance: f64 = known.iter().map(|noise| noise.blocks[block]).sum();
            let spread: f64 = known.iter().map(|noise| noise.blocks[block].powi(2) / noise.block_degrees).sum();
            (variance, if spread > 0.0 { variance * variance / spread } else { f64::INFINITY })
        };
        Bias {
            has_heavy_tails: tails < LEAST_EFFECTIVE_SAMPLES,
            ..Bias::of(Evidence::Samples, [&of_a, &of_b], width, (variance, f64::INFINITY), blocks)
        }
    }

    /// The bias of the mean of at least two repeats minus another image. `noise` is that of the other image, assumed to be 0 if
    /// unknown.
    pub fn by_repeats(repeats: &[&[[f32; 3]]], b: &[[f32; 3]], noise: Option<&SampleNoise>, width: usize) -> Bias {
        let of_repeats: Vec<Vec<f64>> = repeats.iter().map(|picture| means(picture)).collect();
        let count = repeats.len() as f64;
        let of_a: Vec<f64> = (0..b.len()).map(|i| of_repeats.iter().map(|picture| picture[i]).sum::<f64>() / count).collect();
        let variance = scatter(&of_repeats.iter().map(|picture| mean(picture)).collect::<Vec<_>>());
        let of_blocks: Vec<Vec<f64>> = of_repeats.iter().map(|picture| SampleNoise::block_means(picture, width)).collect();
        let blocks = |block: usize| {
            let own = scatter(&of_blocks.iter().map(|of| of[block]).collect::<Vec<_>>());
            (own + noise.map_or(0.0, |noise| noise.blocks[block]), count - 1.0)
        };
        let variance = variance + noise.map_or(0.0, SampleNoise::variance_of_mean);
        Bias::of(Evidence::Repeats(repeats.len()), [&of_a, &means(b)], width, (variance, count - 1.0), blocks)
    }

    fn unknown(mean: f64) -> Bias {
        let (evidence, standard_error, z) = (Evidence::None, None, None);
        Bias { mean, evidence, standard_error, z, is_exact: false, has_heavy_tails: false, rounding: 0.0, block_z: Vec::new() }
    }

    /// `variance` is that of the mean, with its degrees of freedom; `blocks` gives those of the means over blocks.
    fn of(
        evidence: Evidence,
        [a, b]: [&[f64]; 2],
        width: usize,
        (variance, degrees): (f64, f64),
        blocks: impl Fn(usize) -> (f64, f64),
    ) -> Bias {
        let level = mean(a).abs().max(mean(b).abs());
        let (standard_error, rounding) = (Some(variance.sqrt()), ROUNDING * level);
        let known = Bias { evidence, standard_error, rounding, ..Bias::unknown(difference(a, b)) };
        if variance.sqrt() <= rounding {
            return Bias { is_exact: true, ..known };
        }
        let [of_a, of_b] = [a, b].map(|picture| SampleNoise::block_means(picture, width));
        let block_z = of_a.iter().zip(&of_b).enumerate().map(|(block, (a, b))| score(a - b, blocks(block), a.abs().max(b.abs())));
        Bias { z: Some(score(known.mean, (variance, degrees), level)), block_z: block_z.collect(), ..known }
    }

    /// The z-score of the block with the largest deviation.
    pub fn worst_block(&self) -> Option<f64> {
        self.block_z.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Root mean square of the z-scores of blocks: 1 if there is only noise.
    pub fn rms_of_blocks(&self) -> Option<f64> {
        let n = self.block_z.len() as f64;
        (n > 0.0).then(|| (self.block_z.iter().map(|z| z * z).sum::<f64>() / n).sqrt())
    }
}

/// The effective number of samples in the sum of the images' variances: Σ(v²/n) adds up over independent images.
fn tails(noises: &[&SampleNoise]) -> f64 {
    let variances = || noises.iter().map(|noise| (noise.variance_of_mean(), noise.effective_samples)).filter(|(v, _)| *v > 0.0);
    let all: f64 = variances().map(|(variance, _)| variance).sum();
    all * all / variances().map(|(variance, samples)| variance * variance / samples).sum::<f64>()
}

/// The mean over the channels of every pixel.
fn means(picture: &[[f32; 3]]) -> Vec<f64> {
    picture.iter().map(|rgb| rgb.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a - b).sum::<f64>() / a.len().max(1) as f64
}

/// The variance of the mean of independent numbers.
fn scatter(values: &[f64]) -> f64 {
    let (n, level) = (values.len() as f64, mean(values));
    values.iter().map(|x| (x - level).powi(2)).sum::<f64>() / (n - 1.0) / n
}

/// A mean in standard errors, converted to a standard normal number of equal probability, for a variance with these degrees of
/// freedom.
fn score(mean: f64, (variance, degrees): (f64, f64), level: f64) -> f64 {
    if mean == 0.0 { 0.0 } else { as_normal(mean / (variance + (ROUNDING * level).powi(2)).sqrt(), degrees) }
}

/// The standard normal number with the same probability as Student's t.
pub fn as_normal(t: f64, degrees: f64) -> f64 {
    let (Ok(student), Ok(normal)) = (StudentsT::new(0.0, 1.0, degrees), Normal::new(0.0, 1.0)) else { return f64::NAN };
    // From the lower tail, where small probabilities keep their digits. Only many repeats make it smaller than any number, and
    // Student's t of many repeats is nearly normal.
    let tail = student.cdf(-t.abs());
    if tail < f64::MIN_POSITIVE { t } else { normal.inverse_cdf(tail).abs().copysign(t) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 64;

    /// Two blocks of 32 × 32 pixels, of these radiances.
    fn picture(blocks: [f32; 2]) -> Vec<[f32; 3]> {
        // No channel is the mean of all.
        (0..WIDTH * 32).map(|i| [0.25, 1.25, 1.5].map(|c| c * blocks[i % WIDTH / 32])).collect()
    }

    fn noise(blocks: [f64; 2], effective_samples: f64) -> SampleNoise {
        SampleNoise {
            width: WIDTH as u32,
            variance: vec![[9.0; 3]; WIDTH * 32],
            blocks: blocks.to_vec(),
            block_degrees: f64::INFINITY,
            effective_samples,
        }
    }

    fn is(found: Option<f64>, exact: f64) {
        assert!(found.is_some_and(|x| (x - exact).abs() < 1e-4 * exact.abs().max(1.0)), "{found:?} {exact}");
    }

    #[test]
    fn variances_of_samples_give_standard_errors() {
        let (a, b) = (picture([3.0, 5.0]), picture([2.0, 7.0]));
        let of_a = noise([0.01, 0.03], 1e6);
        let bias = Bias::by_samples(&a, &b, [Some(&of_a), None], WIDTH);
        assert_eq!((bias.evidence, bias.is_exact, bias.has_heavy_tails), (Evidence::Samples, false, false));
        assert!((bias.mean + 0.5).abs() < 1e-6);
        // Half of each block: (0.01 + 0.03)/4.
        is(bias.standard_error, 0.1);
        is(bias.z, -5.0);
        is(Some(bias.block_z[0]), 10.0);
        is(Some(bias.block_z[1]), -2.0 / 0.03f64.sqrt());
        is(bias.worst_block(), -2.0 / 0.03f64.sqrt());
        is(bias.rms_of_blocks(), ((100.0 + 4.0 / 0.03) / 2.0f64).sqrt());
        // Noise of both adds up.
        let both = Bias::by_samples(&a, &b, [Some(&of_a), Some(&noise([0.03, 0.09], 1e6))], WIDTH);
        is(both.standard_error, 0.2);
        is(Some(both.block_z[0]), 5.0);
    }

    #[test]
    fn blocks_whose_variance_is_little_known_say_less() {
        let (a, b) = (picture([3.0, 5.0]), picture([2.0, 7.0]));
        let few = |variance: [f64; 2], block_degrees| SampleNoise { block_degrees, ..noise(variance, 1e6) };
        let bias = Bias::by_samples(&a, &b, [Some(&few([0.25, 1.0], 3.0)), None], WIDTH);
        // Student's t of 2 and −2 with three degrees of freedom: 7.0 % lie below −2, as below −1.478 of the normal distribution.
        assert!((bias.block_z[0] - 1.4783).abs() < 2e-3 && (bias.block_z[1] + 1.4783).abs() < 2e-3, "{:?}", bias.block_z);
        is(bias.z, -0.5 / (1.25f64 / 4.0).sqrt());
        // Of equal variances with 3 degrees each, 6.
        let both = Bias::by_samples(&a, &b, [Some(&few([0.125, 0.5], 3.0)), Some(&few([0.125, 0.5], 3.0))], WIDTH);
        assert!((both.block_z[0] - as_normal(2.0, 6.0)).abs() < 1e-4, "{:?}", both.block_z);
    }

    #[test]
    fn a_difference_alone_is_no_evidence() {
        let (a, b) = (picture([3.0, 5.0]), picture([2.0, 7.0]));
        for of_b in [None, Some(&noise([0.1; 2], 1e6))] {
            let bias = Bias::by_samples(&a, &b, [None, of_b], WIDTH);
            assert_eq!((bias.evidence, bias.standard_error, bias.z, bias.block_z.len()), (Evidence::None, None, None, 0));
            assert_eq!((bias.worst_block(), bias.rms_of_blocks()), (None, None));
            assert!((bias.mean + 0.5).abs() < 1e-6);
        }
    }

    #[test]
    fn a_bias_without_variance_is_exact() {
        let (a, b) = (picture([3.0, 5.0]), picture([2.0, 7.0]));
        for variance in [0.0, (3e-7f64 * 4.0).powi(2)] {
            let bias = Bias::by_samples(&a, &b, [Some(&noise([variance; 2], 1e6)), None], WIDTH);
            assert!(bias.is_exact && bias.z.is_none() && bias.block_z.is_empty() && bias.mean.abs() > bias.rounding);
            // A part of the brighter mean, which is 4.5.
            is(Some(1e6 * bias.rounding), 4.5);
        }
        // A variance that is hardly more than rounding has that of rounding besides, of the brighter image or block.
        let bias = Bias::by_samples(&a, &b, [Some(&noise([2.0 * 9e-6f64.powi(2); 2], 1e6)), None], WIDTH);
        is(bias.z, -0.5 / 9e-6f64.hypot(4.5e-6));
        is(Some(bias.block_z[0]), 1.0 / (9e-6 * 2f64.sqrt()).hypot(3e-6));
        let same = Bias::by_samples(&a, &a, [Some(&noise([0.0; 2], f64::INFINITY)), None], WIDTH);
        assert!(same.is_exact && !same.has_heavy_tails && same.mean.abs() <= same.rounding);
        let noisy = Bias::by_samples(&a, &a, [Some(&noise([0.1; 2], 1e6)), None], WIDTH);
        assert!(!noisy.is_exact && noisy.z == Some(0.0) && noisy.block_z == [0.0, 0.0]);
    }

    #[test]
    fn few_samples_that_make_up_the_variance_are_told() {
        let a = picture([3.0, 5.0]);
        let heavy = |first: &SampleNoise, second: Option<&SampleNoise>| {
            Bias::by_samples(&a, &a, [Some(first), second], WIDTH).has_heavy_tails
        };
        assert!(heavy(&noise([0.1; 2], 299.0), None) && !heavy(&noise([0.1; 2], 301.0), None));
        // Samples that add little to the variance do not matter.
        assert!(!heavy(&noise([1e-4; 2], 5.0), Some(&noise([0.1; 2], 1e5))));
        assert!(heavy(&noise([0.1; 2], 5.0), Some(&noise([0.1; 2], 1e5))));
    }

    #[test]
    fn repeats_agree_with_the_textbook() {
        let repeats = [[3.0, 5.0], [3.2, 5.4], [3.7, 4.9], [2.9, 5.1]].map(picture);
        let repeats: Vec<&[[f32; 3]]> = repeats.iter().map(Vec::as_slice).collect();
        let bias = Bias::by_repeats(&repeats, &picture([2.0, 7.0]), None, WIDTH);
        assert_eq!(bias.evidence, Evidence::Repeats(4));
        // Means of images are 4, 4.3, 4.3 and 4: 4.15, with the variance 0.03.
        assert!((bias.mean + 0.35).abs() < 1e-6);
        is(bias.standard_error, (0.03f64 / 4.0).sqrt());
        // −4.04 as Student's t with three degrees of freedom.
        let student = StudentsT::new(0.0, 1.0, 3.0).expect("a distribution");
        let normal = Normal::new(0.0, 1.0).expect("a distribution");
        let tail = student.cdf(-0.35 / (0.03f64 / 4.0).sqrt());
        assert!((normal.cdf(bias.z.unwrap_or(0.0)) / tail - 1.0).abs() < 1e-3, "{:?}", bias.z);
        is(bias.z, normal.inverse_cdf(tail));
        // Means of the first block are 3, 3.2, 3.7 and 2.9: 3.2, with the variance 0.38/3.
        is(Some(bias.block_z[0]), as_normal(1.2 / (0.38f64 / 12.0).sqrt(), 3.0));
        assert!(bias.block_z[1] < -2.0, "{:?}", bias.block_z);
        let with_noise = Bias::by_repeats(&repeats, &picture([2.0, 7.0]), Some(&noise([0.05, 0.01], 1e6)), WIDTH);
        is(with_noise.standard_error, (0.03f64 / 4.0 + 0.015).sqrt());
        is(Some(with_noise.block_z[0]), as_normal(1.2 / (0.38f64 / 12.0 + 0.05).sqrt(), 3.0));
    }

    #[test]
    fn tails_keep_their_digits() {
        assert!((as_normal(2.0, 1e9) - 2.0).abs() < 1e-5 && (as_normal(-7.0, 1e9) + 7.0).abs() < 1e-3);
        // Student's t of one degree: P(t < −1) is a quarter.
        assert!((as_normal(-1.0, 1.0) + 0.674_489_75).abs() < 1e-6);
        assert!(as_normal(-1e4, 200.0) < -37.0);
    }
}
