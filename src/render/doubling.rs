//! How far a picture still is from the one it converges to, told from how far it moves while its samples double.
//!
//! For independent samples the sample variance says it all. Stratified and Sobol samples are better than it says, by how much shows
//! only over the whole picture. Let V(N) be the squared error of the mean of N samples. Where the second half of the samples is as
//! good as the first, E|I_N − I_{N/2}|² = V(N/2) − V(N): see [`remaining`] for how V(N) follows from these differences.
use super::film::{Estimate, Film};
use crate::measure::REL_MSE_FLOOR;

/// Sums over the pixels and channels of a tile, each divided by the square of the radiance as relMSE has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Doubling {
    /// Of the squared difference of the means of N and of N/2 samples.
    moved: f64,
    /// Of the variance of the mean of N samples, by the sample variance.
    variance: f64,
}

/// Radiance is smoothed over squares of so many pixels where noise hides it.
const SIDE: usize = 8;
/// Twice the samples leave at least this share of the squared error, as far as is believed.
const LEAST: f64 = 0.125;

impl Doubling {
    /// `estimates` are those of a tile, row by row, `before` the means that they had at half as many samples.
    pub fn new(estimates: &[Estimate], before: &[[f32; 3]], width: usize) -> Doubling {
        let mut doubling = Doubling::default();
        for top in (0..estimates.len() / width).step_by(SIDE) {
            for left in (0..width).step_by(SIDE) {
                let rows = top..(top + SIDE).min(estimates.len() / width);
                let place = |row: usize| row * width + left..row * width + (left + SIDE).min(width);
                let pixels: Vec<usize> = rows.flat_map(place).collect();
                (0..3).for_each(|channel| doubling.add_square(&pixels, channel, estimates, before));
            }
        }
        doubling
    }

    /// One channel of a square of pixels.
    fn add_square(&mut self, pixels: &[usize], channel: usize, estimates: &[Estimate], before: &[[f32; 3]]) {
        let mean = |i: usize| estimates[i].mean[channel];
        let variance = |i: usize| estimates[i].variance_of_mean.map_or(0.0, |variance| variance[channel]);
        let count = pixels.len() as f64;
        let level = pixels.iter().map(|i| mean(*i)).sum::<f64>() / count;
        let noise = pixels.iter().map(|i| variance(*i)).sum::<f64>() / count;
        let spread = pixels.iter().map(|i| (mean(*i) - level).powi(2)).sum::<f64>() / count;
        // How much the radiance itself varies over the square.
        let signal = (spread - noise).max(0.0);
        for &i in pixels {
            // A pixel far brighter than its neighbours by one lucky sample must not be divided by that sample's square: its
            // radiance is taken for the likelier one of its own mean and of the square's (W. James and C. Stein 1961).
            let relative = variance(i) / (mean(i) * mean(i)).max(f64::MIN_POSITIVE);
            let trust = if variance(i) > 0.0 { (signal / (signal + variance(i))).max(1.0 - relative) } else { 1.0 };
            let radiance = level + (mean(i) - level) * trust;
            let scale = 1.0 / (radiance * radiance + REL_MSE_FLOOR);
            self.moved += (mean(i) - f64::from(before[i][channel])).powi(2) * scale;
            self.variance += variance(i) * scale;
        }
    }
}

/// The relMSE that a film of this many samples is expected to have; `None` before the second sample.
pub(super) fn rel_mse_estimate(film: &Film) -> Option<f64> {
    let spp = film.spp();
    let last = spp.checked_ilog2().filter(|k| *k > 0)?;
    let values = 3.0 * film.resolution.map(f64::from).iter().product::<f64>();
    let at = |k: u32| {
        let sum = |f: fn(&Doubling) -> f64| film.tiles.iter().map(|tile| f(&tile.doublings[k as usize - 1])).sum::<f64>();
        (sum(|doubling| doubling.moved), sum(|doubling| doubling.variance))
    };
    // Between doublings nothing is known of Sobol samples but that they are no worse than independent ones.
    let since = f64::from(1 << last) / f64::from(spp);
    Some(remaining(&(1..=last).map(at).collect::<Vec<_>>()) / values * since)
}

/// V(N) from the moves mₖ = V(2ᵏ⁻¹) − V(2ᵏ) of the doublings so far and the sample variances, which tell the moves of independent
/// samples.
///
/// V falls in turn by a factor ρ and by a factor ρ', for (0, 2)-sequences are better at even powers of two than at odd ones. With
/// r₁ = mₖ/mₖ₋₁ and r₂ = mₖ/mₖ₋₂ = ρρ' it follows that ρ = r₂(1 + r₁)/(r₁ + r₂), and V(N) = mₖ ρ/(1 − ρ). Both are taken relative to the
/// sample variances, which chance moves in the same way.
fn remaining(doublings: &[(f64, f64)]) -> f64 {
    let Some((moved, variance)) = doublings.last().filter(|(moved, variance)| *moved > 0.0 && *variance > 0.0) else { return 0.0 };
    let gain = |steps: usize| {
        let before = doublings.len().checked_sub(steps + 1).map(|at| doublings[at]).filter(|(moved, _)| *moved > 0.0);
        before.map_or(1.0, |(moved_before, variance_before)| (moved / variance) / (moved_before / variance_before))
    };
    let (r1, r2) = (0.5 * gain(1), 0.25 * gain(2).min(1.0));
    let left = (r2 * (1.0 + r1) / (r1 + r2)).clamp(LEAST, 0.5);
    moved * left / (1.0 - left)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Doublings of a process whose squared error is V(2ᵏ), with the sample variance of independent samples.
    fn doublings(v: impl Fn(u32) -> f64, count: u32) -> Vec<(f64, f64)> {
        (1..=count).map(|k| (v(k - 1) - v(k), v(0) / f64::from(1 << k))).collect()
    }

    #[test]
    fn what_remains_of_powers_of_n_is_exact() {
        for steepness in [1.0, 1.2, 1.5, 2.0] {
            let v = |k: u32| 2f64.powf(-steepness * f64::from(k));
            assert!((remaining(&doublings(v, 6)) / v(6) - 1.0).abs() < 1e-9, "{steepness}");
        }
    }

    #[test]
    fn what_remains_is_exact_where_even_powers_are_better() {
        let v = |k: u32| 2f64.powf(-1.5 * f64::from(k)) * if k % 2 == 1 { 1.2 } else { 1.0 };
        for count in [5, 6] {
            assert!((remaining(&doublings(v, count)) / v(count) - 1.0).abs() < 1e-9, "{count}");
        }
    }

    #[test]
    fn nothing_remains_where_nothing_moves() {
        assert_eq!(remaining(&[(0.0, 0.0)]), 0.0);
        assert_eq!(remaining(&[]), 0.0);
    }
}
