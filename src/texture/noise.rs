//! Noise: a random smooth function of the world-space position, statistically the same at every position and in every direction.
//!
//! K. Perlin, "Improving Noise", SIGGRAPH 2002: gradients along the twelve edges of a cube at the points of a lattice, joined by
//! quintic curves. The gradients are chosen by an integer hash of the point instead of a table of permutations.
use super::{Found, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use crate::{
    declare::{CountRange, Declare, Kind, Parameter, Parameters, Problem, Range},
    math::{F, Lanes, M, Pick, U, V, round::floor},
    sampling::hash::{GOLDEN, hash},
};

/// Noise in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Cells of the first octave per metre.
    pub scale: f64,
    /// Number of octaves.
    pub octaves: u32,
    /// Colour of the lowest values.
    pub low: [f64; 3],
    /// Colour of the highest values.
    pub high: [f64; 3],
}

impl Default for Noise {
    fn default() -> Self {
        Noise { scale: 4.0, octaves: 4, low: [0.1; 3], high: [0.9; 3] }
    }
}

impl Kind for Noise {
    const KIND: Parameter =
        Parameter::new("noise", "Perlin noise in world space, between two colours.").aliases("perlin fbm turbulence");
}

impl Declare for Noise {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SCALE: Parameter = Parameter::new("scale", "Cells of the first octave per metre.").unit("m⁻¹").required();
        const OCTAVES: Parameter =
            Parameter::new("octaves", "Layers of noise, each of twice the frequency and half the amplitude.").required();
        const LOW: Parameter = Parameter::new("low", "The colour at 0.").required();
        const HIGH: Parameter = Parameter::new("high", "The colour at 1.").required();
        p.number(&SCALE, &mut self.scale, Range::log(1e-6, 1e5));
        p.count(&OCTAVES, &mut self.octaves, CountRange::new(1, 16));
        p.colour(&LOW, &mut self.low, Range::RADIANCE);
        p.colour(&HIGH, &mut self.high, Range::RADIANCE);
    }
}

impl Texturing for Noise {
    type Pattern = Clouds;

    fn compile(&self, _: &mut TextureCompiler) -> Result<Clouds, Problem> {
        let [low, high] = [self.low, self.high].map(|colour| colour.map(|x| x as f32));
        Ok(Clouds { scale: self.scale as f32, octaves: self.octaves, low, high })
    }
}

/// Noise as the renderer looks it up.
pub struct Clouds {
    /// Cells of the first octave per metre.
    pub scale: f32,
    /// Number of octaves.
    pub octaves: u32,
    /// Colour of the lowest values.
    pub low: [f32; 3],
    /// Colour of the highest values.
    pub high: [f32; 3],
}

impl Pattern for Clouds {
    fn summary(&self, _: &Textures) -> Summary {
        Summary {
            mean: [0, 1, 2].map(|channel| 0.5 * (self.low[channel] + self.high[channel])),
            maximum: [0, 1, 2].map(|channel| f32::max(self.low[channel], self.high[channel])),
            steps: [Summary::COARSEST, Summary::COARSEST, step(self.scale, self.octaves)],
            lookups: 0,
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, _: &Textures, found: &mut Found<L>) {
        let t = fraction(at.p, self.scale, self.octaves);
        found.colour = here.pick(V::splat(l, self.low) * (1.0 - t) + V::splat(l, self.high) * t, found.colour);
    }
}

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

/// A sixteenth of a cell of the finest octave, in metres.
pub fn step(scale: f32, octaves: u32) -> f32 {
    1.0 / (16.0 * scale * f32::powi(2.0, octaves as i32 - 1))
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
