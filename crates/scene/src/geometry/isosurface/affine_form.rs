//! Bounds of a function and its derivative over a segment: a straight line and the maximum distance of the function from it.
//!
//! Let s be in [−1, 1] along the segment. Then f(s) = a + b s + e(s), where |e| ≤ r, and q is a Lipschitz constant of e: |e′| ≤ q
//! wherever the derivative exists. So f lies in a ± (|b| + r) and f′ in b ± q. The width of an interval shrinks like the segment,
//! but r shrinks like its square, and one line bounds both f and f′. (Affine arithmetic with a single symbol, as in A. Knoll et
//! al., "Fast Ray Tracing of Arbitrary Implicit Surfaces with Interval and Affine Arithmetic", Computer Graphics Forum 28, 2009;
//! the bound q of the derivative is added here.)
//!
//! The bounds are rigorous. With u = ε/2, the error of each rounded operation is at most u times its result, or less than the
//! smallest normal number if it underflows; the errors of a and b are added to r and q. Those of r and q themselves, which are
//! sums and products of positive numbers with at most 12 successive roundings, are covered by [`WIDEN`]. Overflow makes r
//! infinite or NaN, which proves nothing, because comparisons with it are false.
use super::{
    lines::{self, Line},
    tape::Quantity,
};
use noisefall_base::math::{F, Lanes, M, Pick};

/// A rounding error, including the rounding of its own bound.
const ROUNDING: f32 = 0.51 * f32::EPSILON;
/// Two rounding errors.
const TWO_ROUNDINGS: f32 = 1.02 * f32::EPSILON;
/// Covers 16 roundings of positive numbers.
pub(super) const WIDEN: f32 = 1.0 + 8.0 * f32::EPSILON;
/// Error of underflow.
const UNDERFLOW: f32 = f32::MIN_POSITIVE;

/// f(s) = a + b s + e(s) for s in [−1, 1]; |e| ≤ r, |e′| ≤ q.
#[derive(Clone, Copy)]
pub(super) struct AffineForm<L: Lanes> {
    pub a: F<L>,
    pub b: F<L>,
    pub r: F<L>,
    pub q: F<L>,
}

impl<L: Lanes> Pick<AffineForm<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: AffineForm<L>, b: AffineForm<L>) -> AffineForm<L> {
        AffineForm { a: self.pick(a.a, b.a), b: self.pick(a.b, b.b), r: self.pick(a.r, b.r), q: self.pick(a.q, b.q) }
    }
}

impl<L: Lanes> AffineForm<L> {
    /// The coordinate o + d (middle + half · s) of a line; o, d, middle and half are exact.
    #[inline(always)]
    pub fn along(o: F<L>, d: F<L>, middle: F<L>, half: F<L>) -> Self {
        let far = d * middle;
        let (a, b) = (o + far, d * half);
        let of_slope = b.abs() * ROUNDING + UNDERFLOW;
        // The sum is not farther from the exact one than o is.
        let of_middle = far.abs() * ROUNDING + (a.abs() * ROUNDING).min(far.abs());
        AffineForm { a, b, r: (of_middle + of_slope) * WIDEN, q: of_slope }
    }

    /// Maximum distance of the function from a.
    #[inline(always)]
    pub fn reach(&self) -> F<L> {
        (self.b.abs() + self.r) * WIDEN
    }

    /// Lanes whose function is nowhere zero; it then has the sign of a.
    #[inline(always)]
    pub fn has_no_zero(&self) -> M<L> {
        self.reach().lt(self.a.abs())
    }

    /// Lanes whose function is strictly monotone.
    #[inline(always)]
    pub fn is_monotone(&self) -> M<L> {
        self.q.lt(self.b.abs())
    }

    /// g of this quantity.
    #[inline(always)]
    pub fn map(&self, line: &Line<L>) -> Self {
        let slope = line.slope.abs();
        let b = line.slope * self.b;
        let rounding = b.abs() * ROUNDING + UNDERFLOW;
        AffineForm {
            a: line.at_middle,
            b,
            r: (slope * self.r + line.error + rounding) * WIDEN,
            q: (line.bend * (self.b.abs() + self.q) + slope * self.q + rounding) * WIDEN,
        }
    }

    #[inline(always)]
    fn negative(&self) -> Self {
        AffineForm { a: -self.a, b: -self.b, ..*self }
    }

    /// |x| where x may have either sign: it lies between the chord over the range a ± w and the chord less w − a²/w, its depth
    /// at 0.
    #[inline(always)]
    fn absolute_around_zero(&self) -> Self {
        let w = self.reach();
        let slope = self.a / w;
        let depth = (w - slope * self.a) * 0.5;
        let error = (depth + w * (4.0 * f32::EPSILON)) * WIDEN;
        self.map(&Line { at_middle: w - depth, slope, error, bend: slope.abs() + 1.0 })
    }

