//! Sine and cosine by our own polynomials, so that every processor gives the same bits.
use std::f32::consts::{FRAC_PI_4, TAU};

use super::{
    lanes::Lanes,
    number::{F, Pick},
};

/// (sin 2πu, cos 2πu) for u in [0, 1], within 2e-7.
#[inline(always)]
pub fn sin_cos_turns<L: Lanes>(u: F<L>) -> (F<L>, F<L>) {
    // sin 2πu = −sin 2π(u − ½) and cos 2πu = −cos 2π(u − ½): fold the turn to a quarter, where an odd polynomial is enough.
    let half = u - 0.5;
    let fold = half.abs();
    let quarter = fold.above(0.25).pick(0.5 - fold, fold);
    let sin = -sin_quarter_turn(quarter).copysign(half);
    let cos = -sin_quarter_turn(0.25 - fold);
    (sin, cos)
}

/// (sin πx/4, cos πx/4) for x in [−1, 1], within 1e-7.
#[inline(always)]
pub fn sin_cos_eighth<L: Lanes>(x: F<L>) -> (F<L>, F<L>) {
    let x = x * FRAC_PI_4;
    let x2 = x * x;
    let sin = x2 * -1.951_529_6e-4 + 8.332_161e-3;
    let sin = x2 * sin + -1.666_665_5e-1;
    let cos = x2 * 2.443_315_7e-5 + -1.388_731_6e-3;
    let cos = x2 * cos + 4.166_664_6e-2;
    let cos = x2 * cos + -0.5;
    (x * (x2 * sin + 1.0), x2 * cos + 1.0)
}

/// sin 2πy for |y| ≤ ¼: the odd Taylor-like minimax polynomial of degree 11 in 2πy.
#[inline(always)]
fn sin_quarter_turn<L: Lanes>(y: F<L>) -> F<L> {
    let x = y * TAU;
    let x2 = x * x;
    let p = x2 * -2.388_986e-8 + 2.752_556_2e-6;
    let p = x2 * p + -1.984_087_4e-4;
    let p = x2 * p + 8.333_331e-3;
    let p = x2 * p + -1.666_666_7e-1;
    x * (x2 * p + 1.0)
}
