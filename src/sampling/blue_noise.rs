//! Sobol points whose error is blue noise over the image at low sample counts. Neighbouring pixels err in opposite directions, so
//! an average over pixels, such as the eye takes, has less noise than its pixels.
//!
//! The first samples of all pixels are one Owen-scrambled Sobol sequence along the Z-curve (A. G. M. Ahmed and P. Wonka,
//! "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels", SIGGRAPH Asia 2020).
//! Their method needs the number of samples in advance. Here an exclusive or shifts every pixel's own sequence so that its first
//! point is that of the curve. The shift preserves all strata of the pixel, which therefore converges like Sobol points, and the
//! blue noise fades as samples are added. Beyond the third surface, paths differ too much for blue noise.
use super::{
    bits::{reverse, spread_bits},
    hash::{hash_one, unit},
    sampler::{Dimension, Points, Stream},
    sobol,
};
use crate::{
    declare::Word,
    math::{F, Lanes, U},
};

pub(super) struct BlueNoise;

impl Points for BlueNoise {
    const WORD: Word = Word {
        name: "bluenoise",
        title: "Sobol, blue noise",
        doc: "Sobol points ordered over the picture so that the noise of few samples is fine-grained.",
    };

    #[inline(always)]
    fn one<L: Lanes>(stream: &Stream<L>, dimension: Dimension) -> F<L> {
        let point = sobol::one_reversed(stream, dimension.0);
        if !dimension.is_near() {
            return unit(reverse(point));
        }
        let first = sobol::one_reversed(&stream.first(), dimension.0);
        unit(reverse(point ^ first ^ on_curve(stream, dimension.0)[0]))
    }

    #[inline(always)]
    fn two<L: Lanes>(stream: &Stream<L>, dimension: Dimension) -> (F<L>, F<L>) {
        let [x, y] = sobol::two_reversed(stream, dimension.0);
        if !dimension.is_near() {
            return (unit(reverse(x)), unit(reverse(y)));
        }
        let [first_x, first_y] = sobol::two_reversed(&stream.first(), dimension.0);
        let [curve_x, curve_y] = on_curve(stream, dimension.0);
        (unit(reverse(x ^ first_x ^ curve_x)), unit(reverse(y ^ first_y ^ curve_y)))
    }
}

/// The points of the shared sequence at the pixels' positions on the Z-curve, with reversed bits.
#[inline(always)]
fn on_curve<L: Lanes>(stream: &Stream<L>, dimension: u32) -> [U<L>; 2] {
    let place = spread_bits(stream.pixel & 0xffff) | (spread_bits(stream.pixel >> 16) << 1);
    sobol::scrambled(reverse(place), stream.splat(hash_one(stream.salt ^ hash_one(dimension))))
}
