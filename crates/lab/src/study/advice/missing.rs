//! Light that settings have not found, but others have.
//!
//! Images without a caustic agree with each other, so their spread says nothing of it. But the images of settings that find it have it at
//! the same pixels in every round. Let dᵢ be the difference of the images of round i. Since rounds are independent, the mean of dᵢ · dⱼ over
//! i ≠ j is an estimate without bias of the squared difference of the expected images: noise averages out, and so do single outliers,
//! which no two rounds have at the same pixel.
use super::rounds::{RoundPicture, Series};

/// Fewest rounds that both must have.
const FEWEST_ROUNDS: usize = 4;
/// Fewest standard errors from 0. Some hundred pairs are compared, and the jackknife of so few rounds is rough.
const FEWEST_ERRORS: f64 = 5.0;

/// A lower bound of the relMSE of an image of the settings `own` from light that `other` settings have found in addition, given the mean
/// image of all and the weights of relMSE. 0 if they have found none.
///
/// If no image of n has found light that adds d, the probability to find it is hardly above 1/n, and the variance of an image at least n d².
pub fn missing(own: &Series, other: &Series, common: &[f64], weights: &[f64]) -> f64 {
    let pairs: Vec<[&RoundPicture; 2]> =
        own.pictures.iter().filter_map(|picture| Some([picture, other.of_round(picture.round)?])).collect();
    if pairs.len() < FEWEST_ROUNDS {
        return 0.0;
    }
    let differences = Differences::of(&pairs, common, weights);
    let squared = differences.squared();
    let is_certain = squared > FEWEST_ERRORS * differences.standard_error();
    if is_certain && differences.light > 0.0 { pairs.len() as f64 * squared } else { 0.0 }
}

/// Products of the differences of all rounds, means over pixels and channels with the weights of relMSE.
struct Differences {
    /// dᵢ · dᵢ.
    squares: Vec<f64>,
    /// dᵢ · Σ dⱼ.
    with_all: Vec<f64>,
    /// The additional light, relative to the common image.
    light: f64,
}

impl Differences {
    fn of(pairs: &[[&RoundPicture; 2]], common: &[f64], weights: &[f64]) -> Differences {
        let rounds = pairs.len();
        let values: Vec<[&[f32]; 2]> = pairs.iter().map(|pair| pair.map(|picture| picture.radiance.as_flattened())).collect();
        let (mut squares, mut with_all, mut light, mut d) = (vec![0.0; rounds], vec![0.0; rounds], 0.0, vec![0.0; rounds]);
        for (i, (common, weight)) in common.iter().zip(weights).enumerate() {
            for (d, [own, other]) in d.iter_mut().zip(&values) {
                *d = f64::from(other[i]) - f64::from(own[i]);
            }
            let all: f64 = d.iter().sum();
            light += weight * common * all;
            for ((d, square), with_all) in d.iter().zip(&mut squares).zip(&mut with_all) {
                *square += weight * d * d;
                *with_all += weight * d * all;
            }
        }
        let count = weights.len() as f64;
        [&mut squares, &mut with_all].into_iter().flatten().for_each(|sum| *sum /= count);
        Differences { squares, with_all, light }
    }

    /// The mean of dᵢ · dⱼ over i ≠ j.
    fn squared(&self) -> f64 {
        let n = self.squares.len() as f64;
        (self.with_all.iter().sum::<f64>() - self.squares.iter().sum::<f64>()) / (n * (n - 1.0))
    }

    /// The standard error of that by the jackknife.
    fn standard_error(&self) -> f64 {
        let n = self.squares.len() as f64;
        let [all, squares] = [&self.with_all, &self.squares].map(|sums| sums.iter().sum::<f64>());
        // Without round k, |Σ d|² is |Σ d|² − 2 dₖ · Σ d + dₖ · dₖ.
        let without =
            |(with_all, square): (&f64, &f64)| (all - 2.0 * with_all + square - (squares - square)) / ((n - 1.0) * (n - 2.0));
        let parts: Vec<f64> = self.with_all.iter().zip(&self.squares).map(without).collect();
        let mean = parts.iter().sum::<f64>() / n;
        ((n - 1.0) / n * parts.iter().map(|part| (part - mean).powi(2)).sum::<f64>()).sqrt()
    }
}
