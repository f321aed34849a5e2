//! The arithmetic of [`One`] lane: plain numbers.
use super::lanes::{F, Lanes, M, One, U};

impl Lanes for One {
    type Real = f32;
    type Int = u32;
    type Mask = bool;
    const N: usize = 1;

    #[inline(always)]
    fn f(self, x: f32) -> F<Self> {
        F(x)
    }
    #[inline(always)]
    fn u(self, x: u32) -> U<Self> {
        U(x)
    }
    #[inline(always)]
    fn first(self, n: usize) -> M<Self> {
        M(n > 0)
    }
    #[inline(always)]
    fn iota(self) -> U<Self> {
        U(0)
    }
    #[inline(always)]
    fn load(self, from: &[f32]) -> F<Self> {
        F(from[0])
    }
    #[inline(always)]
    fn rows(self, table: &[[f32; 4]], index: U<Self>) -> [F<Self>; 4] {
        let [x, y, z, w] = table[index.0 as usize];
        [F(x), F(y), F(z), F(w)]
    }
    #[inline(always)]
    fn transposed(self, rows: &[[f32; 4]]) -> [F<Self>; 4] {
        let [x, y, z, w] = rows[0];
        [F(x), F(y), F(z), F(w)]
    }
    #[inline(always)]
    fn store(x: f32, to: &mut [f32]) {
        to[0] = x;
    }
    #[inline(always)]
    fn store_int(x: u32, to: &mut [u32]) {
        to[0] = x;
    }
    #[inline(always)]
    fn splat(_: f32, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn splat_int(_: u32, x: u32) -> u32 {
        x
    }
    #[inline(always)]
    fn add(a: f32, b: f32) -> f32 {
        a + b
    }
    #[inline(always)]
    fn sub(a: f32, b: f32) -> f32 {
        a - b
    }
    #[inline(always)]
    fn mul(a: f32, b: f32) -> f32 {
        a * b
    }
    #[inline(always)]
    fn div(a: f32, b: f32) -> f32 {
        a / b
    }
    #[inline(always)]
    fn neg(a: f32) -> f32 {
        -a
    }
    #[inline(always)]
    fn min(a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn max(a: f32, b: f32) -> f32 {
        if b < a { a } else { b }
    }
    #[inline(always)]
    fn abs(a: f32) -> f32 {
        a.abs()
    }
    #[inline(always)]
    fn sqrt(a: f32) -> f32 {
        a.sqrt()
    }
    #[inline(always)]
    fn copysign(a: f32, sign: f32) -> f32 {
        a.copysign(sign)
    }
    #[inline(always)]
    fn lt(a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn le(a: f32, b: f32) -> bool {
        a <= b
    }
    #[inline(always)]
    fn compress(a: f32, _: bool) -> f32 {
        a
    }
    #[inline(always)]
    fn bits(a: f32) -> u32 {
        a.to_bits()
    }
    #[inline(always)]
    fn from_bits(a: u32) -> f32 {
        f32::from_bits(a)
    }
    #[inline(always)]
    fn to_real(a: u32) -> f32 {
        a as f32
    }
    #[inline(always)]
    fn add_int(a: u32, b: u32) -> u32 {
        a.wrapping_add(b)
    }
    #[inline(always)]
    fn mul_int(a: u32, b: u32) -> u32 {
        a.wrapping_mul(b)
    }
    #[inline(always)]
    fn xor(a: u32, b: u32) -> u32 {
        a ^ b
    }
    #[inline(always)]
    fn or(a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    fn and(a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn shl(a: u32, by: u32) -> u32 {
        a << by
    }
    #[inline(always)]
    fn shr(a: u32, by: u32) -> u32 {
        a >> by
    }
    #[inline(always)]
    fn eq_int(a: u32, b: u32) -> bool {
        a == b
    }
    #[inline(always)]
    fn lt_int(a: u32, b: u32) -> bool {
        a < b
    }
    #[inline(always)]
    fn pick(m: bool, a: f32, b: f32) -> f32 {
        if m { a } else { b }
    }
    #[inline(always)]
    fn pick_int(m: bool, a: u32, b: u32) -> u32 {
        if m { a } else { b }
    }
    #[inline(always)]
    fn and_mask(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn or_mask(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn not(a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn any(a: bool) -> bool {
        a
    }
    #[inline(always)]
    fn bitmask(a: bool) -> u64 {
        u64::from(a)
    }
}
