//! Sobol points whose error is blue noise over the image at low sample counts. Neighbouring pixels err in opposite directions, so
//! an average over pixels, such as the eye takes, has less noise than a single pixel.
//!
//! The first samples of all pixels are one Owen-scrambled Sobol sequence along the Z-curve (A. G. M. Ahmed and P. Wonka,
//! "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels", SIGGRAPH Asia 2020).
//! Their method needs the number of samples in advance. Here an exclusive or shifts every pixel's own sequence so that its first
//! point is that of the curve. The shift preserves all strata of the pixel, which therefore converges like Sobol points, and the
//! blue noise fades as samples are added. Beyond the third surface, paths differ too much for blue noise.
use super::{
    bits::{reverse, spread_bits},
    points::{Points, SampleKeys},
    sobol,
};
use crate::sampling::{
    dimension::Dimension,
    hash::{hash_one, unit},
};
use noisefall_base::{
    declare::Word,
    math::{F, Lanes, U},
};

pub(super) struct BlueNoise;

impl Points for BlueNoise {
    const WORD: Word = Word {
        name: "bluenoise",
        title: "Sobol, blue noise",
        doc: "Sobol points, ordered over the image so that the noise of few samples is fine-grained.",
    };

    #[inline(always)]
    fn one<L: Lanes>(keys: &SampleKeys<L>, dimension: Dimension) -> F<L> {
        let point = sobol::one_reversed(keys, dimension.0);
        if !dimension.is_near() {
            return unit(reverse(point));
        }
        let first = sobol::one_reversed(&keys.first(), dimension.0);
        unit(reverse(point ^ first ^ on_curve(keys, dimension.0)[0]))
    }

    #[inline(always)]
    fn two<L: Lanes>(keys: &SampleKeys<L>, dimension: Dimension) -> (F<L>, F<L>) {
        let [x, y] = sobol::two_reversed(keys, dimension.0);
        if !dimension.is_near() {
            return (unit(reverse(x)), unit(reverse(y)));
        }
        let [first_x, first_y] = sobol::two_reversed(&keys.first(), dimension.0);
        let [curve_x, curve_y] = on_curve(keys, dimension.0);
        (unit(reverse(x ^ first_x ^ curve_x)), unit(reverse(y ^ first_y ^ curve_y)))
    }
}

/// The points of the shared sequence at the pixels' positions on the Z-curve, with reversed bits.
#[inline(always)]
fn on_curve<L: Lanes>(keys: &SampleKeys<L>, dimension: u32) -> [U<L>; 2] {
    let place = spread_bits(keys.pixel & 0xffff) | (spread_bits(keys.pixel >> 16) << 1);
    sobol::scrambled(reverse(place), keys.splat(hash_one(keys.salt ^ hash_one(dimension))))
}
