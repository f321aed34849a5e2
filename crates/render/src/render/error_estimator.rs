//! Estimates the remaining error from the change of the image as the sample count doubles.
//!
//! For independent samples, the sample variance is sufficient. The error of stratified and Sobol samples is smaller, by a factor
//! that shows only over the whole image. Let V(N) be the squared error of the mean of N samples. If the second half of the
//! samples is as good as the first, E|I_N − I_{N/2}|² = V(N/2) − V(N): see [`remaining`] for the derivation of V(N) from these
//! differences.
use rayon::prelude::*;

use super::{block::Block, estimate::SquaredRadiance, film::Film, region::Region, scatter::VarianceParts, tile::Tile};
use noisefall_kernel::measure::{BlockErrors, Floor};

/// The standard error of the natural logarithm of the estimate, beside chance: of samples that are not independent, how the error
/// falls is a guess.
pub const MODEL_ERROR: f64 = 0.11;

/// Lower bound of the remaining error, as a fraction of the last move.
const LEAST: f64 = 0.15;

/// The weight of the law of factors in the mean of both laws. A fit to every other shipped scene gives 0.68, and the error of the
/// estimate in the others is then 11 % (root mean square), as with the best weight for these, 0.84: the choice hardly matters.
const FACTORS: f64 = 0.65;

/// Fewest effective samples that make the variance an estimate. Before, the light that causes the noise may not have been found.
const FEWEST: f64 = 8.0;
/// The number of samples per pixel from which on a film that has found fewer is taken as it is, so that renders of black scenes
/// to a noise target end.
const ENOUGH: u32 = 1024;

/// Records the moves of blocks whose sample counts have just become a power of two. The floor of relMSE is that of the whole
/// image, so this waits until all tiles are ready: no block takes another sample before. Returns whether it is complete; after an
/// interruption it continues later.
pub(super) fn note(film: &mut Film, interrupted: &(dyn Fn() -> bool + Sync)) -> bool {
    let due = film.tiles.iter().flat_map(|tile| &tile.blocks).filter(|block| block.has_doubled());
    let Some(most) = due.map(|block| block.spp).max() else { return true };
    // The first sample has no error yet to be relative to anything.
    let mean_square = if most > 1 { mean_square(film, interrupted) } else { Some(0.0) };
    let Some(floor) = mean_square.map(|mean_square| Floor::DEFAULT.of(mean_square)) else { return false };
    let note = |tile: &mut Tile| {
        let goes_on = !interrupted();
        if goes_on {
            tile.double(floor);
        }
        goes_on
    };
    film.tiles.par_iter_mut().map(note).reduce(|| true, |a, b| a && b)
}

/// Estimates the mean over pixels and channels of the squared radiance from the samples; `None` if it was interrupted.
fn mean_square(film: &Film, interrupted: &(dyn Fn() -> bool + Sync)) -> Option<f64> {
    let squares = |tile: &Tile| (!interrupted()).then(|| tile.squares());
    let sums = film.tiles.par_iter().map(squares).collect::<Option<Vec<SquaredRadiance>>>()?;
    Some(sums.into_iter().fold(SquaredRadiance::default(), SquaredRadiance::plus).mean(film.resolution))
}

/// The expected relMSE of a film; `None` before the second sample, and while too few samples have found light.
pub(super) fn rel_mse_estimate(film: &Film) -> Option<f64> {
    let all = Region { from: [0, 0], to: film.resolution };
    rel_mse_estimate_in(film, &all)
}

/// The expected relMSE of the tiles in a region.
pub(super) fn rel_mse_estimate_in(film: &Film, region: &Region) -> Option<f64> {
    let tiles = || film.tiles.iter().filter(|tile| tile.lies_in(region));
    let doubled = tiles().flat_map(|tile| &tile.blocks).map(|block| block.doubled).min()?;
    let is_known = doubled >= ENOUGH || doubled >= 2 && has_found_light(&tiles);
    is_known.then(|| tiles().map(Sums::of).fold(Sums::default(), |a, b| a.plus(&b, 1.0)).estimate())
}

