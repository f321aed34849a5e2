//! Lanes: several numbers that one instruction processes in parallel.
//!
//! A *lane configuration* is a zero-sized token, [`X16`](super::simd::X16), [`X4`](super::simd::X4) or [`One`]. It fixes the
//! number of lanes and proves that the processor has the instructions. Code generic over [`Lanes`] reads like scalar code and
//! compiles to any of them. Every operation is exactly rounded (IEEE 754) and nothing is contracted or reassociated, so all
//! configurations give the same bits.
//!
//! The operators are in [`super::number`], the arithmetic in [`super::simd`] and `one.rs`. Of the kernel, only the tests of one
//! ray against eight boxes or triangles use vectors of the SIMD crate directly (`geometry/bvh/slabs.rs`,
//! `geometry/mesh/shear.rs`).
use fearless_simd::{ExtractToken, Fallback};

/// The widest configuration; arrays that hold the lanes of any configuration have this length.
pub const MAX_LANES: usize = 16;

/// Reals (f32), one per lane.
pub struct F<L: Lanes>(pub L::Real);

/// Unsigned integers (u32, wrapping arithmetic), one per lane.
pub struct U<L: Lanes>(pub L::Int);

/// Truth values, one per lane.
pub struct M<L: Lanes>(pub L::Mask);

macro_rules! copy {
    ($($t:ident)*) => { $(
        impl<L: Lanes> Clone for $t<L> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<L: Lanes> Copy for $t<L> {}
    )* };
}

copy!(F U M);

/// A lane configuration: `N` reals, `N` unsigned integers or `N` truth values side by side.
pub trait Lanes: ExtractToken + Copy + Send + Sync + 'static {
    /// A register of `N` numbers of single precision.
    type Real: Copy;
    /// A register of `N` unsigned numbers of 32 bits.
    type Int: Copy;
    /// A register of `N` truth values.
    type Mask: Copy;
    /// Number of lanes.
    const N: usize;

    /// Fills all lanes with a number.
    fn f(self, x: f32) -> F<Self>;
    /// Fills all lanes with a whole number.
    fn u(self, x: u32) -> U<Self>;
    /// The mask whose first `n` lanes are set (all of them when `n` exceeds `N`).
    fn first(self, n: usize) -> M<Self>;
    /// The integers 0, 1, 2, …
    fn iota(self) -> U<Self>;
    /// The first `N` numbers of a slice.
    fn load(self, from: &[f32]) -> F<Self>;
    /// Row `index[lane]` of a table of four numbers for every lane, transposed into four columns.
    fn rows(self, table: &[[f32; 4]], index: U<Self>) -> [F<Self>; 4];
    /// The first `N` rows as four columns.
    fn transposed(self, rows: &[[f32; 4]]) -> [F<Self>; 4];

    /// Writes all lanes to the start of a slice.
    fn store(x: Self::Real, to: &mut [f32]);
    /// Writes all lanes to the start of a slice.
    fn store_int(x: Self::Int, to: &mut [u32]);
    /// Fills all lanes with a number.
    fn splat(like: Self::Real, x: f32) -> Self::Real;
    /// Fills all lanes with a whole number.
    fn splat_int(like: Self::Int, x: u32) -> Self::Int;

    /// a + b.
    fn add(a: Self::Real, b: Self::Real) -> Self::Real;
    /// a − b.
    fn sub(a: Self::Real, b: Self::Real) -> Self::Real;
    /// a b.
    fn mul(a: Self::Real, b: Self::Real) -> Self::Real;
    /// a/b, correctly rounded.
    fn div(a: Self::Real, b: Self::Real) -> Self::Real;
    /// −a.
    fn neg(a: Self::Real) -> Self::Real;
    /// The smaller value; `b` if either is NaN.
    fn min(a: Self::Real, b: Self::Real) -> Self::Real;
    /// The larger value; `b` if either is NaN.
    fn max(a: Self::Real, b: Self::Real) -> Self::Real;
    /// |a|.
    fn abs(a: Self::Real) -> Self::Real;
    /// √a, correctly rounded.
    fn sqrt(a: Self::Real) -> Self::Real;
    /// |a| with the sign of the other number.
    fn copysign(a: Self::Real, sign: Self::Real) -> Self::Real;
    /// a < b.
    fn lt(a: Self::Real, b: Self::Real) -> Self::Mask;
    /// a ≤ b.
    fn le(a: Self::Real, b: Self::Real) -> Self::Mask;
    /// The lanes set in `keep`, moved to the front; the other lanes are unspecified.
    fn compress(a: Self::Real, keep: Self::Mask) -> Self::Real;

    /// The bits of a number.
    fn bits(a: Self::Real) -> Self::Int;
    /// The number with these bits.
    fn from_bits(a: Self::Int) -> Self::Real;
    /// Converts to the nearest real.
    fn to_real(a: Self::Int) -> Self::Real;

    /// a + b modulo 2³².
    fn add_int(a: Self::Int, b: Self::Int) -> Self::Int;
    /// a b modulo 2³².
    fn mul_int(a: Self::Int, b: Self::Int) -> Self::Int;
    /// Bitwise exclusive or.
    fn xor(a: Self::Int, b: Self::Int) -> Self::Int;
    /// Bitwise or.
    fn or(a: Self::Int, b: Self::Int) -> Self::Int;
    /// Bitwise and.
    fn and(a: Self::Int, b: Self::Int) -> Self::Int;
    /// Shifts all lanes left.
    fn shl(a: Self::Int, by: u32) -> Self::Int;
    /// Shifts all lanes right.
    fn shr(a: Self::Int, by: u32) -> Self::Int;
    /// a = b.
    fn eq_int(a: Self::Int, b: Self::Int) -> Self::Mask;
    /// a < b.
    fn lt_int(a: Self::Int, b: Self::Int) -> Self::Mask;

    /// a where the mask is set, else b.
    fn pick(m: Self::Mask, a: Self::Real, b: Self::Real) -> Self::Real;
    /// a where the mask is set, else b.
    fn pick_int(m: Self::Mask, a: Self::Int, b: Self::Int) -> Self::Int;
    /// Whether both are set.
    fn and_mask(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Whether one of them is set.
    fn or_mask(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Whether it is not set.
    fn not(a: Self::Mask) -> Self::Mask;
    /// Whether some lane is set.
    fn any(a: Self::Mask) -> bool;
    /// Lane `i` as bit `i`.
    fn bitmask(a: Self::Mask) -> u64;
}

/// One lane of plain numbers: the scalar code path, for replays of single samples and for tests.
#[derive(Clone, Copy)]
pub struct One;

impl ExtractToken for One {
    type S = Fallback;
    #[inline(always)]
    fn token(&self) -> Fallback {
        Fallback::new()
    }
}
