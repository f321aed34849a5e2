//! The alias method: samples a cell in proportion to its weight, in constant time.
//!
//! M. D. Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", IEEE TSE 17(9), 1991. The toss of a
//! coin selects either the entry's own cell or another, its alias.
use noisefall_base::math::{F, Lanes, Pick, U, round::floor};

/// Thresholds are multiples of this number, and coins are the midpoints between multiples, so probabilities are exact.
const COIN: f64 = 1.0 / 8_388_608.0;
/// Combined with an index, these bits are a real number with the index in its mantissa.
const INDEX_BITS: u32 = 0x4b00_0000;
const INDEX_MASK: u32 = 0x007f_ffff;

/// A table of cells with their probabilities.
pub struct AliasTable {
    /// An entry: threshold of the coin, alias as bits, the probabilities of the cell itself and of its alias.
    rows: Vec<[f32; 4]>,
}

impl AliasTable {
    /// Builds a table. The number of weights is a power of two up to 2²³; no weight is negative, and at least one is positive.
    pub fn new(weights: &[f64]) -> AliasTable {
        let count = weights.len();
        assert!(count.is_power_of_two() && count <= 1 << 23, "{count} cells");
        let (thresholds, aliases) = fair_coins(weights);
        // The table samples with rounded thresholds, so the probabilities follow from these and not from the weights.
        let mut probabilities: Vec<f64> = thresholds.iter().map(|threshold| threshold / count as f64).collect();
        for (threshold, alias) in thresholds.iter().zip(&aliases) {
            probabilities[*alias] += (1.0 - threshold) / count as f64;
        }
        let row = |cell: usize| {
            let alias = aliases[cell];
            let bits = f32::from_bits(INDEX_BITS | alias as u32);
            [thresholds[cell] as f32, bits, probabilities[cell] as f32, probabilities[alias] as f32]
        };
        AliasTable { rows: (0..count).map(row).collect() }
    }

    /// Samples a cell, and returns it with its probability. The index and the coin are [unit](super::hash::unit) random numbers.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, (index, coin): (F<L>, F<L>)) -> (U<L>, F<L>) {
        let (_, entry) = floor(index * self.rows.len() as f32);
        let [threshold, alias, own, other] = l.rows(&self.rows, entry);
        let keep = coin.lt(threshold);
        (keep.pick(entry, alias.bits() & INDEX_MASK), keep.pick(own, other))
    }

    /// Probability of a cell.
    #[inline(always)]
    pub fn probability<L: Lanes>(&self, l: L, cell: U<L>) -> F<L> {
        let [_, _, own, _] = l.rows(&self.rows, cell);
        own
    }
}

/// Returns for every cell the probability of keeping it, positive where its weight is positive, and its alias.
fn fair_coins(weights: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let mean = weights.iter().sum::<f64>() / weights.len() as f64;
    let mut rest: Vec<f64> = weights.iter().map(|weight| weight / mean).collect();
    let heaviest = (0..rest.len()).max_by(|a, b| rest[*a].total_cmp(&rest[*b])).unwrap_or(0);
    let mut aliases = vec![heaviest; rest.len()];
    let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..rest.len()).partition(|cell| rest[*cell] < 1.0);
    while let (Some(poor), Some(rich)) = (small.pop(), large.pop()) {
        aliases[poor] = rich;
        rest[rich] -= 1.0 - rest[poor];
        if rest[rich] < 1.0 { small.push(rich) } else { large.push(rich) }
    }
    let threshold = |(rest, weight): (&f64, &f64)| {
        let least = if *weight > 0.0 { COIN } else { 0.0 };
        ((rest / COIN).round() * COIN).clamp(least, 1.0)
    };
    let thresholds = rest.iter().zip(weights).map(threshold).collect();
    (thresholds, aliases)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A coin falls on midpoints of multiples: chances are exact, and what has no weight has none.
    #[test]
    fn thresholds_are_multiples_of_the_coin_and_0_where_the_weight_is_0() {
        let weights = [0.0, 0.3, 1e-12, 2.0, 0.7, 0.0, 0.1, 0.111];
        let (thresholds, aliases) = fair_coins(&weights);
        for (cell, threshold) in thresholds.iter().enumerate() {
            assert_eq!((threshold / COIN).fract(), 0.0, "{cell}");
            assert_eq!(*threshold > 0.0, weights[cell] > 0.0, "{cell}");
            assert!(weights[aliases[cell]] > 0.0, "{cell} gives way to what has no weight");
        }
    }
}
