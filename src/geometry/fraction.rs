//! Distances as fractions, which can be compared without division.
use crate::math::{F, Lanes, M, Pick};

/// A distance as a fraction with a denominator that is not negative; NaN if there is no intersection.
#[derive(Clone, Copy)]
pub(super) struct Fraction<L: Lanes> {
    pub numerator: F<L>,
    pub denominator: F<L>,
}

impl<L: Lanes> Fraction<L> {
    #[inline(always)]
    pub fn infinite(l: L) -> Self {
        Fraction { numerator: l.f(1.0), denominator: l.f(0.0) }
    }

    #[inline(always)]
    pub fn none(l: L) -> Self {
        Fraction { numerator: l.f(f32::NAN), denominator: l.f(1.0) }
    }

    /// False where either is NaN.
    #[inline(always)]
    pub fn less(&self, other: &Self) -> M<L> {
        (self.numerator * other.denominator).lt(other.numerator * self.denominator)
    }

    /// Lanes in which both are the same finite distance.
    #[inline(always)]
    pub fn equals(&self, other: &Self) -> M<L> {
        let (a, b) = (self.numerator * other.denominator, other.numerator * self.denominator);
        a.ge(b) & b.ge(a) & self.denominator.above(0.0)
    }

    #[inline(always)]
    pub fn value(&self) -> F<L> {
        self.numerator / self.denominator
    }

    /// Keeps the lanes of `mask`; the others become NaN.
    #[inline(always)]
    pub fn only(self, mask: M<L>) -> Self {
        Fraction { numerator: mask.pick(self.numerator, self.numerator.splat(f32::NAN)), ..self }
    }
}

impl<L: Lanes> Pick<Fraction<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: Fraction<L>, b: Fraction<L>) -> Fraction<L> {
        Fraction { numerator: self.pick(a.numerator, b.numerator), denominator: self.pick(a.denominator, b.denominator) }
    }
}
