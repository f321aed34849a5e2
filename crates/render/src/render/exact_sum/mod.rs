//! Sums that do not depend on the order or the grouping of their terms, so that parts of a render join to the same bits.
//!
//! They are binned sums (J. Demmel and H. D. Nguyen, "Parallel Reproducible Summation", IEEE Transactions on Computers 2015). Bins
//! are 40 bits wide and have fixed borders. Each value is rounded to a multiple of 2⁴⁰ᵏ in its bin k, and the remainder to a multiple
//! of 2⁴⁰⁽ᵏ⁻¹⁾ in the bin below. A sum keeps two bins: that of its largest value, and the one below. The multiples are added as
//! integers, which is associative. When a larger value arrives, a bin is dropped, as if it had never been kept. So the result
//! depends on the multiset of the values alone.
//!
//! Each value is rounded by at most 2⁻⁴⁰ of the largest one.
use std::ops::Range;

/// Number of values that a sum can take without an overflow.
pub const MOST_VALUES: u32 = 1 << 23;
/// Number of bins: from the smallest square of an f32, 2⁻²⁹⁸, to the squared sum of a tile.
pub const BINS: u16 = 15;
/// Upper bound of the relative error of a sum of equal values.
pub const RESOLUTION: f64 = 1.0 / (1u64 << 39) as f64;
/// Bits of a bin.
const WIDTH: u32 = 40;
/// Exponent of the unit below the lowest bin. The squares of all f32 are multiples of it.
const LOWEST: u64 = 1023 - 320;
/// Bits of an f64 below its exponent.
const MANTISSA: u32 = 52;
/// Bits of an f64 below those that tell bins apart.
const BELOW: u32 = 48;
/// The difference between two bins, in the upper 16 bits of an f64.
const STEP: u16 = (WIDTH as u16) << (MANTISSA - BELOW);

/// Sums of numbers from 0 to 2³¹⁸.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExactSums {
    /// Multiples of the unit of each sum's bin.
    high: Vec<i64>,
    /// Multiples of the unit of the bin below.
    low: Vec<i64>,
    /// The bins, from the smallest numbers up, times [`STEP`]: the constants of a bin are then one addition away.
    bins: Vec<u16>,
}

impl ExactSums {
    /// Bytes of a sum.
    pub const BYTES: u64 = 18;

    /// This many sums of no values.
    pub fn new(count: usize) -> ExactSums {
        ExactSums { high: vec![0; count], low: vec![0; count], bins: vec![0; count] }
    }

    /// The sums with these multiples and bins; `None` if `count` values cannot have them.
    pub fn from_parts(high: Vec<i64>, low: Vec<i64>, bins: &[u8], count: u64) -> Option<ExactSums> {
        let most = count.min(MOST_VALUES.into()) << (WIDTH - 1);
        let are_sound = bins.iter().all(|bin| u16::from(*bin) < BINS)
            && high.iter().all(|high| (0..=most as i64).contains(high))
            && low.iter().all(|low| low.unsigned_abs() <= most)
            && [high.len(), low.len()] == [bins.len(); 2];
        let bins = || bins.iter().map(|bin| u16::from(*bin) * STEP).collect();
        are_sound.then(|| ExactSums { bins: bins(), high, low })
    }

    /// The multiples of the units of the bins and of those below, and the bins.
    pub fn parts(&self) -> (&[i64], &[i64], impl Iterator<Item = u8>) {
        (&self.high, &self.low, self.bins.iter().map(|bin| (bin / STEP) as u8))
    }

    /// Adds values to the sums from `first` on. Inlined, so that callers for every instruction set have it in theirs.
    #[inline(always)]
    pub fn add(&mut self, first: usize, values: &[f64]) {
        let range = first..first + values.len();
        let bins = &self.bins[range.clone()];
        // Without an early end, so that it is vectorized.
        let are_below_limits = bins.iter().zip(values).fold(true, |all, (bin, value)| all & (*value < limit(*bin)));
        if !are_below_limits {
            self.raise_for(first, values);
        }
        let sums = self.high[range.clone()].iter_mut().zip(&mut self.low[range.clone()]).zip(&self.bins[range]);
        for (((high, low), bin), value) in sums.zip(values) {
            let [of_bin, of_bin_below] = rounders(*bin);
            let (multiple, rest) = rounded(*value, of_bin);
            *high = high.wrapping_add(multiple);
            *low = low.wrapping_add(rounded(rest, of_bin_below).0);
        }
    }

