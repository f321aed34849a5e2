//! The word of a surface: `material | stage << 16 | flags`.
use crate::material::Stage;
use noisefall_base::math::{Lanes, M, U};

/// Place of the stage.
pub const STAGE_SHIFT: u32 = 16;
/// Its bits, moved to the lowest place.
pub const STAGE_MASK: u32 = 0x1f;
const _: () = assert!(Stage::COUNT <= STAGE_MASK as usize + 1, "the word has too few bits for all stages");
/// Flag: the normal is reversed.
pub const FLIPPED: u32 = 1 << 21;
/// Flag: only the front reflects.
pub const ONE_SIDED: u32 = 1 << 22;
/// Flag: α is the square of its texture.
pub const SQUARED: u32 = 1 << 23;
/// Flag: the surface transmits and emits. Of lights, it samples only punctual lights, because it would find its own back.
pub const SELF_LIT: u32 = 1 << 24;
/// Flag: black colours scatter light too; see [`crate::material::CompiledMaterial::scatters_where_black`].
pub const SCATTERS_WHERE_BLACK: u32 = 1 << 25;
/// Flag: light that passes stays in its medium; see [`crate::material::CompiledMaterial::sheet`].
pub const SHEET: u32 = 1 << 30;
/// Flag: a blend. The first column of the row holds its index in [`super::Surfaces::blends`] as bits.
pub const BLENDED: u32 = 1 << 26;
/// Flag of [`super::Surfaces::relief`]: normals darken light at grazing angles.
pub const SHADOWED: u32 = 1;
/// Flag of [`super::Surfaces::relief`]: normals that face away from the viewer are mirrored.
pub const MIRRORED: u32 = 2;
/// Flag of [`super::Surfaces::relief`]: the back shows it as the front does.
pub const ON_BOTH_SIDES: u32 = 4;
/// Flag, set while rendering: the path hit the front.
pub const FRONT: u32 = 1 << 31;

/// The word of a material and a stage, without flags.
pub fn word(material: u32, stage: Stage) -> u32 {
    material | (stage as u32) << STAGE_SHIFT
}

/// The number of the material in a word.
#[inline(always)]
pub fn material<L: Lanes>(word: U<L>) -> U<L> {
    word & 0xffff
}

/// The stage in a word.
#[inline(always)]
pub fn stage<L: Lanes>(word: U<L>) -> U<L> {
    (word >> STAGE_SHIFT) & STAGE_MASK
}

/// Whether the material in a word transmits light.
pub fn transmits(word: u32) -> bool {
    Stage::ALL.get((word >> STAGE_SHIFT & STAGE_MASK) as usize).is_some_and(|stage| stage.transmits())
}

/// Whether a flag is set in a word.
#[inline(always)]
pub fn is_set<L: Lanes>(word: U<L>, flag: u32) -> M<L> {
    !(word & flag).is(0)
}
