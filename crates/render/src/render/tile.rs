//! A tile of the film: sums of samples per pixel, and counts per block of pixels.
use super::{
    area::{Area, valid},
    block::Block,
    region::Region,
    scatter::Scatter,
    splats::SplatEstimate,
    tile_series::TileSeries,
};
use noisefall_kernel::integrator::{BLOCK, Blocks, TILE, Thresholds};

/// The pixels of one tile, row by row. Sums are f64, so that the millionth sample still counts.
pub struct Tile {
    /// Pixel coordinates of the upper left corner.
    pub origin: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// See [`super::film::Film::spp`].
    pub spp: u32,
    pub(super) sum: Vec<[f64; 3]>,
    pub(super) sum_of_squares: Vec<[f64; 3]>,
    /// The means at the last power of two of samples.
    pub(super) before: Vec<[f32; 3]>,
    /// The means at the power of two before that. They are kept whether half images are requested or not, so that a render that has
    /// begun can be denoised.
    pub(super) earlier: Vec<[f32; 3]>,
    /// Row by row.
    pub(super) blocks: Vec<Block>,
    /// Scatter of samples summed over all pixels and channels, if all pixels have the same number of samples.
    pub(super) whole: Scatter,
    /// The series by number of bounces, if it is shown.
    pub(super) series: Option<TileSeries>,
    /// Radiance that light paths have added to the pixels; empty if there are none.
    pub(super) splats: Vec<SplatEstimate>,
    /// Thresholds of outliers, once they are known.
    pub(super) thresholds: Option<Thresholds>,
    /// Samples that were negative or not finite; they count as black.
    pub invalid: u64,
}

impl Tile {
    pub(super) fn new(origin: [u32; 2], size: [u32; 2]) -> Tile {
        Tile {
            origin,
            size,
            spp: 0,
            sum: Vec::new(),
            sum_of_squares: Vec::new(),
            before: Vec::new(),
            earlier: Vec::new(),
            blocks: vec![Block::default(); Area { origin, size }.blocks()],
            whole: Scatter::default(),
            series: None,
            splats: Vec::new(),
            thresholds: None,
            invalid: 0,
        }
    }

    /// Where it lies.
    pub(super) fn area(&self) -> Area {
        Area { origin: self.origin, size: self.size }
    }

    /// Starts to store the terms of samples separately.
    pub(super) fn keep_series(&mut self) {
        self.series = Some(TileSeries::new((self.size[0] * self.size[1]) as usize));
    }

    pub(super) fn lies_in(&self, region: &Region) -> bool {
        region.meets(self.origin, self.size)
    }

    /// Samples of the pixels of one row, which counts from the tile's top.
    pub(super) fn counts(&self, row: usize) -> impl Iterator<Item = u32> {
        let columns = self.area().columns() as usize;
        let blocks = &self.blocks[row / BLOCK as usize * columns..][..columns];
        (0..self.size[0]).map(move |column| blocks[(column / BLOCK) as usize].spp)
    }

    /// Discards all samples.
    pub(super) fn forget(&mut self) {
        (self.spp, self.invalid, self.series, self.whole) = (0, 0, None, Scatter::default());
        self.blocks.fill(Block::default());
        self.splats.clear();
        self.thresholds = None;
    }

    pub(super) fn samples(&self) -> u64 {
        let samples = |(block, state): (usize, &Block)| u64::from(state.spp) * self.area().block_pixels(block);
        self.blocks.iter().enumerate().map(samples).sum()
    }

    pub(super) fn is_adaptive(&self) -> bool {
        self.blocks.iter().any(|block| block.rate != 0)
    }

    /// The number of samples that [`Tile::missing`] would return without its limits.
    pub(super) fn distance_to(&self, spp: u32) -> u64 {
        self.blocks.iter().map(|block| u64::from(block.goal(spp).saturating_sub(block.spp))).sum()
    }

    /// Whether no block can take another sample towards the average `spp` before doublings are recorded.
    pub(super) fn has_reached(&self, spp: u32) -> bool {
        self.blocks.iter().all(|block| block.spp >= block.next_goal(spp))
    }

