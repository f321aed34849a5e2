//! The texels that a lookup needs along one axis, by what continues the image there.
use super::{
    texels::{Edge, neighbours},
    words::Wrap,
};
use noisefall_base::math::{F, Lanes, Pick, U, round::floor};

/// Two neighbouring texels of an axis with their weights. A texel beyond the image weighs nothing if it is black.
pub struct Neighbours<L: Lanes> {
    /// Indices of texels, which exist.
    pub texels: [U<L>; 2],
    /// Weights in [0, 1].
    pub weights: [F<L>; 2],
}

impl Wrap {
    /// The texels whose centres enclose `t`, on an axis of `size` texels over [0, 1]. Any number is allowed.
    #[inline(always)]
    pub fn neighbours<L: Lanes>(self, t: F<L>, size: u32) -> Neighbours<L> {
        let (first, second, fraction) = match self {
            Wrap::Repeat => neighbours(t - floor(t).0, size, Edge::Repeat),
            Wrap::Mirror => neighbours(folded(t), size, Edge::Clamp),
            Wrap::Clamp => neighbours(t, size, Edge::Clamp),
            Wrap::Black => return before_black(t, size),
        };
        Neighbours { texels: [first, second], weights: [1.0 - fraction, fraction] }
    }

    /// The texel that contains `t`, with its weight: 0 if it is beyond an image in black, else 1.
    #[inline(always)]
    pub fn nearest<L: Lanes>(self, t: F<L>, size: u32) -> (U<L>, F<L>) {
        let (zero, one) = (t.splat(0.0), t.splat(1.0));
        let (within, weight) = match self {
            Wrap::Repeat => (t - floor(t).0, one),
            Wrap::Mirror => (folded(t), one),
            Wrap::Clamp => (t, one),
            Wrap::Black => (t, (t.ge(zero) & t.below(1.0)).pick(one, zero)),
        };
        // NaN becomes the last texel.
        let within = within.min(one).max(zero) * size as f32;
        (floor(within.min(t.splat((size - 1) as f32))).1, weight)
    }
}

/// `t` in [0, 1] of an image that is mirrored every second time.
#[inline(always)]
fn folded<L: Lanes>(t: F<L>) -> F<L> {
    let within = t - floor(t * 0.5).0 * 2.0;
    within.above(1.0).pick(2.0 - within, within)
}

/// The neighbours in an image that black texels surround.
#[inline(always)]
fn before_black<L: Lanes>(t: F<L>, size: u32) -> Neighbours<L> {
    // One image beyond its edges all is black; NaN is there too.
    let x = t.min(t.splat(2.0)).max(t.splat(-1.0)) * size as f32 - 0.5;
    let (start, first) = floor(x);
    let second = first + 1;
    let (has_first, has_second) = (first.below(size), second.below(size));
    let (none, zero, fraction) = (U(L::splat_int(first.0, 0)), t.splat(0.0), x - start);
    Neighbours {
        texels: [has_first.pick(first, none), has_second.pick(second, none)],
        weights: [has_first.pick(1.0 - fraction, zero), has_second.pick(fraction, zero)],
    }
}
