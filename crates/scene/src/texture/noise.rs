//! Noise: a random smooth function of the world-space position, statistically the same at every position and in every direction.
use super::{LookupResult, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use crate::sampling::gradient_noise::fraction;
use noisefall_base::{
    declare::{CountRange, Declare, Kind, Parameter, Parameters, Problem, Range},
    math::{Lanes, M, Pick, V},
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
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, _: &Textures, found: &mut LookupResult<L>) {
        let t = fraction(at.p, self.scale, self.octaves);
        found.colour = here.pick(V::splat(l, self.low) * (1.0 - t) + V::splat(l, self.high) * t, found.colour);
    }
}

/// A sixteenth of a cell of the finest octave, in metres.
pub fn step(scale: f32, octaves: u32) -> f32 {
    1.0 / (16.0 * scale * f32::powi(2.0, octaves as i32 - 1))
}
