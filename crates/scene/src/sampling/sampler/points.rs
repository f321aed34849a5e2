//! The trait of samplers: the points of a pixel's samples, derived from hashes of seed, pixel and sample index.
use super::bits::reverse;
use crate::sampling::{
    dimension::Dimension,
    hash::{GOLDEN, hash, hash_one},
};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes, U},
};

/// The points of a sampler.
pub(super) trait Points {
    const WORD: Word;

    /// Whether the samples of a pixel are independent of each other.
    const INDEPENDENT: bool = false;

    /// One coordinate, in (0, 1).
    fn one<L: Lanes>(keys: &SampleKeys<L>, dimension: Dimension) -> F<L>;

    /// Two coordinates, each in (0, 1).
    fn two<L: Lanes>(keys: &SampleKeys<L>, dimension: Dimension) -> (F<L>, F<L>);
}

/// Hashes of a sample of several pixels, one pixel per lane, from which samplers derive its coordinates.
#[derive(Clone, Copy)]
pub struct SampleKeys<L: Lanes> {
    pub(super) pixel: U<L>,
    pixel_key: U<L>,
    /// A hash of the seed.
    pub(super) salt: u32,
    index: U<L>,
    /// The index with its bits in reverse order.
    reversed: U<L>,
}

impl<L: Lanes> SampleKeys<L> {
    /// Computes the hashes. `pixel` is y·2¹⁶ + x, so a pixel keeps its random numbers when the resolution changes.
    #[inline(always)]
    pub fn new(seed: u32, pixel: U<L>, index: U<L>) -> Self {
        // Each seed has its own factor: with addition alone, one seed's noise would be a shifted copy of another's.
        let salt = hash_one(seed ^ GOLDEN);
        let pixel_key = hash(pixel * (hash_one(salt) | 1) + salt);
        SampleKeys { pixel, pixel_key, salt, index, reversed: reverse(index) }
    }

    /// The first sample of the same pixels.
    #[inline(always)]
    pub(super) fn first(&self) -> Self {
        SampleKeys { index: self.splat(0), reversed: self.splat(0), ..*self }
    }

    /// A hash of pixel and sample, distinct for every sample of a pixel.
    #[inline(always)]
    pub(super) fn sample_key(&self) -> U<L> {
        hash(self.pixel_key + self.index * GOLDEN)
    }

    /// A hash of pixel and dimension.
    #[inline(always)]
    pub(super) fn dimension_key(&self, dimension: u32) -> U<L> {
        // The constant differs from that of the sample's key: otherwise index n and dimension n would share a hash.
        hash((self.pixel_key ^ 0x6a09_e667) + dimension.wrapping_mul(GOLDEN))
    }

    #[inline(always)]
    pub(super) fn reversed_index(&self) -> U<L> {
        self.reversed
    }

    #[inline(always)]
    pub(super) fn splat(&self, x: u32) -> U<L> {
        U(L::splat_int(self.pixel_key.0, x))
    }
}
