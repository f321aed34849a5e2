//! Distances as fractions, which can be compared without division.
use noisefall_base::math::{F, Lanes, M, Pick};

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

    /// False if either is NaN.
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

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    fn fraction(numerator: f32, denominator: f32) -> Fraction<One> {
        Fraction { numerator: F(numerator), denominator: F(denominator) }
    }

    #[test]
    fn distances_are_compared_without_dividing() {
        let [half, also_half, third] = [fraction(1.0, 2.0), fraction(0.125, 0.25), fraction(1.0, 3.0)];
        let (none, infinite) = (Fraction::none(One), Fraction::infinite(One));
        assert!(third.less(&half).0 && !half.less(&third).0 && !half.less(&also_half).0 && !also_half.less(&half).0);
        assert!(half.less(&infinite).0 && !infinite.less(&half).0);
        assert!(half.equals(&also_half).0 && also_half.equals(&half).0);
        assert!(!half.equals(&third).0 && !third.equals(&half).0);
        assert!(!infinite.equals(&infinite).0 && !infinite.equals(&half).0, "an infinite distance is no intersection");
        for other in [half, infinite, none] {
            assert!(!none.less(&other).0 && !other.less(&none).0 && !none.equals(&other).0 && !other.equals(&none).0);
        }
    }

    #[test]
    fn masks_choose_between_fractions() {
        let [half, third] = [fraction(1.0, 2.0), fraction(2.0, 6.0)];
        assert_eq!([half, third].map(|distance| distance.value().0), [0.5, 2.0 / 6.0]);
        assert!(half.only(M(true)).equals(&half).0 && half.only(M(false)).value().0.is_nan());
        let picked = [true, false].map(|mask| M::<One>(mask).pick(half, third));
        assert_eq!(picked.map(|distance| [distance.numerator.0, distance.denominator.0]), [[1.0, 2.0], [2.0, 6.0]]);
    }
}
