//! Gradient noise: a random smooth function of three coordinates.
//!
//! K. Perlin, "Improving Noise", SIGGRAPH 2002: gradients along the twelve edges of a cube at the points of a lattice, joined by
//! quintic curves. The gradients are chosen by an integer hash of the point instead of a table of permutations.
use super::hash::{GOLDEN, hash};
use noisefall_base::math::{F, Lanes, Pick, U, V, round::floor};

/// A number in [0, 1], ½ on average, that varies with the position p: the fractal sum ½ + ½ Σ 2⁻ⁱ n(2ⁱ `scale` p), clamped.
#[inline(always)]
pub fn fraction<L: Lanes>(p: V<L>, scale: f32, octaves: u32) -> F<L> {
    // Lattices of all octaves would meet at the origin, where noise is 0 at every point of them: each is moved aside.
    const ASIDE: [f32; 3] = [0.413, 0.719, 0.297];
    let mut sum = p.x.splat(0.5);
    let (mut frequency, mut amplitude) = (scale, 0.5);
    for octave in 0..octaves {
        let aside = ASIDE.map(|x| x * octave as f32);
        sum = sum + lattice_noise(p * frequency + aside, octave) * amplitude;
        frequency *= 2.0;
        amplitude *= 0.5;
    }
    sum.max(sum.splat(0.0)).min(sum.splat(1.0))
}

/// Gradient noise, in about [−1.04, 1.04], 0 on average and at the lattice points.
#[inline(always)]
fn lattice_noise<L: Lanes>(p: V<L>, octave: u32) -> F<L> {
    let (x, column) = cell(p.x);
    let (y, row) = cell(p.y);
    let (z, layer) = cell(p.z);
    let (s, t, r) = (fade(x), fade(y), fade(z));
    let near = slice(x, y, z, (s, t), (column, row), hash(layer + octave.wrapping_mul(GOLDEN)));
    let far = slice(x, y, z - 1.0, (s, t), (column, row), hash(layer + octave.wrapping_mul(GOLDEN).wrapping_add(1)));
    near + r * (far - near)
}

/// The position within a cell of the lattice, and the cell's number. Noise is constant farther than 2²² cells from the origin.
#[inline(always)]
fn cell<L: Lanes>(x: F<L>) -> (F<L>, U<L>) {
    let (start, number) = floor(x);
    let within = x - start;
    (within.min(within.splat(1.0)).max(within.splat(0.0)), number)
}

/// 6x⁵ − 15x⁴ + 10x³.
#[inline(always)]
fn fade<L: Lanes>(x: F<L>) -> F<L> {
    x * x * x * (x * (x * 6.0 - 15.0) + 10.0)
}

/// The noise of the four corners of a cell in one layer, whose hash is `key`.
#[inline(always)]
fn slice<L: Lanes>(x: F<L>, y: F<L>, z: F<L>, (s, t): (F<L>, F<L>), (column, row): (U<L>, U<L>), key: U<L>) -> F<L> {
    let upper = hash(row + key);
    let lower = hash(row + key + 1);
    let a = ramp(hash(column + upper), x, y, z);
    let b = ramp(hash(column + upper + 1), x - 1.0, y, z);
    let c = ramp(hash(column + lower), x, y - 1.0, z);
    let d = ramp(hash(column + lower + 1), x - 1.0, y - 1.0, z);
    let (ab, cd) = (a + s * (b - a), c + s * (d - c));
    ab + t * (cd - ab)
}

/// The dot product of (x, y, z) with one of the twelve vectors from the centre of a cube to its edges. The four vectors with y =
/// 0 are chosen two thirds as often as the others.
#[inline(always)]
fn ramp<L: Lanes>(hash: U<L>, x: F<L>, y: F<L>, z: F<L>) -> F<L> {
    let h = hash >> 28;
    let first = h.below(8).pick(x, y);
    let second = h.below(4).pick(y, (h.is(12) | h.is(14)).pick(x, z));
    let signed_first = (hash << 31) ^ first.bits();
    let signed_second = ((hash << 30) & 0x8000_0000) ^ second.bits();
    signed_first.as_real_bits() + signed_second.as_real_bits()
}
