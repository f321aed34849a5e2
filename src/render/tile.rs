//! A tile of the film: sums of samples per pixel, and counts per block of pixels.
use super::{
    estimate::{Doubling, Estimate},
    region::Region,
    scatter::{Parts, Scatter},
    tile_series::TileSeries,
};
use crate::integrator::{BLOCK, Blocks, TILE};

/// Minimum number of samples of every pixel.
pub(super) const UNIFORM: u32 = 4;

/// The pixels of one tile, row by row. Sums are f64, so that the millionth sample still counts.
pub struct Tile {
    /// Pixel coordinates of the upper left corner.
    pub origin: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// See [`super::film::Film::spp`].
    pub spp: u32,
    sum: Vec<[f64; 3]>,
    sum_of_squares: Vec<[f64; 3]>,
    /// The means at the last power of two of samples.
    before: Vec<[f32; 3]>,
    /// Row by row.
    pub(super) blocks: Vec<Block>,
    /// Scatter of samples summed over all pixels and channels, if all pixels have the same number of samples.
    whole: Scatter,
    /// The series by number of bounces, if it is shown.
    pub(super) series: Option<TileSeries>,
    /// Samples that were negative or not finite; they count as black.
    pub invalid: u64,
}

/// Pixels that have the same number of samples.
#[derive(Clone, Copy, Default)]
pub(super) struct Block {
    /// Samples taken of every pixel; at most twice `doubled`.
    pub spp: u32,
    /// The power of two of samples at which the last move of the block was recorded; 0 before the first sample.
    pub doubled: u32,
    /// Samples relative to the average, as an exponent to base 2.
    pub rate: i8,
    /// Records of the last three doublings of the number of samples, latest first. Doublings are at 2, 4, 8, … samples.
    pub doublings: [Doubling; 3],
    /// Parts of the variance of its pixels.
    parts: Parts,
}

impl Block {
    /// Whether the number of samples is a power of two whose move is not recorded yet.
    pub fn has_doubled(&self) -> bool {
        self.spp.is_power_of_two() && self.spp > self.doubled
    }

    /// The target number of samples for an average of `spp`, limited to the next doubling.
    fn next_goal(&self, spp: u32) -> u32 {
        self.goal(spp).min(self.doubled.saturating_mul(2).max(1))
    }

    /// The target number of samples for an average of `spp`.
    fn goal(&self, spp: u32) -> u32 {
        if spp <= UNIFORM {
            return spp;
        }
        let scaled = if self.rate < 0 { spp >> -self.rate } else { spp.saturating_mul(1 << self.rate) };
        scaled.max(UNIFORM)
    }
}

impl Tile {
    pub(super) fn new(origin: [u32; 2], size: [u32; 2]) -> Tile {
        let [columns, rows] = size.map(|side| side.div_ceil(BLOCK));
        Tile {
            origin,
            size,
            spp: 0,
            sum: Vec::new(),
            sum_of_squares: Vec::new(),
            before: Vec::new(),
            blocks: vec![Block::default(); (columns * rows) as usize],
            whole: Scatter::default(),
            series: None,
            invalid: 0,
        }
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
        let columns = self.size[0].div_ceil(BLOCK) as usize;
        let blocks = &self.blocks[row / BLOCK as usize * columns..][..columns];
        (0..self.size[0]).map(move |column| blocks[(column / BLOCK) as usize].spp)
    }

    /// Discards all samples.
    pub(super) fn forget(&mut self) {
        (self.spp, self.invalid, self.series, self.whole) = (0, 0, None, Scatter::default());
        self.blocks.fill(Block::default());
    }

