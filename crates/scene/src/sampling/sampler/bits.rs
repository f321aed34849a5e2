//! Bit patterns of low-discrepancy sequences, in lanes.
use noisefall_base::math::{Lanes, U};

/// The 32 bits in reverse order.
#[inline(always)]
pub fn reverse<L: Lanes>(x: U<L>) -> U<L> {
    let x = ((x >> 1) & 0x5555_5555) | ((x & 0x5555_5555) << 1);
    let x = ((x >> 2) & 0x3333_3333) | ((x & 0x3333_3333) << 2);
    let x = ((x >> 4) & 0x0f0f_0f0f) | ((x & 0x0f0f_0f0f) << 4);
    let x = ((x >> 8) & 0x00ff_00ff) | ((x & 0x00ff_00ff) << 8);
    (x >> 16) | (x << 16)
}

/// Owen scrambling of a number with reversed bits: a random nested permutation in which each bit is flipped depending on the
/// *lower* ones.
///
/// S. Laine and T. Karras, "Stratified Sampling for Stochastic Transparency" (2011), with the constants of
/// N. Vegdahl, "Building a Better LK Hash" (2021).
#[inline(always)]
pub fn owen_reversed<L: Lanes>(x: U<L>, seed: U<L>) -> U<L> {
    let x = x ^ (x * 0x3d20_adea);
    let x = x + seed;
    let x = x * ((seed >> 16) | 1);
    let x = x ^ (x * 0x0552_6c56);
    x ^ (x * 0x53a2_2864)
}

/// The second Sobol dimension of index `x`, with its bits reversed: the product with Pascal's triangle modulo 2, by doubling.
#[inline(always)]
pub fn sobol_reversed<L: Lanes>(x: U<L>) -> U<L> {
    let x = x ^ ((x & 0xaaaa_aaaa) >> 1);
    let x = x ^ ((x & 0xcccc_cccc) >> 2);
    let x = x ^ ((x & 0xf0f0_f0f0) >> 4);
    let x = x ^ ((x & 0xff00_ff00) >> 8);
    x ^ ((x & 0xffff_0000) >> 16)
}

/// Spreads the lower half of the bits of `x` to the even bits: the inverse of [`even_bits`]. The upper half of `x` must be 0.
#[inline(always)]
pub fn spread_bits<L: Lanes>(x: U<L>) -> U<L> {
    let x = (x | (x << 8)) & 0x00ff_00ff;
    let x = (x | (x << 4)) & 0x0f0f_0f0f;
    let x = (x | (x << 2)) & 0x3333_3333;
    (x | (x << 1)) & 0x5555_5555
}

/// Gathers the even bits of `x` in the lower half: one coordinate of a Morton code.
#[inline(always)]
pub fn even_bits<L: Lanes>(x: U<L>) -> U<L> {
    let x = x & 0x5555_5555;
    let x = (x | (x >> 1)) & 0x3333_3333;
    let x = (x | (x >> 2)) & 0x0f0f_0f0f;
    let x = (x | (x >> 4)) & 0x00ff_00ff;
    (x | (x >> 8)) & 0x0000_ffff
}