    /// Adds the values of as many other sums.
    pub fn merge(&mut self, other: &ExactSums) {
        for i in 0..self.bins.len().min(other.bins.len()) {
            let bin = self.bins[i].max(other.bins[i]);
            self.raise(i, bin);
            let [high, low] = raised([other.high[i], other.low[i]], bin - other.bins[i]);
            self.high[i] = self.high[i].wrapping_add(high);
            self.low[i] = self.low[i].wrapping_add(low);
        }
    }

    /// A sum, rounded to the nearest number.
    #[inline]
    pub fn value(&self, i: usize) -> f64 {
        let multiple = (i128::from(self.high[i]) << WIDTH) + i128::from(self.low[i]);
        let unit = f64::from_bits((LOWEST << MANTISSA) + (u64::from(self.bins[i]) << BELOW));
        multiple as f64 * unit
    }

    /// A sum after three roundings. It takes a fraction of the time of [`ExactSums::value`], and is a function of the sum, too.
    #[inline]
    pub fn quick_value(&self, i: usize) -> f64 {
        const BIN: f64 = (1u64 << WIDTH) as f64;
        let unit = f64::from_bits((LOWEST << MANTISSA) + (u64::from(self.bins[i]) << BELOW));
        self.high[i] as f64 * (unit * BIN) + self.low[i] as f64 * unit
    }

    /// Some sums, rounded to the nearest numbers.
    pub fn values(&self, range: Range<usize>) -> impl Iterator<Item = f64> {
        range.map(|i| self.value(i))
    }

    #[cold]
    #[inline(never)]
    fn raise_for(&mut self, first: usize, values: &[f64]) {
        for (i, value) in (first..).zip(values) {
            let bin = (0..BINS).map(|bin| bin * STEP).find(|bin| *value < limit(*bin)).unwrap_or((BINS - 1) * STEP);
            self.raise(i, self.bins[i].max(bin));
        }
    }

    /// Drops the bins of a sum that a larger bin leaves no room for.
    fn raise(&mut self, i: usize, bin: u16) {
        [self.high[i], self.low[i]] = raised([self.high[i], self.low[i]], bin - self.bins[i]);
        self.bins[i] = bin;
    }
}

/// The multiples of a sum whose bin is raised.
fn raised([high, low]: [i64; 2], by: u16) -> [i64; 2] {
    match by {
        0 => [high, low],
        STEP => [0, high],
        _ => [0; 2],
    }
}

/// Values in a bin are smaller than this. Half the unit of the bin above: that would round them to 0.
#[inline(always)]
fn limit(bin: u16) -> f64 {
    const FIRST: u64 = (LOWEST + 2 * WIDTH as u64 - 1) << MANTISSA;
    f64::from_bits(FIRST + (u64::from(bin) << BELOW))
}

/// 3·2⁵¹ units of a bin and of the one below. A number that is added to it is rounded to units, which are the last bits of the sum.
#[inline(always)]
fn rounders(bin: u16) -> [f64; 2] {
    const FIRST: u64 = ((LOWEST + MANTISSA as u64) << MANTISSA) + (1 << (MANTISSA - 1));
    let below = FIRST + (u64::from(bin) << BELOW);
    [below + (u64::from(WIDTH) << MANTISSA), below].map(f64::from_bits)
}

/// The nearest multiple of a unit, and the remainder.
#[inline(always)]
fn rounded(value: f64, rounder: f64) -> (i64, f64) {
    let sum = value + rounder;
    (sum.to_bits().wrapping_sub(rounder.to_bits()) as i64, value - (sum - rounder))
}

#[cfg(test)]
mod tests;
