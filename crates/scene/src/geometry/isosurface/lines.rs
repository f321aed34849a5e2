//! Linear approximations of functions over the range c ± w with their errors, for [`AffineForm::map`].
//!
//! Each line is the tangent at c. By Taylor's theorem the function lies on one side of it, or nearly. Half of its maximum
//! distance is added to the line; the other half is the error. If the range is too wide, or reaches a pole or the end of the
//! domain, the line is constant, in the middle of the range of the function.
//!
//! [`AffineForm::map`]: super::affine_form::AffineForm::map
use super::functions::{EXP_END, EXP_ERROR, LOG_ERROR, SIN_ERROR, exp, log, sin_cos};
use noisefall_base::math::{F, Lanes, M, Pick};

/// Eight rounding errors: more than any line here accumulates.
const ROUNDINGS: f32 = 4.0 * f32::EPSILON;
/// log of the smallest normal number, where [`log`] ends.
const LOWEST_LOG: f32 = -87.336_55;

/// g(x) ≈ at_middle + slope (x − a) within `error` where x is the enclosed quantity, and |g′ − slope| ≤ `bend`.
pub(super) struct Line<L: Lanes> {
    pub at_middle: F<L>,
    pub slope: F<L>,
    pub error: F<L>,
    pub bend: F<L>,
}

impl<L: Lanes> Pick<Line<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: Line<L>, b: Line<L>) -> Line<L> {
        Line {
            at_middle: self.pick(a.at_middle, b.at_middle),
            slope: self.pick(a.slope, b.slope),
            error: self.pick(a.error, b.error),
            bend: self.pick(a.bend, b.bend),
        }
    }
}

/// 1/x = 1/c − (x − c)/c² + (x − c)²/(c²x). A range that contains 0 has no bound.
#[inline(always)]
pub(super) fn reciprocal<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    let size = c.abs();
    let inverse = 1.0 / c;
    let slope = inverse * inverse;
    let nearest = 1.0 / (size - w);
    let depth = slope * (w * w) * nearest * 0.5;
    let error = depth * (1.0 + ROUNDINGS) + inverse.abs() * (2.0 * ROUNDINGS);
    let bend = slope * (w * (size + size - w) * nearest * nearest * (1.0 + 2.0 * ROUNDINGS) + ROUNDINGS);
    let infinite = c.splat(f32::INFINITY);
    let known = w.lt(size);
    Line {
        at_middle: inverse + depth.copysign(c),
        slope: -slope,
        error: known.pick(error, infinite),
        bend: known.pick(bend, infinite),
    }
}

/// √x lies below the tangent by (x − c)²/(2√c(√x + √c)²), at most w²/(8√c(c − w)), and its slope differs from that of the
/// tangent by at most w/(4√c(c − w)): both from √(1 − w/c) ≥ 1 − w/c, and 2√(1 − w/c) ≤ 2 − w/c.
#[inline(always)]
pub(super) fn square_root<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    let (zero, infinite) = (c.splat(0.0), c.splat(f32::INFINITY));
    let positive = w.lt(c);
    let highest = c + w;
    let root = positive.pick(c, highest.max(zero)).sqrt();
    let slope = 0.5 / root;
    let turn = slope * w * 0.5 / (c - w) * (1.0 + 2.0 * ROUNDINGS);
    let depth = turn * w * 0.25;
    let tangent = Line {
        at_middle: root - depth,
        slope,
        error: depth * (1.0 + ROUNDINGS) + root * (2.0 * ROUNDINGS),
        bend: turn + slope * ROUNDINGS,
    };
    let half = root * 0.5;
    let level =
        Line { at_middle: half, slope: zero, error: half * (1.0 + ROUNDINGS), bend: highest.above(0.0).pick(infinite, zero) };
    positive.pick(tangent, level)
}

