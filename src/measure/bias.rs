//! The mean of the difference of two pictures, with the standard error that its noise gives it.
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::SampleNoise;

/// Single precision has an error of its own, by this part of the radiance, whatever the samples are.
const ROUNDING: f64 = 1e-6;
/// Where fewer samples make up a variance, it is likely to be far too small: the samples that are rare have not come yet.
const LEAST_EFFECTIVE_SAMPLES: f64 = 300.0;

/// What a standard error is known from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// Nothing: only the two pictures are known, and their difference contains the bias itself.
    None,
    /// The variances of samples.
    Samples,
    /// The scatter of so many pictures of the same by other seeds.
    Repeats(usize),
}

/// How far one picture is from another on average over pixels and channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Bias {
    pub mean: f64,
    pub evidence: Evidence,
    /// Of the mean; `None` where there is no evidence.
    pub standard_error: Option<f64>,
    /// The mean in standard errors, as the standard normal number that is as unlikely; `None` without evidence, and where samples are
    /// exact.
    pub z: Option<f64>,
    /// There is no noise but rounding: a difference is no matter of chance.
    pub is_exact: bool,
    /// Few samples make up most of the variance: the standard error is not to be trusted.
    pub has_heavy_tails: bool,
    /// What rounding alone may add to the mean.
    pub rounding: f64,
    /// The means over blocks of 32 × 32 pixels in standard errors, row by row; empty where `z` is `None`.
    pub block_z: Vec<f64>,
}

impl Bias {
    /// Of one picture less another, of the same size and independent noise. Where the noise of the other one is not known it is taken
    /// for 0.
    pub fn by_samples(a: &[[f32; 3]], b: &[[f32; 3]], [noise, of_other]: [Option<&SampleNoise>; 2], width: usize) -> Bias {
        let [of_a, of_b] = [means(a), means(b)];
        let Some(noise) = noise else { return Bias::unknown(difference(&of_a, &of_b)) };
        let known: Vec<&SampleNoise> = std::iter::once(noise).chain(of_other).collect();
        let tails: f64 = tails(&known);
        let variance = known.iter().map(|noise| noise.variance_of_mean()).sum();
        let blocks = |block: usize| known.iter().map(|noise| noise.blocks[block]).sum();
        let score = |mean: f64, variance: f64, level: f64| mean / (variance + (ROUNDING * level).powi(2)).sqrt();
        Bias {
            has_heavy_tails: tails < LEAST_EFFECTIVE_SAMPLES,
            ..Bias::of(Evidence::Samples, [&of_a, &of_b], width, variance, blocks, score)
        }
    }

    /// Of the mean of repeats, at least two, less another picture. `noise` is that of the other one, 0 if it is not known.
    pub fn by_repeats(repeats: &[&[[f32; 3]]], b: &[[f32; 3]], noise: Option<&SampleNoise>, width: usize) -> Bias {
        let of_repeats: Vec<Vec<f64>> = repeats.iter().map(|picture| means(picture)).collect();
        let count = repeats.len() as f64;
        let of_a: Vec<f64> = (0..b.len()).map(|i| of_repeats.iter().map(|picture| picture[i]).sum::<f64>() / count).collect();
        let variance = scatter(&of_repeats.iter().map(|picture| mean(picture)).collect::<Vec<_>>());
        let of_blocks: Vec<Vec<f64>> = of_repeats.iter().map(|picture| SampleNoise::block_means(picture, width)).collect();
        let blocks = |block: usize| {
            scatter(&of_blocks.iter().map(|of| of[block]).collect::<Vec<_>>()) + noise.map_or(0.0, |noise| noise.blocks[block])
        };
        let score =
            |mean: f64, variance: f64, level: f64| as_normal(mean / (variance + (ROUNDING * level).powi(2)).sqrt(), count - 1.0);
        let variance = variance + noise.map_or(0.0, SampleNoise::variance_of_mean);
        Bias::of(Evidence::Repeats(repeats.len()), [&of_a, &means(b)], width, variance, blocks, score)
    }

    fn unknown(mean: f64) -> Bias {
        let (evidence, standard_error, z) = (Evidence::None, None, None);
        Bias { mean, evidence, standard_error, z, is_exact: false, has_heavy_tails: false, rounding: 0.0, block_z: Vec::new() }
    }

    /// `variance` is that of the mean, `blocks` gives those of the means over blocks; `score` makes a number of standard errors of a mean, its
    /// variance and the radiance there.
    fn of(
        evidence: Evidence,
        [a, b]: [&[f64]; 2],
        width: usize,
        variance: f64,
        blocks: impl Fn(usize) -> f64,
        score: impl Fn(f64, f64, f64) -> f64,
    ) -> Bias {
        let level = mean(a).abs().max(mean(b).abs());
        let (standard_error, rounding) = (Some(variance.sqrt()), ROUNDING * level);
        let known = Bias { evidence, standard_error, rounding, ..Bias::unknown(difference(a, b)) };
        if variance.sqrt() <= rounding {
            return Bias { is_exact: true, ..known };
        }
        let [of_a, of_b] = [a, b].map(|picture| SampleNoise::block_means(picture, width));
        let block_z = of_a
            .iter()
            .zip(&of_b)
            .enumerate()
            .map(|(block, (a, b))| if a == b { 0.0 } else { score(a - b, blocks(block), a.abs().max(b.abs())) });
        Bias {
            z: Some(if known.mean == 0.0 { 0.0 } else { score(known.mean, variance, level) }),
            block_z: block_z.collect(),
            ..known
        }
    }

    /// The block that is furthest off.
    pub fn worst_block(&self) -> Option<f64> {
        self.block_z.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Root of the mean square of the scores of blocks: 1 if there is only noise.
    pub fn rms_of_blocks(&self) -> Option<f64> {
        let n = self.block_z.len() as f64;
        (n > 0.0).then(|| (self.block_z.iter().map(|z| z * z).sum::<f64>() / n).sqrt())
    }
}

/// How many samples of equal weight would make up the sum of the pictures' variances: Σ(v²/n) adds up over independent pictures.
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

/// The standard normal number that is as unlikely as Student's t.
fn as_normal(t: f64, degrees: f64) -> f64 {
    let (Ok(student), Ok(normal)) = (StudentsT::new(0.0, 1.0, degrees), Normal::new(0.0, 1.0)) else { return f64::NAN };
    // From the lower tail, where small probabilities keep their digits. Only many repeats make it smaller than any number, and
    // Student's t of many repeats is nearly normal.
    let tail = student.cdf(-t.abs());
    if tail < f64::MIN_POSITIVE { t } else { normal.inverse_cdf(tail).abs().copysign(t) }
}
