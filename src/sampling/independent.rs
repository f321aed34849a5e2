//! Independent uniform random numbers: plain Monte Carlo integration, whose variance is known exactly.
use super::{
    hash::{GOLDEN, hash, unit},
    sampler::Stream,
};
use crate::math::{F, Lanes};

#[inline(always)]
pub(super) fn one<L: Lanes>(stream: &Stream<L>, dimension: u32) -> F<L> {
    unit(hash(stream.sample_key() + dimension.wrapping_mul(GOLDEN)))
}

#[inline(always)]
pub(super) fn two<L: Lanes>(stream: &Stream<L>, dimension: u32) -> (F<L>, F<L>) {
    let key = stream.sample_key();
    let draw = |d: u32| key + d.wrapping_mul(GOLDEN);
    (unit(hash(draw(dimension))), unit(hash(draw(dimension + 1))))
}
