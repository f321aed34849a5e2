//! The pixels of a tile, and its blocks of pixels.
use std::ops::Range;

use noisefall_kernel::integrator::{BLOCK, Blocks, TILE};

/// Where a tile lies in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// Pixel coordinates of the upper left corner.
    pub origin: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl Area {
    /// The tiles of an image, row by row from the top left.
    pub fn tiles([width, height]: [u32; 2]) -> impl Iterator<Item = Area> {
        let corners = |side: u32| (0..side).step_by(TILE as usize);
        let tile = move |x, y| Area { origin: [x, y], size: [TILE.min(width - x), TILE.min(height - y)] };
        corners(height).flat_map(move |y| corners(width).map(move |x| tile(x, y)))
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        (self.size[0] * self.size[1]) as usize
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        (self.columns() * self.size[1].div_ceil(BLOCK)) as usize
    }

    /// Blocks in a row.
    pub fn columns(&self) -> u32 {
        self.size[0].div_ceil(BLOCK)
    }

    /// Column and row, within the tile, of the upper left corner of a block.
    pub fn place(&self, block: usize) -> [u32; 2] {
        [block as u32 % self.columns() * BLOCK, block as u32 / self.columns() * BLOCK]
    }

    /// Pixel coordinates of the upper left corner of a block.
    pub fn corner(&self, block: usize) -> [u32; 2] {
        let place = self.place(block);
        [0, 1].map(|axis| self.origin[axis] + place[axis])
    }

    /// The block with its corner at these pixel coordinates.
    pub fn block_at(&self, corner: [u32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis| (corner[axis] - self.origin[axis]) / BLOCK);
        (row * self.columns() + column) as usize
    }

    /// Width and height of the block with its corner at this place.
    pub fn block_size(&self, place: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| BLOCK.min(self.size[axis] - place[axis]))
    }

    /// Number of pixels of a block.
    pub fn block_pixels(&self, block: usize) -> u64 {
        let [width, height] = self.block_size(self.place(block)).map(u64::from);
        width * height
    }

    /// Index ranges of the pixels of a block, row by row.
    pub fn block_rows(&self, block: usize) -> impl Iterator<Item = Range<usize>> + use<> {
        let ([left, top], [width, height]) = (self.place(block), self.block_size(self.place(block)));
        let columns = self.size[0];
        (top..top + height).map(move |row| (row * columns + left) as usize).map(move |start| start..start + width as usize)
    }

    /// The next samples of blocks, up to the capacity of a batch. `left` are the ranges of samples that each block lacks.
    pub fn batch(&self, left: &(impl Iterator<Item = Range<u32>> + Clone)) -> Blocks {
        let mut batch = Blocks::default();
        for ahead in 0.. {
            let before = batch.iter().count();
            for (block, samples) in left.clone().enumerate() {
                let sample = samples.start + ahead;
                if sample < samples.end && !batch.is_full() {
                    batch.push(self.corner(block), sample);
                }
            }
            if batch.is_full() || batch.iter().count() == before {
                break;
            }
        }
        batch
    }
}

/// The radiance of a sample; `None` if it is negative or not finite.
#[inline(always)]
pub(super) fn valid(&[r, g, b, _]: &[f32; 4]) -> Option<[f64; 3]> {
    // One comparison a channel refuses negative numbers, infinities and NaN alike.
    let is_valid = |c: f32| (0.0..=f32::MAX).contains(&c);
    (is_valid(r) && is_valid(g) && is_valid(b)).then(|| [f64::from(r), f64::from(g), f64::from(b)])
}