/// Whether the variance comes from enough samples that differ. Without any noise, all pixels must have found light.
fn has_found_light<'a, I: Iterator<Item = &'a Tile>>(tiles: &impl Fn() -> I) -> bool {
    let effective = VarianceParts::effective_count(tiles().flat_map(Tile::parts));
    let is_lit = |tile: &Tile| tile.sum.iter().all(|sum| *sum != [0.0; 3]);
    if effective.is_finite() { effective >= FEWEST } else { tiles().all(is_lit) }
}

/// The expected relMSE of a film, and the same without each of its tiles; `None` where that is.
pub(super) fn block_errors(film: &Film) -> Option<BlockErrors> {
    let whole = rel_mse_estimate(film)?;
    let sums: Vec<Sums> = film.tiles.iter().map(Sums::of).collect();
    let all = sums.iter().fold(Sums::default(), |a, b| a.plus(b, 1.0));
    Some(BlockErrors { whole, without: sums.iter().map(|tile| all.plus(tile, -1.0).estimate()).collect() })
}

/// Input of the estimate from some tiles.
#[derive(Clone, Copy, Default)]
struct Sums {
    /// Moves and variances at the last three doublings, latest first.
    doublings: [(f64, f64); 3],
    /// The variances of now.
    now: f64,
    /// Pixels times channels.
    values: f64,
}

impl Sums {
    fn of(tile: &Tile) -> Sums {
        let back = |steps: usize| {
            let doubled = tile.blocks.iter().filter(|block| block.doubled.ilog2() as usize > steps);
            let doublings = doubled.map(|block| block.doublings[steps]);
            doublings.fold((0.0, 0.0), |(moved, variance), doubling| (moved + doubling.moved, variance + doubling.variance))
        };
        // Between doublings nothing is known of Sobol samples but that they are no worse than independent ones.
        let since = |block: &Block| f64::from(block.doubled) / f64::from(block.spp);
        Sums {
            doublings: [0, 1, 2].map(back),
            now: tile.blocks.iter().map(|block| block.doublings[0].variance * since(block)).sum(),
            values: 3.0 * tile.size.map(f64::from).iter().product::<f64>(),
        }
    }

    fn plus(&self, other: &Sums, sign: f64) -> Sums {
        let sum = |step: usize| {
            let ((moved, variance), (of_moved, of_variance)) = (self.doublings[step], other.doublings[step]);
            (moved + sign * of_moved, variance + sign * of_variance)
        };
        Sums { doublings: [0, 1, 2].map(sum), now: self.now + sign * other.now, values: self.values + sign * other.values }
    }

    fn estimate(&self) -> f64 {
        let doublings: Vec<_> = self.doublings.into_iter().rev().filter(|(_, variance)| *variance > 0.0).collect();
        let Some((_, last)) = doublings.last() else { return 0.0 };
        remaining(&doublings) * self.now / last / self.values
    }
}

/// V(N) from the moves mₖ = V(2ᵏ⁻¹) − V(2ᵏ) and the sample variances at the doublings so far: the geometric mean of two laws, of
/// which one mostly gives too much and the other too little.
///
/// Moves are measured in units of sample variances, which fall as 1/N and fluctuate in the same way.
fn remaining(doublings: &[(f64, f64)]) -> f64 {
    let Some((_, variance)) = doublings.last() else { return 0.0 };
    let q = |steps: usize| {
        let (moved, variance) = doublings.len().checked_sub(steps + 1).map_or((1.0, 1.0), |at| doublings[at]);
        if variance > 0.0 { moved / variance } else { 0.0 }
    };
    let moves = [q(0), 2.0 * q(1), 4.0 * q(2)];
    let [least, most] = [LEAST * q(0), q(0).max(q(1))];
    let within = |left: f64| left.max(least).min(most);
    variance * within(by_two_powers(moves)).powf(1.0 - FACTORS) * within(by_factors(moves)).powf(FACTORS)
}