    pub(super) fn samples(&self) -> u64 {
        let samples = |(block, state): (usize, &Block)| {
            let [width, height] = self.block_size(self.place(block)).map(u64::from);
            u64::from(state.spp) * width * height
        };
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

    /// Updates `spp` if no samples are missing for the average `spp`.
    pub(super) fn note_average(&mut self, spp: u32) {
        if self.distance_to(spp) == 0 {
            self.spp = spp;
        }
    }

    /// Blocks with missing samples for the average `spp`, up to the capacity of a batch. None gets samples beyond the next power
    /// of two.
    pub(super) fn missing(&self, spp: u32) -> Blocks {
        let mut missing = Blocks::default();
        for ahead in 0.. {
            let before = missing.iter().count();
            for (block, state) in self.blocks.iter().enumerate() {
                let sample = state.spp + ahead;
                if sample < state.next_goal(spp) && !missing.is_full() {
                    missing.push(self.corner(block), sample);
                }
            }
            if missing.is_full() || missing.iter().count() == before {
                break;
            }
        }
        missing
    }

    /// Adds one sample to every pixel; slot = row · [`TILE`] + column. Returns the first pixel whose sample is invalid.
    pub fn add(&mut self, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        self.clear_if_new();
        let (mut invalid, mut total) = (None, 0.0);
        for block in 0..self.blocks.len() {
            let [x, y] = self.place(block);
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
            let [column, row] = [0, 1].map(|axis| (corner[axis] - self.origin[axis]) / BLOCK);
            let block = (row * self.size[0].div_ceil(BLOCK) + column) as usize;
            let (_, found) = self.add_block(block, slots, BLOCK as usize);
            invalid = invalid.or(found.map(|pixel| (pixel, sample)));
        }
        invalid
    }

    /// Adds one sample to every pixel of a block; slot = row · `stride` + column. Returns the sum over pixels and channels, and the
    /// first pixel whose sample is invalid.
    fn add_block(&mut self, block: usize, radiance: &[[f32; 4]], stride: usize) -> (f64, Option<[u32; 2]>) {
        let (mut first_invalid, mut total) = (None, 0.0);
        let (count, mut parts) = (f64::from(self.blocks[block].spp), self.blocks[block].parts);
        let ([left, top], [width, height]) = (self.place(block), self.block_size(self.place(block)));
        for row in 0..height {
            let start = ((top + row) * self.size[0] + left) as usize;
            let pixels = start..start + width as usize;
            let sums = self.sum[pixels.clone()].iter_mut().zip(&mut self.sum_of_squares[pixels]);
            for (column, ((sum, square), sample)) in sums.zip(&radiance[row as usize * stride..]).enumerate() {
                let mut rgb = [sample[0], sample[1], sample[2]];
                // One comparison a channel refuses negative numbers, infinities and NaN alike.
                if !rgb.iter().all(|c| (0.0..=f32::MAX).contains(c)) {
                    self.invalid += 1;
                    let pixel = [self.origin[0] + left + column as u32, self.origin[1] + top + row];
                    first_invalid = first_invalid.or(Some(pixel));
                    rgb = [0.0; 3];
                }
                let rgb = rgb.map(f64::from);
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
        (total, first_invalid)
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
    }

    /// Records the moves of blocks since they had half as many samples, if due. `floor` is that of relMSE.
    pub(super) fn double(&mut self, floor: f64) {
        for block in 0..self.blocks.len() {
            if self.blocks[block].has_doubled() {
                self.double_block(block, floor);
            }
        }
    }

    fn double_block(&mut self, block: usize, floor: f64) {
        let estimates = self.block_estimates(block);
        let mut before = Vec::with_capacity(estimates.len());
        for (row, now) in self.block_rows(block).zip(estimates.chunks(self.block_size(self.place(block))[0] as usize)) {
            let means = &mut self.before[row];
            before.extend_from_slice(means);
            means.iter_mut().zip(now).for_each(|(mean, estimate)| *mean = estimate.mean.map(|c| c as f32));
        }
        let state = &mut self.blocks[block];
        state.doubled = state.spp;
        if state.spp > 1 {
            let [last, before_last, _] = state.doublings;
            state.doublings = [Doubling::new(&estimates, &before, floor), last, before_last];
        }
    }

    /// Index ranges of the pixels of a block, row by row.
    fn block_rows(&self, block: usize) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let ([left, top], [width, height]) = (self.place(block), self.block_size(self.place(block)));
        let starts = (top..top + height).map({
            let columns = self.size[0];
            move |row| (row * columns + left) as usize
        });
        starts.map(move |start| start..start + width as usize)
    }

    /// The estimates of a block that has a sample, row by row.
    fn block_estimates(&self, block: usize) -> Vec<Estimate> {
        self.block_rows(block).flat_map(|row| self.run(row, self.blocks[block].spp)).collect()
    }

    /// Sums over pixels and channels of two estimates of the squared radiance: squares of means minus their variance, and squares
    /// of the means of blocks.
    pub(super) fn squares(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (block, state) in self.blocks.iter().enumerate().filter(|(_, state)| state.spp > 0) {
            let (mut level, mut count) = ([0.0; 3], 0.0);
            for Estimate { mean, variance_of_mean } in self.block_rows(block).flat_map(|row| self.run(row, state.spp)) {
                let variance = variance_of_mean.unwrap_or_default();
                (0..3).for_each(|c| {
                    level[c] += mean[c];
                    sums[0] += mean[c] * mean[c] - variance[c];
                });
                count += 1.0;
            }
            sums[1] += level.iter().map(|level| level * level).sum::<f64>() / count;
        }
        sums
    }

    /// Variance of the mean over all pixels and channels, at least two samples each. If pixels share paths, their noise is
    /// correlated, and the variance comes from the scatter of samples of the whole tile; otherwise it comes from each pixel,
    /// which is more precise.
    pub(super) fn variance_of_mean(&self, shares: bool) -> f64 {
        let values = 3.0 * self.size.map(f64::from).iter().product::<f64>();
        let of_sum = if shares { self.whole.variance_of_mean() } else { self.parts().map(Parts::sum).sum() };
        of_sum / (values * values)
    }

    /// The parts of the variance of the pixels' means.
    pub(super) fn parts(&self) -> impl Iterator<Item = Parts> {
        self.blocks.iter().map(|block| block.parts.of_means(f64::from(block.spp)))
    }

    /// The estimates of one row of the tile, which must have a sample; `row` counts from the tile's top.
    pub fn estimates(&self, row: usize) -> impl Iterator<Item = Estimate> {
        let [width, _] = self.size.map(|side| side as usize);
        let columns = width.div_ceil(BLOCK as usize);
        let blocks = &self.blocks[row / BLOCK as usize * columns..][..columns];
        blocks.iter().enumerate().flat_map(move |(column, block)| {
            let left = column * BLOCK as usize;
            self.run(row * width + left..row * width + width.min(left + BLOCK as usize), block.spp)
        })
    }

    /// The estimates of some pixels with `spp` samples.
    fn run(&self, pixels: std::ops::Range<usize>, spp: u32) -> impl Iterator<Item = Estimate> {
        let n = f64::from(spp.max(1));
        let (per_sample, per_degree) = (1.0 / n, 1.0 / (n - 1.0));
        self.sum[pixels.clone()].iter().zip(&self.sum_of_squares[pixels]).map(move |(sum, square)| {
            let mean = sum.map(|s| s / n);
            let variance = |c: usize| ((square[c] * per_sample - mean[c] * mean[c]) * per_degree).max(0.0);
            Estimate { mean, variance_of_mean: (n > 1.0).then(|| [variance(0), variance(1), variance(2)]) }
        })
    }

    /// Pixel coordinates of the upper left corner of a block.
    pub(super) fn corner(&self, block: usize) -> [u32; 2] {
        let place = self.place(block);
        [0, 1].map(|axis| self.origin[axis] + place[axis])
    }

    /// Column and row, within the tile, of the upper left corner of a block.
    pub(super) fn place(&self, block: usize) -> [u32; 2] {
        let columns = self.size[0].div_ceil(BLOCK);
        [block as u32 % columns * BLOCK, block as u32 / columns * BLOCK]
    }

    /// Width and height of the block with its corner there.
    pub(super) fn block_size(&self, place: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| BLOCK.min(self.size[axis] - place[axis]))
    }
}
