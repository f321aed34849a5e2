//! Values with their derivatives in `N` directions: forward differentiation.
use super::{functions, tape::Quantity};
use noisefall_base::math::{F, Lanes, Pick};

/// A value and its derivatives.
pub(super) struct Jet<L: Lanes, const N: usize> {
    pub value: F<L>,
    pub slope: [F<L>; N],
}

impl<L: Lanes, const N: usize> Clone for Jet<L, N> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes, const N: usize> Copy for Jet<L, N> {}

impl<L: Lanes, const N: usize> Jet<L, N> {
    /// g of this, from its value and its derivative there.
    #[inline(always)]
    fn chain(&self, value: F<L>, derivative: F<L>) -> Self {
        let mut slope = self.slope;
        for s in &mut slope {
            *s = *s * derivative;
        }
        Jet { value, slope }
    }
}

impl<L: Lanes, const N: usize> Quantity<L> for Jet<L, N> {
    #[inline(always)]
    fn constant(l: L, value: f32) -> Self {
        Jet { value: l.f(value), slope: [l.f(0.0); N] }
    }
    #[inline(always)]
    fn add_constant(&self, by: f32) -> Self {
        Jet { value: self.value + by, slope: self.slope }
    }
    #[inline(always)]
    fn scale(&self, by: f32) -> Self {
        self.chain(self.value * by, self.value.splat(by))
    }
    #[inline(always)]
    fn add(&self, b: &Self) -> Self {
        let mut slope = self.slope;
        for (s, t) in slope.iter_mut().zip(&b.slope) {
            *s = *s + *t;
        }
        Jet { value: self.value + b.value, slope }
    }
    #[inline(always)]
    fn subtract(&self, b: &Self) -> Self {
        let mut slope = self.slope;
        for (s, t) in slope.iter_mut().zip(&b.slope) {
            *s = *s - *t;
        }
        Jet { value: self.value - b.value, slope }
    }
    #[inline(always)]
    fn multiply(&self, b: &Self) -> Self {
        let mut slope = self.slope;
        for (s, t) in slope.iter_mut().zip(&b.slope) {
            *s = *s * b.value + *t * self.value;
        }
        Jet { value: self.value * b.value, slope }
    }
    #[inline(always)]
    fn square(&self) -> Self {
        self.chain(self.value * self.value, self.value + self.value)
    }
    #[inline(always)]
    fn reciprocal(&self) -> Self {
        let inverse = 1.0 / self.value;
        self.chain(inverse, -(inverse * inverse))
    }
    /// The derivative is 0 for a ≤ 0.
    #[inline(always)]
    fn square_root(&self) -> Self {
        let zero = self.value.splat(0.0);
        let root = self.value.max(zero).sqrt();
        self.chain(root, root.above(0.0).pick(0.5 / root, zero))
    }
    #[inline(always)]
    fn absolute(&self) -> Self {
        self.chain(self.value.abs(), self.value.splat(1.0).copysign(self.value))
    }
    #[inline(always)]
    fn minimum(&self, b: &Self) -> Self {
        let first = self.value.lt(b.value);
        let mut slope = self.slope;
        for (s, t) in slope.iter_mut().zip(&b.slope) {
            *s = first.pick(*s, *t);
        }
        Jet { value: first.pick(self.value, b.value), slope }
    }
    #[inline(always)]
    fn maximum(&self, b: &Self) -> Self {
        let first = b.value.lt(self.value);
        let mut slope = self.slope;
        for (s, t) in slope.iter_mut().zip(&b.slope) {
            *s = first.pick(*s, *t);
        }
        Jet { value: first.pick(self.value, b.value), slope }
    }
    #[inline(always)]
    fn exponential(&self) -> Self {
        let value = functions::exp(self.value);
        self.chain(value, value)
    }
    /// The derivative is 0 unless a > 0.
    #[inline(always)]
    fn logarithm(&self) -> Self {
        let derivative = self.value.above(0.0).pick(1.0 / self.value, self.value.splat(0.0));
        self.chain(functions::log(self.value), derivative)
    }
    #[inline(always)]
    fn sine(&self) -> Self {
        let (sin, cos) = functions::sin_cos(self.value);
        self.chain(sin, cos)
    }
    #[inline(always)]
    fn cosine(&self) -> Self {
        let (sin, cos) = functions::sin_cos(self.value);
        self.chain(cos, -sin)
    }
}
