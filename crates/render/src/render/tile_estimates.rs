//! Statistics of the samples of a tile: means and their variance, and the changes of its blocks as the sample count doubles.
use std::ops::Range;

use super::{
    estimate::{Doubling, Estimate, SquaredRadiance, single},
    scatter::VarianceParts,
    splats::SplatEstimate,
    tile::Tile,
};
use noisefall_kernel::integrator::BLOCK;

impl Tile {
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
        for (row, now) in
            self.area().block_rows(block).zip(estimates.chunks(self.area().block_size(self.area().place(block))[0] as usize))
        {
            self.earlier[row.clone()].copy_from_slice(&self.before[row.clone()]);
            let means = &mut self.before[row];
            before.extend_from_slice(means);
            means.iter_mut().zip(now).for_each(|(mean, estimate)| *mean = single(estimate.mean));
        }
        let state = &mut self.blocks[block];
        state.doubled = state.spp;
        if state.spp > 1 {
            let [last, before_last, _] = state.doublings;
            state.doublings = [Doubling::new(&estimates, &before, floor), last, before_last];
        }
    }

    /// The estimates of a block that has a sample, row by row.
    fn block_estimates(&self, block: usize) -> Vec<Estimate> {
        let mut estimates = Vec::with_capacity((BLOCK * BLOCK) as usize);
        for row in self.area().block_rows(block) {
            self.visit_run(row, self.blocks[block].spp, &mut |estimate| estimates.push(estimate));
        }
        estimates
    }

    /// The squared radiance of its blocks: see [`SquaredRadiance`].
    pub(super) fn squares(&self) -> SquaredRadiance {
        let blocks = (0..self.blocks.len()).filter(|block| self.blocks[*block].spp > 0);
        blocks
            .map(|block| SquaredRadiance::of(&self.block_estimates(block)))
            .fold(SquaredRadiance::default(), SquaredRadiance::plus)
    }

    /// Variance of the mean over all pixels and channels, at least two samples each. If pixels reuse paths, their noise is
    /// correlated, and the variance comes from the scatter of samples of the whole tile; otherwise it comes from each pixel,
    /// which is more precise.
    pub(super) fn variance_of_mean(&self, shares: bool) -> f64 {
        let values = 3.0 * self.size.map(f64::from).iter().product::<f64>();
        let of_sum = if shares { self.whole.variance_of_mean() } else { self.parts().map(VarianceParts::sum).sum() };
        // The channels of a path are added as if fully correlated, which is an upper bound.
        let of_splat = |splat: &SplatEstimate| splat.variance.map(|v| f64::from(v).sqrt()).iter().sum::<f64>().powi(2);
        (of_sum + self.splats.iter().map(of_splat).sum::<f64>()) / (values * values)
    }

    /// The parts of the variance of the pixels' means.
    pub(super) fn parts(&self) -> impl Iterator<Item = VarianceParts> {
        self.blocks.iter().map(|block| block.parts.of_means(f64::from(block.spp)))
    }

    /// The means of the first samples of a pixel and of the rest, and the share of the first; `None` before the second sample.
    pub(super) fn halves(&self, [column, row]: [u32; 2]) -> Option<([[f32; 3]; 2], f32)> {
        let block = &self.blocks[(row / BLOCK * self.area().columns() + column / BLOCK) as usize];
        let first = block.first_half()?;
        let pixel = (row * self.size[0] + column) as usize;
        let mean = if first == block.doubled { self.before[pixel] } else { self.earlier[pixel] };
        let [n, rest] = [first, block.spp - first].map(f64::from);
        let splats = self.splats.get(pixel).copied().unwrap_or_default();
        let sum = |c: usize| self.sum[pixel][c] + (n + rest) * f64::from(splats.mean[c]);
        let of_rest = [0, 1, 2].map(|c| ((sum(c) - n * f64::from(mean[c])) / rest).max(0.0) as f32);
        Some(([mean, of_rest], (n / (n + rest)) as f32))
    }

    /// The estimates of one row of the tile: see [`Tile::visit_estimates`].
    pub fn estimates(&self, row: usize) -> Vec<Estimate> {
        let mut estimates = Vec::with_capacity(self.size[0] as usize);
        self.visit_estimates(row, |estimate| estimates.push(estimate));
        estimates
    }

    /// Calls `visit` with the estimates of one row of the tile, which must have a sample; `row` counts from the tile's top.
    #[inline]
    pub fn visit_estimates(&self, row: usize, mut visit: impl FnMut(Estimate)) {
        let [width, _] = self.size.map(|side| side as usize);
        let columns = width.div_ceil(BLOCK as usize);
        for (column, block) in self.blocks[row / BLOCK as usize * columns..][..columns].iter().enumerate() {
            let left = column * BLOCK as usize;
            self.visit_run(row * width + left..row * width + width.min(left + BLOCK as usize), block.spp, &mut visit);
        }
    }

    /// Calls `visit` with the estimates of some pixels with `spp` samples.
    #[inline]
    fn visit_run(&self, pixels: Range<usize>, spp: u32, visit: &mut impl FnMut(Estimate)) {
        let n = f64::from(spp.max(1));
        let (per_sample, per_degree) = (1.0 / n, 1.0 / (n - 1.0));
        for pixel in pixels {
            let (sum, square) = (&self.sum[pixel], &self.sum_of_squares[pixel]);
            let mean = [sum[0] / n, sum[1] / n, sum[2] / n];
            let variance = |c: usize| ((square[c] * per_sample - mean[c] * mean[c]) * per_degree).max(0.0);
            let estimate = Estimate { mean, variance_of_mean: (n > 1.0).then(|| [variance(0), variance(1), variance(2)]) };
            visit(self.splats.get(pixel).map_or(estimate, |splats| estimate.plus(splats)));
        }
    }
}