/// eˣ lies above the tangent by at most eᶜ w²/2 eʷ, and its slope differs by eᶜ(eʷ − 1); eʷ ≤ 1 + w + w² for w ≤ 1.
#[inline(always)]
pub(super) fn exponential<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    const INEXACT: f32 = 2.0 * EXP_ERROR + ROUNDINGS;
    let narrow = w.below(1.0);
    let value = exp(narrow.pick(c, c + w));
    let growth = w + w * w;
    let depth = value * (w * w) * (growth + 1.0) * 0.25;
    let tangent = Line {
        at_middle: value + depth,
        slope: value,
        error: depth * (1.0 + ROUNDINGS) + value * (w + 1.0) * INEXACT + EXP_END,
        bend: value * (growth * (1.0 + ROUNDINGS) + INEXACT) + EXP_END,
    };
    let half = value * 0.5;
    // c + w is rounded, by which the exponential changes as many times its value as there are roundings in it.
    let high = value * (1.0 + 2.0 * INEXACT) + value * ((c.abs() + w) * ROUNDINGS) + EXP_END;
    let level = Line { at_middle: half, slope: c.splat(0.0), error: high - half * (1.0 - ROUNDINGS), bend: high };
    narrow.pick(tangent, level)
}

/// log x lies below the tangent by at most w²/(2c(c − w)), and its slope differs by w/(c(c − w)).
#[inline(always)]
pub(super) fn logarithm<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    let lowest = c - w;
    let positive = lowest.ge(c.splat(2.0 * f32::MIN_POSITIVE));
    let value = log(positive.pick(c, c + w));
    let slope = 1.0 / c;
    let turn = slope * w / lowest * (1.0 + ROUNDINGS);
    let depth = turn * w * 0.25;
    let rounding = (value.abs() + 1.0) * (2.0 * LOG_ERROR + 2.0 * ROUNDINGS);
    let tangent = Line {
        at_middle: value - depth,
        slope,
        error: depth * (1.0 + 2.0 * ROUNDINGS) + rounding,
        bend: turn * (1.0 + ROUNDINGS) + slope * ROUNDINGS,
    };
    let half = (value - LOWEST_LOG) * 0.5;
    let level = Line {
        at_middle: half + LOWEST_LOG,
        slope: c.splat(0.0),
        error: half + rounding + 100.0 * ROUNDINGS,
        bend: c.splat(f32::INFINITY),
    };
    positive.pick(tangent, level)
}

#[inline(always)]
pub(super) fn sine<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    let (sin, cos) = sin_cos(c);
    wave(c, w, sin, cos)
}

#[inline(always)]
pub(super) fn cosine<L: Lanes>(c: F<L>, w: F<L>) -> Line<L> {
    let (sin, cos) = sin_cos(c);
    wave(c, w, cos, -sin)
}

/// A sine wave with this value and slope at c: v + s(x − c) − v(x − c)²/2 within w³/6, its slope s − v(x − c) within w²/2.
#[inline(always)]
fn wave<L: Lanes>(c: F<L>, w: F<L>, value: F<L>, slope: F<L>) -> Line<L> {
    let (size, w2) = (value.abs(), w * w);
    let depth = size * w2 * 0.25;
    let of_argument = c.abs() * SIN_ERROR;
    let of_value = (of_argument + size * (SIN_ERROR + ROUNDINGS)) * (w2 + 1.0);
    let of_slope = of_argument + SIN_ERROR;
    let error = depth + w2 * w * (1.0 / 6.0 + f32::EPSILON) + of_value + of_slope * w;
    let bend = size * w + w2 * 0.5 + of_argument * (w + 1.0) + of_slope;
    let (zero, one) = (c.splat(0.0), c.splat(1.0));
    let narrow = w.below(1.25) & of_argument.below(0.25);
    Line {
        at_middle: narrow.pick(value - value * w2 * 0.25, zero),
        slope: narrow.pick(slope, zero),
        error: narrow.pick(error, one),
        bend: narrow.pick(bend, one),
    }
}
