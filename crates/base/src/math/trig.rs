//! Sine and cosine by polynomials instead of the standard library, so that every processor gives the same bits.
use std::f32::consts::{FRAC_PI_4, TAU};

use super::{
    lanes::{F, Lanes},
    number::Pick,
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

/// The angle of the point (x, y), counter-clockwise from the x axis, in turns: in [0, 1), within 7e-8 of a turn (most of it the
/// last bit of the result; 3e-8 below an eighth). The length of (x, y) does not matter; (0, 0) has the angle 0.
#[inline(always)]
pub fn turns_of<L: Lanes>(x: F<L>, y: F<L>) -> F<L> {
    let (across, up) = (x.abs(), y.abs());
    let ratio = across.min(up) / across.max(up).max(x.splat(f32::MIN_POSITIVE));
    let eighth = arctan_turns(ratio);
    let quarter = across.lt(up).pick(0.25 - eighth, eighth);
    let half = x.below(0.0).pick(0.5 - quarter, quarter);
    let turn = y.below(0.0).pick(1.0 - half, half);
    turn.below(1.0).pick(turn, x.splat(0.0))
}

/// arctan(x)/2π for x in [0, 1]. M. Abramowitz and I. Stegun, "Handbook of Mathematical Functions", 1964, formula 4.4.49.
#[inline(always)]
fn arctan_turns<L: Lanes>(x: F<L>) -> F<L> {
    let x2 = x * x;
    let p = x2 * 0.002_866_225_7 - 0.016_165_737;
    let p = x2 * p + 0.042_909_614;
    let p = x2 * p - 0.075_289_64;
    let p = x2 * p + 0.106_562_64;
    let p = x2 * p - 0.142_089;
    let p = x2 * p + 0.199_935_51;
    let p = x2 * p - 0.333_331_46;
    (x2 * p + 1.0) * x * (1.0 / TAU)
}
