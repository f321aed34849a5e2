//! What a primitive's surface is, packed in one word a primitive: `material | stage << 16 | flags`.
use crate::math::{Lanes, M, U};

const STAGE_SHIFT: u32 = 16;
const STAGE_MASK: u32 = 0xf;
/// The normal is reversed.
pub const FLIPPED: u32 = 1 << 20;
/// Only the front reflects.
pub const ONE_SIDED: u32 = 1 << 21;
/// Set while rendering where a path met the front.
pub const FRONT: u32 = 1 << 31;

/// The shading stages: a kind of bsdf each, and one for diffuse surfaces that need nothing but their colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    Plain,
    Diffuse,
    Mirror,
    Conductor,
    Dielectric,
    RoughDielectric,
    Plastic,
}

impl Stage {
    pub const COUNT: usize = Stage::Plastic as usize + 1;
}

/// The word of a surface.
pub fn pack(material: u32, stage: Stage, flags: u32) -> u32 {
    material | (stage as u32) << STAGE_SHIFT | flags
}

#[inline(always)]
pub fn material<L: Lanes>(surface: U<L>) -> U<L> {
    surface & 0xffff
}

#[inline(always)]
pub fn stage<L: Lanes>(surface: U<L>) -> U<L> {
    (surface >> STAGE_SHIFT) & STAGE_MASK
}

#[inline(always)]
pub fn is_set<L: Lanes>(surface: U<L>, flag: u32) -> M<L> {
    !(surface & flag).is(0)
}
