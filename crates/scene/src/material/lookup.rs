//! Parameters that may be textures: how the rows of a material state them, and their values at surface points.
use crate::texture::{ColourSource, TextureCoordinates, Textures};
use noisefall_base::math::{F, Lanes, Pick, U, V};

/// The textures of a scene, and the coordinates at which they are looked up.
pub type Lookup<'a, L> = Option<(&'a Textures, TextureCoordinates<'a, L>)>;

/// The constant value of a source; 0 of a texture.
pub fn value(source: ColourSource) -> [f32; 3] {
    match source {
        ColourSource::Constant(value) => value,
        ColourSource::Texture(_) => [0.0; 3],
    }
}

/// The id of the texture of a source plus 1, as bits; 0 of a constant.
pub fn id(source: ColourSource) -> f32 {
    match source {
        ColourSource::Constant(_) => 0.0,
        ColourSource::Texture(id) => f32::from_bits(id + 1),
    }
}

/// The colour of the texture whose id plus 1 is `id`; `constant` in lanes where that is 0, and without a lookup.
#[inline(always)]
pub fn colour<L: Lanes>(l: L, constant: V<L>, id: U<L>, lookup: &Lookup<L>) -> V<L> {
    let Some((textures, at)) = lookup else { return constant };
    let textured = !id.is(0);
    if !textured.any() {
        return constant;
    }
    textured.pick(textures.colour(l, id + u32::MAX, textured, at), constant)
}

/// The luminance of the texture whose id plus 1 is `id`; `constant` in lanes where that is 0, and without a lookup.
#[inline(always)]
pub fn number<L: Lanes>(l: L, constant: F<L>, id: U<L>, lookup: &Lookup<L>) -> F<L> {
    let Some((textures, at)) = lookup else { return constant };
    let textured = !id.is(0);
    if !textured.any() {
        return constant;
    }
    textured.pick(textures.height(l, id + u32::MAX, textured, at), constant)
}
