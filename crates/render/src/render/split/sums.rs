//! The exact sums of a tile.
use fearless_simd_macros::simd;

use crate::render::{
    area::{Area, valid},
    exact_sum::{ExactSums, MOST_VALUES},
    splats::TileSplats,
};
use noisefall_base::math::{Lanes, SimdLevel, in_lanes};
use noisefall_kernel::integrator::{BLOCK, TILE};

/// Sums of each pixel: of the channels, and of their squares.
pub const PLANES: usize = 6;
/// Most blocks of a tile.
const BLOCKS: usize = ((TILE / BLOCK) * (TILE / BLOCK)) as usize;

/// Sums over the samples of a tile's pixels. They depend on the multiset of samples alone.
#[derive(Clone, Debug, PartialEq)]
pub struct TileSums {
    pub area: Area,
    /// Sums of red, green, blue and of their squares, each row by row over the pixels.
    pub pixels: ExactSums,
    /// Sums over samples, and over the pixels of each block, of (r + g + b)².
    pub blocks: ExactSums,
    /// Sums of the sum over pixels and channels of a sample, and of its square. They stay 0 if blocks differ in their samples.
    pub whole: ExactSums,
    /// Samples of each block.
    pub counts: Vec<u32>,
    /// Samples that were negative or not finite; they count as black.
    pub invalid: u64,
    /// Radiance that light paths add to the pixels, if there are any.
    pub splats: Option<TileSplats>,
}

/// Numbers of a row of pixels.
struct Row {
    planes: [[f64; TILE as usize]; PLANES],
    /// r + g + b.
    sums: [f64; TILE as usize],
}

/// The first column of a row whose sample is invalid.
type Invalid = Option<usize>;

impl TileSums {
    pub fn new(area: Area) -> TileSums {
        TileSums {
            area,
            pixels: ExactSums::new(PLANES * area.pixels()),
            blocks: ExactSums::new(area.blocks()),
            whole: ExactSums::new(2),
            counts: vec![0; area.blocks()],
            invalid: 0,
            splats: None,
        }
    }

    /// Adds a sample of every pixel; slot = row · [`TILE`] + column. Returns the first pixel whose sample is invalid.
    pub fn add(&mut self, level: SimdLevel, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        in_lanes!(level, l => self.add_rows(l, radiance))
    }

    /// Adds a sample of every pixel of a block; slot = row · [`BLOCK`] + column.
    pub fn add_block(&mut self, level: SimdLevel, block: usize, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        in_lanes!(level, l => self.add_rows_of_block(l, block, radiance))
    }

    /// Adds the sums of other samples of the same tile. Fails if they are too many.
    pub fn merge(&mut self, other: &TileSums) -> Result<(), TooManySamples> {
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count = count.checked_add(*more).filter(|count| *count <= MOST_VALUES).ok_or(TooManySamples)?;
        }
        self.pixels.merge(&other.pixels);
        self.blocks.merge(&other.blocks);
        self.whole.merge(&other.whole);
        self.invalid = self.invalid.saturating_add(other.invalid);
        match (&mut self.splats, &other.splats) {
            (Some(splats), Some(more)) => splats.merge(more),
            (splats, more) => *splats = splats.take().or_else(|| more.clone()),
        }
        let most = self.splats.iter().flat_map(|splats| &splats.counts).max();
        if most.is_some_and(|most| *most >= MOST_VALUES) { Err(TooManySamples) } else { Ok(()) }
    }

    #[simd]
    fn add_rows<L: Lanes>(&mut self, _l: L, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        let [width, height] = self.area.size.map(|side| side as usize);
        let (mut invalid, mut total, mut squares) = (None, 0.0, [0.0; BLOCKS]);
        let mut row = Row { planes: [[0.0; TILE as usize]; PLANES], sums: [0.0; TILE as usize] };
        for y in 0..height {
            let found = self.add_row(&mut row, y * width, &radiance[y * TILE as usize..][..width]);
            invalid = invalid.or(found.map(|x| [self.area.origin[0] + x as u32, self.area.origin[1] + y as u32]));
            let of_row = &mut squares[y / BLOCK as usize * self.area.columns() as usize..];
            for (of_block, sums) in of_row.iter_mut().zip(row.sums[..width].chunks(BLOCK as usize)) {
                sums.iter().for_each(|sum| *of_block += sum * sum);
            }
            row.sums[..width].iter().for_each(|sum| total += sum);
        }
        self.blocks.add(0, &squares[..self.area.blocks()]);
        self.whole.add(0, &[total, total * total]);
        self.counts.iter_mut().for_each(|count| *count += 1);
        invalid
    }

    #[simd]
    fn add_rows_of_block<L: Lanes>(&mut self, _l: L, block: usize, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        let corner = self.area.corner(block);
        let (mut invalid, mut square) = (None, 0.0);
        let mut row = Row { planes: [[0.0; TILE as usize]; PLANES], sums: [0.0; TILE as usize] };
        for (y, pixels) in self.area.block_rows(block).enumerate() {
            let width = pixels.len();
            let found = self.add_row(&mut row, pixels.start, &radiance[y * BLOCK as usize..][..width]);
            invalid = invalid.or(found.map(|x| [corner[0] + x as u32, corner[1] + y as u32]));
            row.sums[..width].iter().for_each(|sum| square += sum * sum);
        }
        self.blocks.add(block, &[square]);
        self.counts[block] += 1;
        invalid
    }

    /// Adds a sample of each of some pixels of a row, and leaves their numbers in `row`.
    #[inline(always)]
    fn add_row(&mut self, row: &mut Row, first: usize, samples: &[[f32; 4]]) -> Invalid {
        let width = samples.len().min(TILE as usize);
        let mut are_valid = true;
        for (x, sample) in samples[..width].iter().enumerate() {
            for (plane, value) in row.planes.iter_mut().zip(&sample[..3]) {
                are_valid &= (0.0..=f32::MAX).contains(value);
                plane[x] = f64::from(*value);
            }
        }
        let invalid = if are_valid { None } else { self.blacken(row, samples) };
        for channel in 0..3 {
            for x in 0..width {
                row.planes[channel + 3][x] = row.planes[channel][x] * row.planes[channel][x];
            }
        }
        for x in 0..width {
            row.sums[x] = row.planes[0][x] + row.planes[1][x] + row.planes[2][x];
        }
        let pixels = self.area.pixels();
        for (plane, values) in row.planes.iter().enumerate() {
            self.pixels.add(plane * pixels + first, &values[..width]);
        }
        invalid
    }

    /// Sets invalid samples of a row to black.
    #[cold]
    fn blacken(&mut self, row: &mut Row, samples: &[[f32; 4]]) -> Invalid {
        let invalid = || samples.iter().enumerate().filter(|(_, sample)| valid(sample).is_none()).map(|(x, _)| x);
        invalid().for_each(|x| (0..3).for_each(|channel| row.planes[channel][x] = 0.0));
        self.invalid += invalid().count() as u64;
        invalid().next()
    }
}

/// A pixel would have more samples than its sums can take.
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("a pixel would have more than {MOST_VALUES} samples, the most that exact sums can take")]
pub struct TooManySamples;