    /// The minimum or maximum of two where either is possible: half their sum plus or minus half their distance.
    #[inline(always)]
    fn extreme(&self, b: &Self, sign: f32) -> Self {
        let difference = self.subtract(b);
        let distance = difference.absolute_around_zero().scale(sign);
        let mean = self.add(b).add(&distance).scale(0.5);
        let first_is_less = difference.a.below(0.0);
        let first_or_second = (if sign < 0.0 { first_is_less } else { !first_is_less }).pick(*self, *b);
        difference.has_no_zero().pick(first_or_second, mean)
    }
}

impl<L: Lanes> Quantity<L> for AffineForm<L> {
    #[inline(always)]
    fn constant(l: L, value: f32) -> Self {
        let zero = l.f(0.0);
        AffineForm { a: l.f(value), b: zero, r: zero, q: zero }
    }
    #[inline(always)]
    fn add_constant(&self, by: f32) -> Self {
        let a = self.a + by;
        AffineForm { a, r: (self.r + a.abs() * ROUNDING) * WIDEN, ..*self }
    }
    #[inline(always)]
    fn scale(&self, by: f32) -> Self {
        let (a, b) = (self.a * by, self.b * by);
        let of_slope = b.abs() * ROUNDING + UNDERFLOW;
        let by = by.abs();
        AffineForm { a, b, r: (self.r * by + a.abs() * ROUNDING + of_slope) * WIDEN, q: (self.q * by + of_slope) * WIDEN }
    }
    #[inline(always)]
    fn add(&self, b: &Self) -> Self {
        let sum = self.a + b.a;
        let slope = self.b + b.b;
        let of_slope = slope.abs() * ROUNDING;
        AffineForm {
            a: sum,
            b: slope,
            r: (self.r + b.r + sum.abs() * ROUNDING + of_slope) * WIDEN,
            q: (self.q + b.q + of_slope) * WIDEN,
        }
    }
    #[inline(always)]
    fn subtract(&self, b: &Self) -> Self {
        self.add(&b.negative())
    }

    /// (a₁ + b₁s + e₁)(a₂ + b₂s + e₂), where b₁b₂s² is taken as b₁b₂(½ ± ½), of slope up to 2b₁b₂.
    #[inline(always)]
    fn multiply(&self, other: &Self) -> Self {
        let (b1, b2) = (self.b.abs(), other.b.abs());
        let (m1, m2) = (self.a.abs() + b1, other.a.abs() + b2);
        let (reach1, reach2) = (m1 + self.r, m2 + other.r);
        let bb = self.b * other.b;
        let curve = bb.abs();
        // Two roundings each of a and b, in all at most 2u m₁m₂, and of b alone 2u (m₁|b₂| + m₂|b₁|).
        let r1 = self.r + m1 * TWO_ROUNDINGS;
        let (q1, q2) = (self.q + b1 * TWO_ROUNDINGS, other.q + b2 * TWO_ROUNDINGS);
        AffineForm {
            a: self.a * other.a + bb * 0.5,
            b: self.a * other.b + other.a * self.b,
            r: (curve * 0.5 + reach1 * other.r + m2 * r1 + UNDERFLOW) * WIDEN,
            q: ((curve + curve) + (reach1 * q2 + reach2 * q1) + (b1 * other.r + b2 * self.r) + UNDERFLOW) * WIDEN,
        }
    }
    #[inline(always)]
    fn square(&self) -> Self {
        let slope = self.b.abs();
        let m = self.a.abs() + slope;
        let reach = m + self.r;
        let (curve, ab) = (self.b * self.b, self.a * self.b);
        let a = self.a * self.a + curve * 0.5;
        let rounding = ab.abs() * TWO_ROUNDINGS + UNDERFLOW;
        let bend = curve + reach * self.q + slope * self.r;
        AffineForm {
            a,
            b: ab + ab,
            r: (curve * 0.5 + self.r * (m + reach) + a * TWO_ROUNDINGS + rounding) * WIDEN,
            q: (bend + bend + rounding) * WIDEN,
        }
    }
    #[inline(always)]
    fn reciprocal(&self) -> Self {
        self.map(&lines::reciprocal(self.a, self.reach()))
    }
    #[inline(always)]
    fn square_root(&self) -> Self {
        self.map(&lines::square_root(self.a, self.reach()))
    }
    #[inline(always)]
    fn absolute(&self) -> Self {
        let one_sided = self.a.below(0.0).pick(self.negative(), *self);
        self.has_no_zero().pick(one_sided, self.absolute_around_zero())
    }
    #[inline(always)]
    fn minimum(&self, b: &Self) -> Self {
        self.extreme(b, -1.0)
    }
    #[inline(always)]
    fn maximum(&self, b: &Self) -> Self {
        self.extreme(b, 1.0)
    }
    #[inline(always)]
    fn exponential(&self) -> Self {
        self.map(&lines::exponential(self.a, self.reach()))
    }
    #[inline(always)]
    fn logarithm(&self) -> Self {
        self.map(&lines::logarithm(self.a, self.reach()))
    }
    #[inline(always)]
    fn sine(&self) -> Self {
        self.map(&lines::sine(self.a, self.reach()))
    }
    #[inline(always)]
    fn cosine(&self) -> Self {
        self.map(&lines::cosine(self.a, self.reach()))
    }
}
