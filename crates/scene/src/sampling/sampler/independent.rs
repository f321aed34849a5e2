//! Independent uniform random numbers: plain Monte Carlo integration, whose variance is known exactly.
use super::points::{Points, SampleKeys};
use crate::sampling::{
    dimension::Dimension,
    hash::{GOLDEN, hash, unit},
};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes},
};

pub(super) struct Independent;

impl Points for Independent {
    const WORD: Word = Word {
        name: "independent",
        title: "Independent",
        doc: "Independent random numbers: plain Monte Carlo. The error falls as 1/√N.",
    };
    const INDEPENDENT: bool = true;

    #[inline(always)]
    fn one<L: Lanes>(keys: &SampleKeys<L>, Dimension(dimension): Dimension) -> F<L> {
        unit(hash(keys.sample_key() + dimension.wrapping_mul(GOLDEN)))
    }

    #[inline(always)]
    fn two<L: Lanes>(keys: &SampleKeys<L>, Dimension(dimension): Dimension) -> (F<L>, F<L>) {
        let key = keys.sample_key();
        let draw = |d: u32| key + d.wrapping_mul(GOLDEN);
        (unit(hash(draw(dimension))), unit(hash(draw(dimension + 1))))
    }
}
