//! The items of a hierarchy while it is built.
use glam::Vec4;

use crate::geometry::bounds::Bounds;

/// Marks an empty slot of a leaf.
pub const NONE: u32 = u32::MAX;

/// The box of an item, with the item's number in `min.w`, so that sorting moves only 32 bytes.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub min: Vec4,
    pub max: Vec4,
}

impl Item {
    /// Offset of the bits of numbers. The bits of small integers are subnormal reals, with which computation takes a hundred
    /// times as long.
    const ZERO: u32 = 1 << 29;

    pub fn new(number: usize, bounds: &Bounds) -> Item {
        let ([x, y, z], [max_x, max_y, max_z]) = (bounds.min, bounds.max);
        Item { min: Vec4::new(x, y, z, f32::from_bits(number as u32 + Item::ZERO)), max: Vec4::new(max_x, max_y, max_z, 0.0) }
    }

    pub fn number(&self) -> u32 {
        self.min.w.to_bits() - Item::ZERO
    }

    /// Twice the centre of the box.
    #[inline(always)]
    pub fn center(&self) -> Vec4 {
        self.min + self.max
    }
}
