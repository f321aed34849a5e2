//! The slots of a batch: which pixel of a tile each holds.
use noisefall_base::math::{Lanes, U};
use noisefall_scene::sampling::hash::hash_one;

/// Maximum width and height of a tile in pixels.
pub const TILE: u32 = 32;

/// A batch has a slot for every pixel of a tile.
pub(super) const SLOTS: usize = (TILE * TILE) as usize;

/// Maximum width and height of a block in pixels.
pub const BLOCK: u32 = 8;

/// Number of blocks in a tile, which is also the capacity of a batch.
pub const BLOCKS: usize = SLOTS / (BLOCK * BLOCK) as usize;

/// Width and height of a group in pixels.
const WIDTH: u32 = 4;

const HEIGHT: u32 = 4;

/// Number of pixels in a group. A sample costs one additional visibility ray for each pixel but one.
pub(super) const MEMBERS: usize = (WIDTH * HEIGHT) as usize;

/// Number of groups in a batch. Its slots are the first members of all groups, then the second members, and so on.
pub(super) const GROUPS: usize = SLOTS / MEMBERS;

/// Column and row of slots within their tile. Groups are shifted in every sample, so that their edges are not visible.
#[inline(always)]
pub(super) fn place_in_groups<L: Lanes>(slot: U<L>, sample: u32) -> (U<L>, U<L>) {
    let (member, group) = (slot >> GROUPS.trailing_zeros(), slot & (GROUPS as u32 - 1));
    let offset = hash_one(sample);
    let x = (group & (TILE / WIDTH - 1)) * WIDTH + (member & (WIDTH - 1));
    let y = (group >> (TILE / WIDTH).trailing_zeros()) * HEIGHT + (member >> WIDTH.trailing_zeros());
    ((x + (offset & (TILE - 1))) & (TILE - 1), (y + (offset >> 16)) & (TILE - 1))
}
