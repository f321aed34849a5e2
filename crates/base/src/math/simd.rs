//! Lane configurations of several lanes, over the vectors of the SIMD crate.
use fearless_simd::{
    Bytes, ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x16, mask32x4, mask32x16, u32x4, u32x16,
};

use super::lanes::{F, Lanes, M, MAX_LANES, U};

const IOTA: [u32; MAX_LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

macro_rules! simd_lanes {
    ($name:ident, $n:literal, $real:ty, $int:ty, $mask:ty, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy)]
        pub struct $name<S: Simd>(pub S);

        impl<S: Simd> ExtractToken for $name<S> {
            type S = S;
            #[inline(always)]
            fn token(&self) -> S {
                self.0
            }
        }

        impl<S: Simd> Lanes for $name<S> {
            type Real = $real;
            type Int = $int;
            type Mask = $mask;
            const N: usize = $n;

            #[inline(always)]
            fn f(self, x: f32) -> F<Self> {
                F(<$real>::splat(self.0, x))
            }
            #[inline(always)]
            fn u(self, x: u32) -> U<Self> {
                U(<$int>::splat(self.0, x))
            }
            #[inline(always)]
            fn first(self, n: usize) -> M<Self> {
                let bits = if n >= $n { u64::MAX >> (64 - $n) } else { (1u64 << n) - 1 };
                M(<$mask>::from_bitmask(self.0, bits))
            }
            #[inline(always)]
            fn iota(self) -> U<Self> {
                U(<$int>::from_slice(self.0, &IOTA[..$n]))
            }
            #[inline(always)]
            fn load(self, from: &[f32]) -> F<Self> {
                F(<$real>::from_slice(self.0, &from[..$n]))
            }
            #[inline(always)]
            fn rows(self, table: &[[f32; 4]], index: U<Self>) -> [F<Self>; 4] {
                let mut at = [0u32; $n];
                index.0.store_slice(&mut at);
                if index.is(at[0]).count() == $n {
                    // Not `map`, which is compiled without the instructions of `self`.
                    let [x, y, z, w] = table[at[0] as usize];
                    return [self.f(x), self.f(y), self.f(z), self.f(w)];
                }
                let mut rows = [[0f32; 4]; $n];
                for lane in 0..$n {
                    rows[lane] = table[at[lane] as usize];
                }
                self.transposed(&rows)
            }
            #[inline(always)]
            fn transposed(self, rows: &[[f32; 4]]) -> [F<Self>; 4] {
                // Not `as_flattened`, which is not inlined.
                let flat: &[f32] = ::bytemuck::cast_slice(rows);
                let quarter = |q: usize| <$real>::from_slice(self.0, &flat[q * $n..(q + 1) * $n]);
                let (even0, odd0) = quarter(0).deinterleave(quarter(1));
                let (even1, odd1) = quarter(2).deinterleave(quarter(3));
                let (x, z) = even0.deinterleave(even1);
                let (y, w) = odd0.deinterleave(odd1);
                [F(x), F(y), F(z), F(w)]
            }
            #[inline(always)]
            fn store(x: $real, to: &mut [f32]) {
                x.store_slice(&mut to[..$n]);
            }
            #[inline(always)]
            fn store_int(x: $int, to: &mut [u32]) {
                x.store_slice(&mut to[..$n]);
            }
            #[inline(always)]
            fn splat(like: $real, x: f32) -> $real {
                <$real>::splat(like.token(), x)
            }
            #[inline(always)]
            fn splat_int(like: $int, x: u32) -> $int {
                <$int>::splat(like.token(), x)
            }
            #[inline(always)]
            fn add(a: $real, b: $real) -> $real {
                a + b
            }
            #[inline(always)]
            fn sub(a: $real, b: $real) -> $real {
                a - b
            }
            #[inline(always)]
            fn mul(a: $real, b: $real) -> $real {
                a * b
            }
            #[inline(always)]
            fn div(a: $real, b: $real) -> $real {
                a / b
            }
            #[inline(always)]
            fn neg(a: $real) -> $real {
                -a
            }
            #[inline(always)]
            fn min(a: $real, b: $real) -> $real {
                a.simd_lt(b).select(a, b)
            }
            #[inline(always)]
            fn max(a: $real, b: $real) -> $real {
                b.simd_lt(a).select(a, b)
            }
            #[inline(always)]
            fn abs(a: $real) -> $real {
                a.abs()
            }
            #[inline(always)]
            fn sqrt(a: $real) -> $real {
                a.sqrt()
            }
            #[inline(always)]
            fn copysign(a: $real, sign: $real) -> $real {
                a.copysign(sign)
            }
            #[inline(always)]
            fn lt(a: $real, b: $real) -> $mask {
                a.simd_lt(b)
            }
            #[inline(always)]
            fn le(a: $real, b: $real) -> $mask {
                a.simd_le(b)
            }
            #[inline(always)]
            fn compress(a: $real, keep: $mask) -> $real {
                a.compress(keep)
            }
            #[inline(always)]
            fn bits(a: $real) -> $int {
                a.bitcast()
            }
            #[inline(always)]
            fn from_bits(a: $int) -> $real {
                a.bitcast()
            }
            #[inline(always)]
            fn to_real(a: $int) -> $real {
                a.to_float()
            }
            #[inline(always)]
            fn add_int(a: $int, b: $int) -> $int {
                a + b
            }
            #[inline(always)]
            fn mul_int(a: $int, b: $int) -> $int {
                a * b
            }
            #[inline(always)]
            fn xor(a: $int, b: $int) -> $int {
                a ^ b
            }
            #[inline(always)]
            fn or(a: $int, b: $int) -> $int {
                a | b
            }
            #[inline(always)]
            fn and(a: $int, b: $int) -> $int {
                a & b
            }
            #[inline(always)]
            fn shl(a: $int, by: u32) -> $int {
                a << by
            }
            #[inline(always)]
            fn shr(a: $int, by: u32) -> $int {
                a >> by
            }
            #[inline(always)]
            fn eq_int(a: $int, b: $int) -> $mask {
                a.simd_eq(b)
            }
            #[inline(always)]
            fn lt_int(a: $int, b: $int) -> $mask {
                a.simd_lt(b)
            }
            #[inline(always)]
            fn pick(m: $mask, a: $real, b: $real) -> $real {
                m.select(a, b)
            }
            #[inline(always)]
            fn pick_int(m: $mask, a: $int, b: $int) -> $int {
                m.select(a, b)
            }
            #[inline(always)]
            fn and_mask(a: $mask, b: $mask) -> $mask {
                a & b
            }
            #[inline(always)]
            fn or_mask(a: $mask, b: $mask) -> $mask {
                a | b
            }
            #[inline(always)]
            fn not(a: $mask) -> $mask {
                !a
            }
            #[inline(always)]
            fn any(a: $mask) -> bool {
                a.any_true()
            }
            #[inline(always)]
            fn bitmask(a: $mask) -> u64 {
                a.to_bitmask()
            }
        }
    };
}

simd_lanes!(X4, 4, f32x4<S>, u32x4<S>, mask32x4<S>, "Four lanes: the width of NEON.");

simd_lanes!(X16, 16, f32x16<S>, u32x16<S>, mask32x16<S>, "Sixteen lanes: one AVX-512 register, or two of AVX2.");
