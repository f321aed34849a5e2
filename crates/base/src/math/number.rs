//! `F`, `U` and `M`: reals, unsigned integers and truth values in lanes, with the operators of scalar code.
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};

use super::lanes::{F, Lanes, M, MAX_LANES, U};

macro_rules! real_operators {
    ($($op:ident $method:ident)*) => { $(
        impl<L: Lanes> $op for F<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                F(L::$method(self.0, b.0))
            }
        }
        impl<L: Lanes> $op<f32> for F<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: f32) -> Self {
                F(L::$method(self.0, L::splat(self.0, b)))
            }
        }
        impl<L: Lanes> $op<F<L>> for f32 {
            type Output = F<L>;
            #[inline(always)]
            fn $method(self, b: F<L>) -> F<L> {
                F(L::$method(L::splat(b.0, self), b.0))
            }
        }
    )* };
}
real_operators!(Add add Sub sub Mul mul Div div);

macro_rules! int_operators {
    ($($op:ident $method:ident $lanes:ident)*) => { $(
        impl<L: Lanes> $op for U<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                U(L::$lanes(self.0, b.0))
            }
        }
        impl<L: Lanes> $op<u32> for U<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: u32) -> Self {
                U(L::$lanes(self.0, L::splat_int(self.0, b)))
            }
        }
    )* };
}
int_operators!(Add add add_int Mul mul mul_int BitXor bitxor xor BitOr bitor or BitAnd bitand and);

impl<L: Lanes> Neg for F<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F(L::neg(self.0))
    }
}

impl<L: Lanes> Shl<u32> for U<L> {
    type Output = Self;
    #[inline(always)]
    fn shl(self, by: u32) -> Self {
        U(L::shl(self.0, by))
    }
}

impl<L: Lanes> Shr<u32> for U<L> {
    type Output = Self;
    #[inline(always)]
    fn shr(self, by: u32) -> Self {
        U(L::shr(self.0, by))
    }
}

impl<L: Lanes> BitAnd for M<L> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, b: Self) -> Self {
        M(L::and_mask(self.0, b.0))
    }
}

impl<L: Lanes> BitOr for M<L> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, b: Self) -> Self {
        M(L::or_mask(self.0, b.0))
    }
}

/// Lanes that are set in exactly one of the two masks.
impl<L: Lanes> BitXor for M<L> {
    type Output = Self;
    #[inline(always)]
    fn bitxor(self, b: Self) -> Self {
        (self | b) & !(self & b)
    }
}

impl<L: Lanes> Not for M<L> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        M(L::not(self.0))
    }
}

impl<L: Lanes> F<L> {
    /// The smaller number.
    #[inline(always)]
    pub fn min(self, b: Self) -> Self {
        F(L::min(self.0, b.0))
    }
    /// The larger number.
    #[inline(always)]
    pub fn max(self, b: Self) -> Self {
        F(L::max(self.0, b.0))
    }
    /// |x|.
    #[inline(always)]
    pub fn abs(self) -> Self {
        F(L::abs(self.0))
    }
    /// √x, correctly rounded.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        F(L::sqrt(self.0))
    }
    /// |x| with the sign of another number.
    #[inline(always)]
    pub fn copysign(self, sign: Self) -> Self {
        F(L::copysign(self.0, sign.0))
    }
    /// Whether x < b.
    #[inline(always)]
    pub fn lt(self, b: Self) -> M<L> {
        M(L::lt(self.0, b.0))
    }
    /// Whether x ≥ b.
    #[inline(always)]
    pub fn ge(self, b: Self) -> M<L> {
        M(L::le(b.0, self.0))
    }
    /// Lanes where this is greater than the number `b`.
    #[inline(always)]
    pub fn above(self, b: f32) -> M<L> {
        M(L::lt(L::splat(self.0, b), self.0))
    }
    /// Lanes where this is less than the number `b`.
    #[inline(always)]
    pub fn below(self, b: f32) -> M<L> {
        M(L::lt(self.0, L::splat(self.0, b)))
    }
    /// Fills all lanes with a number.
    #[inline(always)]
    pub fn splat(self, x: f32) -> Self {
        F(L::splat(self.0, x))
    }
    /// The bits of the number.
    #[inline(always)]
    pub fn bits(self) -> U<L> {
        U(L::bits(self.0))
    }
    /// The lanes to keep, one after the other from the first on.
    #[inline(always)]
    pub fn compress(self, keep: M<L>) -> Self {
        F(L::compress(self.0, keep.0))
    }
    /// Writes all lanes to the start of a slice.
    #[inline(always)]
    pub fn store(self, to: &mut [f32]) {
        L::store(self.0, to);
    }
    /// The lanes as an array; only the first `L::N` entries are valid.
    #[inline(always)]
    pub fn to_array(self) -> [f32; MAX_LANES] {
        let mut a = [0.0; MAX_LANES];
        self.store(&mut a);
        a
    }
}

impl<L: Lanes> U<L> {
    /// The number with these bits.
    #[inline(always)]
    pub fn as_real_bits(self) -> F<L> {
        F(L::from_bits(self.0))
    }
    /// The nearest number of single precision.
    #[inline(always)]
    pub fn to_real(self) -> F<L> {
        F(L::to_real(self.0))
    }
    /// Lanes equal to the number `k`.
    #[inline(always)]
    pub fn is(self, k: u32) -> M<L> {
        M(L::eq_int(self.0, L::splat_int(self.0, k)))
    }
    /// Whether both are the same.
    #[inline(always)]
    pub fn equals(self, b: Self) -> M<L> {
        M(L::eq_int(self.0, b.0))
    }
    /// Lanes less than the number `k`.
    #[inline(always)]
    pub fn below(self, k: u32) -> M<L> {
        M(L::lt_int(self.0, L::splat_int(self.0, k)))
    }
    /// The lanes as an array; only the first `L::N` entries are valid.
    #[inline(always)]
    pub fn to_array(self) -> [u32; MAX_LANES] {
        let mut a = [0; MAX_LANES];
        L::store_int(self.0, &mut a);
        a
    }
}

/// `mask.pick(a, b)`: `a` in the lanes of the mask, `b` in the others.
pub trait Pick<T> {
    /// a in the lanes of the mask, else b.
    fn pick(self, a: T, b: T) -> T;
}

impl<L: Lanes> Pick<F<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: F<L>, b: F<L>) -> F<L> {
        F(L::pick(self.0, a.0, b.0))
    }
}

impl<L: Lanes> Pick<U<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: U<L>, b: U<L>) -> U<L> {
        U(L::pick_int(self.0, a.0, b.0))
    }
}

impl<L: Lanes> M<L> {
    /// Whether some lane is set.
    #[inline(always)]
    pub fn any(self) -> bool {
        L::any(self.0)
    }
    /// Lane `i` as bit `i`.
    #[inline(always)]
    pub fn bits(self) -> u64 {
        L::bitmask(self.0)
    }
    /// Number of lanes that are set.
    #[inline(always)]
    pub fn count(self) -> usize {
        self.bits().count_ones() as usize
    }
}
