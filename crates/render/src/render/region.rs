//! A region of the image that is rendered before the rest.
use noisefall_kernel::integrator::TILE;

/// A rectangle of pixels, from the upper left corner up to, and excluding, the lower right one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Left and top.
    pub from: [u32; 2],
    /// Right and bottom, exclusive.
    pub to: [u32; 2],
}

impl Region {
    /// The rectangle between two corners, both included.
    pub fn between(a: [u32; 2], b: [u32; 2]) -> Region {
        let of = |choose: fn(u32, u32) -> u32| [0, 1].map(|axis| choose(a[axis], b[axis]));
        Region { from: of(Ord::min), to: of(Ord::max).map(|x| x + 1) }
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.to[axis].saturating_sub(self.from[axis]))
    }

    /// The part inside an image; `None` if there is none.
    pub fn within(&self, resolution: [u32; 2]) -> Option<Region> {
        let to = [0, 1].map(|axis| self.to[axis].min(resolution[axis]));
        (0..2).all(|axis| self.from[axis] < to[axis]).then_some(Region { from: self.from, to })
    }

    /// Whether it overlaps the rectangle of this origin and size.
    pub fn meets(&self, origin: [u32; 2], size: [u32; 2]) -> bool {
        (0..2).all(|axis| self.from[axis] < origin[axis] + size[axis] && origin[axis] < self.to[axis])
    }

    /// The rectangle of the tiles that it touches in an image; tiles are rendered as a whole.
    pub fn in_tiles(&self, resolution: [u32; 2]) -> Region {
        let to = [0, 1].map(|axis| self.to[axis].next_multiple_of(TILE).min(resolution[axis]));
        Region { from: self.from.map(|x| x / TILE * TILE), to }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_come_in_any_order_and_edges_do_not_overlap() {
        let region = Region::between([40, 10], [31, 12]);
        assert_eq!(region, Region { from: [31, 10], to: [41, 13] });
        assert!(region.meets([0, 0], [32, 32]) && region.meets([32, 0], [32, 32]));
        assert!(!region.meets([41, 0], [32, 32]) && !region.meets([32, 13], [32, 32]));
        assert_eq!(region.within([35, 100]).map(|part| part.to), Some([35, 13]));
        assert_eq!(region.within([31, 100]), None);
        assert_eq!(region.in_tiles([60, 100]), Region { from: [0, 0], to: [60, 32] });
    }
}
