//! Progressive stratification: every 4ᵏ consecutive samples fill the 2ᵏ × 2ᵏ cells of the square once each, for every k at once.
//!
//! Progressive jittered sampling (Christensen et al., "Progressive Multi-Jittered Sample Sequences", EGSR 2018), implemented by
//! Owen scrambling of a van der Corput sequence in Morton order: it needs no table, and allows any number of samples in any
//! order.
use super::{
    bits::{even_bits, owen_reversed, reverse},
    points::{Points, SampleKeys},
    sobol::Sobol,
};
use crate::sampling::{
    dimension::Dimension,
    hash::{hash, unit},
};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

pub(super) struct Stratified;

impl Points for Stratified {
    const WORD: Word = Word {
        name: "stratified",
        title: "Stratified",
        doc: "Jittered samples: each block of 4^k samples has one in every cell of a 2^k × 2^k grid.",
    };

    // In one dimension the (0, 1)-sequence is the progressive stratification.
    #[inline(always)]
    fn one<L: Lanes>(keys: &SampleKeys<L>, dimension: Dimension) -> F<L> {
        Sobol::one(keys, dimension)
    }

    #[inline(always)]
    fn two<L: Lanes>(keys: &SampleKeys<L>, Dimension(dimension): Dimension) -> (F<L>, F<L>) {
        let key = keys.dimension_key(dimension);
        let shuffled = reverse(owen_reversed(keys.reversed_index(), key));
        let morton = reverse(owen_reversed(shuffled, hash(key ^ 0xa511_e9b3)));
        // Sixteen bits of a coordinate select the cell; the lower bits are a random position within it.
        let jitter = hash(keys.sample_key() ^ key);
        let x = (even_bits(morton >> 1) << 16) | (jitter & 0xffff);
        let y = (even_bits(morton) << 16) | (jitter >> 16);
        (unit(x), unit(y))
    }
}
