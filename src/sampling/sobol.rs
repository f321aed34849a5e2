//! Owen-scrambled Sobol points: (0, 2)-sequences in base 2, shuffled and scrambled anew for every pixel and pair of dimensions.
//!
//! B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020: padding by shuffled index, scrambling by hash.
use super::{
    bits::{owen_reversed, reverse, sobol_reversed},
    hash::{hash, unit},
    sampler::Stream,
};
use crate::math::{F, Lanes};

/// Every 2ᵏ consecutive samples have one in each of 2ᵏ equal intervals.
#[inline(always)]
pub(super) fn one<L: Lanes>(stream: &Stream<L>, dimension: u32) -> F<L> {
    let key = stream.dimension_key(dimension);
    let shuffled = reverse(owen_reversed(stream.reversed_index(), key));
    unit(reverse(owen_reversed(shuffled, hash(key ^ 0xa511_e9b3))))
}

/// Every 2ᵏ consecutive samples have one in each of the 2ᵏ equal rectangles, of whatever shape 2ⁱ × 2ᵏ⁻ⁱ.
#[inline(always)]
pub(super) fn two<L: Lanes>(stream: &Stream<L>, dimension: u32) -> (F<L>, F<L>) {
    let key = stream.dimension_key(dimension);
    let shuffled = reverse(owen_reversed(stream.reversed_index(), key));
    let x = reverse(owen_reversed(shuffled, hash(key ^ 0xa511_e9b3)));
    let y = reverse(owen_reversed(sobol_reversed(shuffled), hash(key ^ 0x63d8_3595)));
    (unit(x), unit(y))
}

/// Two coordinates of a point of more dimensions, given with reversed bits, scrambled anew for every pixel but not shuffled: the
/// coordinates stay together.
#[inline(always)]
pub(super) fn joint<L: Lanes>(stream: &Stream<L>, dimension: u32, [x, y]: [u32; 2]) -> (F<L>, F<L>) {
    let key = stream.dimension_key(dimension);
    let x = owen_reversed(stream.splat(x), hash(key ^ 0xa511_e9b3));
    let y = owen_reversed(stream.splat(y), hash(key ^ 0x63d8_3595));
    (unit(reverse(x)), unit(reverse(y)))
}
