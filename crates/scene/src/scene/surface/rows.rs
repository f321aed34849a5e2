//! Rows of the tables of surfaces.
use crate::texture::{ColourSource, NumberSource};

/// A row of [`super::Surfaces::rows`].
pub struct SurfaceRow {
    pub colour: [f32; 3],
    /// `material | stage << 16 | flags`.
    pub word: u32,
}

impl SurfaceRow {
    pub fn pack(&self) -> [f32; 4] {
        let [r, g, b] = self.colour;
        [r, g, b, f32::from_bits(self.word)]
    }
}

/// A row of [`super::Surfaces::varying`].
pub struct VaryingRow {
    pub alpha: f32,
    pub colour_texture: Option<u32>,
    pub alpha_texture: Option<u32>,
    /// The medium inside, as an index into [`super::Surfaces::media`].
    pub medium: u32,
}

impl VaryingRow {
    pub fn pack(&self) -> [f32; 4] {
        [self.alpha, texture_bits(self.colour_texture), texture_bits(self.alpha_texture), f32::from_bits(self.medium)]
    }
}

/// An id plus 1, as bits; 0 is none.
pub fn texture_bits(texture: Option<u32>) -> f32 {
    f32::from_bits(texture.map_or(0, |id| id + 1))
}

/// A colour and its texture, which replaces it.
pub fn constant_and_texture(source: ColourSource) -> ([f32; 3], Option<u32>) {
    match source {
        ColourSource::Constant(colour) => (colour, None),
        ColourSource::Texture(id) => ([1.0; 3], Some(id)),
    }
}

/// A number and its texture.
pub fn number_row(source: NumberSource) -> [f32; 2] {
    match source {
        NumberSource::Constant(number) => [number, texture_bits(None)],
        NumberSource::Texture(id) => [1.0, texture_bits(Some(id))],
    }
}

/// −log₂ of the transmittance of a metre. For transmittance 0 it is finite, so that a distance of 0 transmits everything.
pub fn octaves_per_metre(transmittance: [f32; 3]) -> [f32; 4] {
    let octaves = |t: f32| (-t.log2()).min(1e30);
    [octaves(transmittance[0]), octaves(transmittance[1]), octaves(transmittance[2]), 0.0]
}