    /// Whether the samples of a block have doubled that are beyond its goal for the average `spp`.
    pub(super) fn is_ahead_of(&self, spp: u32) -> bool {
        self.blocks.iter().any(|block| block.has_doubled() && block.spp > block.goal(spp))
    }

    /// Updates `spp` if no samples are missing for the average `spp`.
    pub(super) fn note_average(&mut self, spp: u32) {
        if self.distance_to(spp) == 0 {
            self.spp = spp;
        }
    }

    /// Blocks with missing samples for the average `spp`, up to the capacity of a batch. None gets samples beyond the next power
    /// of two.
    pub(super) fn missing(&self, spp: u32) -> Blocks {
        self.area().batch(&self.blocks.iter().map(|block| block.spp..block.next_goal(spp)))
    }

    /// Adds one sample to every pixel; slot = row · [`TILE`] + column. Returns the first pixel whose sample is invalid.
    pub fn add(&mut self, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        self.clear_if_new();
        let (mut invalid, mut total) = (None, 0.0);
        for block in 0..self.blocks.len() {
            let [x, y] = self.area().place(block);
            let (sum, found) = self.add_block(block, &radiance[(y * TILE + x) as usize..], TILE as usize);
            invalid = invalid.or(found);
            total += sum;
        }
        self.whole.add(total);
        self.spp += 1;
        invalid
    }

    /// Adds samples of blocks, block by block; slot = row · [`BLOCK`] + column. Returns the first invalid one.
    pub(super) fn add_blocks(&mut self, blocks: &Blocks, radiance: &[[f32; 4]]) -> Option<([u32; 2], u32)> {
        self.clear_if_new();
        let mut invalid = None;
        for ((corner, sample), slots) in blocks.iter().zip(radiance.chunks((BLOCK * BLOCK) as usize)) {
            let (_, found) = self.add_block(self.area().block_at(corner), slots, BLOCK as usize);
            invalid = invalid.or(found.map(|pixel| (pixel, sample)));
        }
        invalid
    }

    /// Adds one sample to every pixel of a block; slot = row · `stride` + column. Returns the sum over pixels and channels, and the
    /// first pixel whose sample is invalid.
    fn add_block(&mut self, block: usize, radiance: &[[f32; 4]], stride: usize) -> (f64, Option<[u32; 2]>) {
        let (mut first_invalid, mut total) = (None, 0.0);
        let (count, mut parts) = (f64::from(self.blocks[block].spp), self.blocks[block].parts);
        for (row, pixels) in self.area().block_rows(block).enumerate() {
            let sums = self.sum[pixels.clone()].iter_mut().zip(&mut self.sum_of_squares[pixels]);
            for (column, ((sum, square), sample)) in sums.zip(&radiance[row * stride..]).enumerate() {
                let rgb = valid(sample).unwrap_or_else(|| {
                    self.invalid += 1;
                    first_invalid = first_invalid.or(Some([column, row]));
                    [0.0; 3]
                });
                let all = rgb[0] + rgb[1] + rgb[2];
                parts.add(all, count, sum[0] + sum[1] + sum[2]);
                total += all;
                for channel in 0..3 {
                    sum[channel] += rgb[channel];
                    square[channel] += rgb[channel] * rgb[channel];
                }
            }
        }
        let state = &mut self.blocks[block];
        state.spp += 1;
        state.parts = parts;
        let corner = self.area().corner(block);
        (total, first_invalid.map(|place| [0, 1].map(|axis| corner[axis] + place[axis] as u32)))
    }

    /// Resets all pixels to black before the first sample.
    fn clear_if_new(&mut self) {
        if self.blocks.iter().any(|block| block.spp > 0) {
            return;
        }
        let pixels = (self.size[0] * self.size[1]) as usize;
        for sums in [&mut self.sum, &mut self.sum_of_squares] {
            sums.clear();
            sums.resize(pixels, [0.0; 3]);
        }
        self.before.resize(pixels, [0.0; 3]);
        self.earlier.resize(pixels, [0.0; 3]);
    }
}
