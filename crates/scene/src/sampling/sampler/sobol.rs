//! Owen-scrambled Sobol points: (0, 2)-sequences in base 2 with their own shuffle and scramble for every pixel and pair of
//! dimensions.
//!
//! B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020: padding by shuffled index, scrambling by hash.
use super::{
    bits::{owen_reversed, reverse, sobol_reversed},
    points::{Points, SampleKeys},
};
use crate::sampling::{
    dimension::Dimension,
    hash::{hash, unit},
};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes, U},
};

pub(super) struct Sobol;

impl Points for Sobol {
    const WORD: Word = Word {
        name: "sobol",
        title: "Sobol (Owen)",
        doc: "Owen-scrambled Sobol points, well distributed in each pair of dimensions. Usually the smallest error.",
    };

    /// Of every 2ᵏ consecutive samples, one lies in each of 2ᵏ equal intervals.
    #[inline(always)]
    fn one<L: Lanes>(keys: &SampleKeys<L>, Dimension(dimension): Dimension) -> F<L> {
        unit(reverse(one_reversed(keys, dimension)))
    }

    /// Of every 2ᵏ consecutive samples, one lies in each of the 2ᵏ equal rectangles of any grid of 2ⁱ × 2ᵏ⁻ⁱ.
    #[inline(always)]
    fn two<L: Lanes>(keys: &SampleKeys<L>, Dimension(dimension): Dimension) -> (F<L>, F<L>) {
        let [x, y] = two_reversed(keys, dimension);
        (unit(reverse(x)), unit(reverse(y)))
    }
}

/// [`Sobol::one`] as a 32-bit fraction with its bits in reverse order.
#[inline(always)]
pub(super) fn one_reversed<L: Lanes>(keys: &SampleKeys<L>, dimension: u32) -> U<L> {
    let key = keys.dimension_key(dimension);
    let shuffled = reverse(owen_reversed(keys.reversed_index(), key));
    owen_reversed(shuffled, hash(key ^ 0xa511_e9b3))
}

/// [`Sobol::two`] as 32-bit fractions with their bits in reverse order.
#[inline(always)]
pub(super) fn two_reversed<L: Lanes>(keys: &SampleKeys<L>, dimension: u32) -> [U<L>; 2] {
    scrambled(keys.reversed_index(), keys.dimension_key(dimension))
}

/// Sobol points, shuffled and scrambled by a key. The bits of both the indices and the points are reversed.
#[inline(always)]
pub(super) fn scrambled<L: Lanes>(index: U<L>, key: U<L>) -> [U<L>; 2] {
    let shuffled = reverse(owen_reversed(index, key));
    [owen_reversed(shuffled, hash(key ^ 0xa511_e9b3)), owen_reversed(sobol_reversed(shuffled), hash(key ^ 0x63d8_3595))]
}