/// The remaining error after the moves [mₖ, mₖ₋₁, mₖ₋₂] if V = a/N + b/N², the errors of independent and of well stratified
/// coordinates.
///
/// m = a/N + 3b/N², so two moves determine a and b: V(N) = (5 mₖ − mₖ₋₁)/3, or from one doubling before V(N) = (5 mₖ₋₁ − mₖ₋₂)/3
/// − mₖ; the result is the mean of both, because (0, 2)-sequences are better at even powers of two than at odd ones.
fn by_two_powers([last, before, first]: [f64; 3]) -> f64 {
    (2.0 * last + 4.0 * before - first) / 6.0
}

/// The remaining error if V falls alternately by a factor ρ and by a factor ρ'.
///
/// With r₁ = mₖ/mₖ₋₁ and r₂ = mₖ/mₖ₋₂ = ρρ' it follows that ρ = r₂(1 + r₁)/(r₁ + r₂), and V(N) = mₖ ρ/(1 − ρ).
fn by_factors([last, before, first]: [f64; 3]) -> f64 {
    let (r1, r2) = (last / before, (last / first).min(0.25));
    let factor = r2 * (1.0 + r1) / (r1 + r2);
    if factor < 1.0 { last * factor / (1.0 - factor) } else { last }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moves up to V(2ᵏ).
    fn moves(v: impl Fn(i32) -> f64, k: i32) -> [f64; 3] {
        [0, 1, 2].map(|steps| v(k - steps - 1) - v(k - steps))
    }

    #[test]
    fn each_law_is_exact_where_it_holds() {
        for share in [0.0, 0.2, 1.0] {
            let v = |k: i32| (1.0 - share) * 2f64.powi(-k) + share * 4f64.powi(-k);
            assert!((by_two_powers(moves(v, 6)) / v(6) - 1.0).abs() < 1e-9, "{share}");
        }
        for (factor, other) in [(0.5, 0.5), (0.25, 0.25), (0.2, 0.4), (0.4, 0.2f64)] {
            let v = |k: i32| (factor * other).powi(k / 2) * if k % 2 == 1 { factor } else { 1.0 };
            assert!((by_factors(moves(v, 6)) / v(6) - 1.0).abs() < 1e-9, "{factor} {other}");
        }
    }

    #[test]
    fn independent_samples_leave_the_error_that_their_variance_predicts() {
        let doublings: Vec<_> = (1..7).map(|k| (2f64.powi(-k), 2f64.powi(-k))).collect();
        for count in 1..6 {
            assert!((remaining(&doublings[..count]) * 2f64.powi(count as i32) - 1.0).abs() < 1e-9, "{count}");
        }
    }

    #[test]
    fn nothing_remains_where_nothing_moves() {
        assert_eq!(remaining(&[(0.0, 0.0)]), 0.0);
        assert_eq!(remaining(&[]), 0.0);
    }

    #[test]
    fn the_remaining_error_is_a_mean_of_both_laws_within_its_bounds() {
        // In units of variances: (2·½ + 4·2 − 4)/6 and ½ ρ/(1 − ρ), ρ = (1/8)(5/4)/(3/8).
        let once = remaining(&[(0.1, 0.2)]);
        assert!((once - 0.2 * (5.0f64 / 6.0).powf(0.35) * (5.0f64 / 14.0).powf(0.65)).abs() < 1e-12, "{once}");
        // The law of powers of two says less than nothing: 15 % of the last move.
        let least = remaining(&[(4.0, 4.0), (0.2, 2.0), (1.0, 1.0)]);
        assert!((least - 0.15f64.powf(0.35) * 0.4f64.powf(0.65)).abs() < 1e-12, "{least}");
        // It says 1.7: more than the larger of the last two moves.
        let most = remaining(&[(0.0, 1.0), (1.0, 1.0), (1.2, 1.0)]);
        let factors = 1.2 * (0.25 * 1.6 / 0.85) / (1.0 - 0.25 * 1.6 / 0.85);
        let powers = ((2.0 * 1.2 + 4.0 * 2.0) / 6.0f64).min(1.2);
        assert!((most - powers.powf(0.35) * f64::min(factors, 1.2).powf(0.65)).abs() < 1e-12, "{most}");
    }
}
