//! Counter-based random numbers: integer hashes in lanes.
use noisefall_base::math::{F, Lanes, U};

/// The odd integer nearest 2³²/φ, whose consecutive multiples are evenly spread.
pub const GOLDEN: u32 = 0x9e37_79b9;

/// A 32-bit permutation that avalanches every bit. Constants: C. Wellons, "Prospecting for hash functions" (2018), `lowbias32`.
#[inline(always)]
pub fn hash<L: Lanes>(x: U<L>) -> U<L> {
    let x = (x ^ (x >> 16)) * 0x7feb_352d;
    let x = (x ^ (x >> 15)) * 0x846c_a68b;
    x ^ (x >> 16)
}

/// [`hash`] of one number.
#[inline]
pub fn hash_one(x: u32) -> u32 {
    hash(U::<noisefall_base::math::One>(x)).0
}

/// The upper 23 bits as the midpoint of one of 2²³ equal cells of (0, 1): never 0, never 1, mean exactly ½.
#[inline(always)]
pub fn unit<L: Lanes>(x: U<L>) -> F<L> {
    const ONE_LESS_HALF_A_CELL: f32 = 1.0 - f32::EPSILON / 2.0;
    ((x >> 9) | 0x3f80_0000).as_real_bits() - ONE_LESS_HALF_A_CELL
}
