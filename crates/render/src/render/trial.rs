//! Comparison of two settings by a trial.
use super::estimate::Estimate;
use noisefall_kernel::measure::{Floor, relative};

/// Sums over tiles of the variances of both, relative to the squared common means with the floor of relMSE.
pub(super) fn relative_variances(tiles: &[[Vec<Estimate>; 2]]) -> [f64; 2] {
    let pairs = || tiles.iter().flat_map(|[without, with]| without.iter().zip(with));
    let mean = |(a, b): (&Estimate, &Estimate)| [0, 1, 2].map(|channel| (a.mean[channel] + b.mean[channel]) / 2.0);
    let squares: f64 = pairs().flat_map(mean).map(|x| x * x).sum();
    let floor = Floor::DEFAULT.of(squares / (3 * pairs().count()).max(1) as f64);
    let mut sums = [0.0; 2];
    for (a, b) in pairs() {
        for (channel, mean) in mean((a, b)).into_iter().enumerate() {
            let variance = |of: &Estimate| of.variance_of_mean.map_or(0.0, |variance| variance[channel]);
            sums[0] += relative(variance(a), mean, floor);
            sums[1] += relative(variance(b), mean, floor);
        }
    }
    sums
}

/// Consecutive pixels that are compared by their mean: a few rows of a tile.
const BLOCK: usize = 128;

/// The variance, summed over the pixels as in [`relative_variances`], that would explain what one image has more than another.
///
/// It is estimated from the means of blocks. Where no path of a block has found some light, its pixels have a variance of at least the square of
/// what is missing times their number, which a single pixel does not show.
pub(super) fn relative_excess(a: &[Estimate], b: &[Estimate]) -> f64 {
    let mean =
        |block: &[Estimate]| [0, 1, 2].map(|channel| block.iter().map(|of| of.mean[channel]).sum::<f64>() / block.len() as f64);
    let with = |(a, b): (&[Estimate], &[Estimate])| {
        let [mean_a, mean_b] = [mean(a), mean(b)];
        let pixels = a.len() as f64;
        let variance = [0, 1, 2].map(|channel| (pixels * (mean_a[channel] - mean_b[channel]).max(0.0)).powi(2));
        let of = |mean, variance| Estimate { mean, variance_of_mean: Some(variance) };
        (of(mean_a, variance), of(mean_b, [0.0; 3]))
    };
    let (a_blocks, b_blocks): (Vec<_>, Vec<_>) = a.chunks(BLOCK).zip(b.chunks(BLOCK)).map(with).unzip();
    let [excess, _] = relative_variances(&[[a_blocks, b_blocks]]);
    excess
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variances_with_and_without_path_reuse_are_relative_to_the_mean_of_both() {
        let of = |mean: [f64; 3], red: f64| vec![Estimate { mean, variance_of_mean: Some([red, 0.0, 0.0]) }];
        // The mean square of 2, 1 and 1 is 2, a hundredth of which is the floor.
        let one = [of([1.0; 3], 0.1), of([3.0, 1.0, 1.0], 0.3)];
        let [without, with] = relative_variances(&[one]);
        assert!((without - 0.1 / 4.02).abs() < 1e-12 && (with - 0.3 / 4.02).abs() < 1e-12, "{without} {with}");
        // Another tile of squares 0 and variance 0.02 adds to both sums, and halves the floor.
        let dark = [of([0.0; 3], 0.02), of([0.0; 3], 0.0)];
        let [without, with] = relative_variances(&[[of([1.0; 3], 0.1), of([3.0, 1.0, 1.0], 0.3)], dark]);
        assert!((without - 0.1 / 4.01 - 2.0).abs() < 1e-12 && (with - 0.3 / 4.01).abs() < 1e-12, "{without} {with}");
    }

    #[test]
    fn an_excess_counts_where_an_image_is_brighter_and_not_where_it_is_darker() {
        let of = |red: f64| Estimate { mean: [red, 1.0, 1.0], variance_of_mean: None };
        // One block of two pixels: red is 2 and 1, and 1.5 in the mean of both; the mean square is 1.4167, a hundredth of which is the floor.
        let (a, b) = ([of(3.0), of(1.0)], [of(1.0), of(1.0)]);
        let excess = (2.0f64 * 1.0).powi(2) / (1.5f64.powi(2) + (1.5f64.powi(2) + 2.0) / 3.0 / 100.0);
        assert!((relative_excess(&a, &b) - excess).abs() < 1e-12, "{} {excess}", relative_excess(&a, &b));
        assert_eq!(relative_excess(&b, &a), 0.0);
    }
}
