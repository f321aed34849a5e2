//! The image of exact sums: means, variances and noise figures.
use super::{ranges::SampleRanges, sums::TileSums};
use crate::render::{
    area::Area,
    estimate::{Doubling, Estimate, SquaredRadiance, single},
    exact_sum::RESOLUTION,
    frame::Frame,
    heavy_tail::has_heavy_tail,
    splats::SplatEstimate,
};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_kernel::{
    integrator::TILE,
    measure::{Floor, SampleNoise},
};
use noisefall_scene::scene::PathReuse;

/// Some pixels have no sample.
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("the samples {0} leave pixels without any: adaptive sampling gives those a quarter of the average. Join more ranges")]
pub struct NoSamples(pub SampleRanges);

/// An image that is filled tile by tile. All of it is a function of the sums, so that it does not depend on how they were joined.
pub struct SplitPicture {
    resolution: [u32; 2],
    samples: SampleRanges,
    path_reuse: PathReuse,
    radiance: Vec<[f32; 3]>,
    variance: Vec<[f32; 3]>,
    counts: Vec<u32>,
    /// Variances of the means of tiles.
    tiles: Vec<f64>,
    /// Sums of the pixels' variances and of their squares.
    variances: [f64; 2],
    _memory: Reservation,
}

impl SplitPicture {
    /// An empty image, with memory for its file. `path_reuse` is the one in force.
    pub fn new(resolution: [u32; 2], samples: SampleRanges, path_reuse: PathReuse) -> Result<SplitPicture, TooMuch> {
        /// Bytes per pixel: two means and a count, the planes of an EXR, and the file.
        const PIXEL: u64 = 2 * 12 + 4 + 2 * 28;
        let [width, height] = resolution;
        let what = format_args!("images of {width} × {height} pixels");
        let memory = memory::reserve(what, PIXEL * u64::from(width) * u64::from(height))?;
        let pixels = width as usize * height as usize;
        Ok(SplitPicture {
            resolution,
            samples,
            path_reuse,
            radiance: vec![[0.0; 3]; pixels],
            variance: vec![[0.0; 3]; pixels],
            counts: vec![0; pixels],
            tiles: Vec::new(),
            variances: [0.0; 2],
            _memory: memory,
        })
    }

    /// Adds the next tile, row by row from the top left.
    pub fn add(&mut self, sums: &TileSums) -> Result<(), NoSamples> {
        if sums.counts.contains(&0) {
            return Err(NoSamples(self.samples.clone()));
        }
        let splats = self.splats_of(sums);
        let mut of_blocks = 0.0;
        for block in 0..sums.area.blocks() {
            of_blocks += self.add_block(sums, block);
        }
        let of_sum = if self.path_reuse.correlates() { of_whole(sums) } else { of_blocks } + self.add_splats(sums, &splats);
        let values = 3.0 * sums.area.pixels() as f64;
        self.tiles.push(of_sum / (values * values));
        Ok(())
    }

    /// Estimates the radiance that light paths add to the pixels of a tile.
    fn splats_of(&self, sums: &TileSums) -> Vec<SplatEstimate> {
        let Some(splats) = &sums.splats else { return Vec::new() };
        let samples = u64::from(self.samples.total());
        let pixels = self.resolution.map(u64::from).iter().product::<u64>();
        // A batch is a sample of a tile.
        let tiles = self.resolution.map(|side| u64::from(side.div_ceil(TILE))).iter().product::<u64>();
        splats.estimates(samples * pixels, samples * tiles)
    }

    /// Adds that to the image. Returns the variance of its sum over the pixels and channels, as if channels were fully correlated.
    fn add_splats(&mut self, sums: &TileSums, splats: &[SplatEstimate]) -> f64 {
        let [left, top] = sums.area.origin.map(|side| side as usize);
        let mut of_sum = 0.0;
        for (pixel, splat) in splats.iter().enumerate() {
            let [column, row] = [pixel % sums.area.size[0] as usize, pixel / sums.area.size[0] as usize];
            let i = (top + row) * self.resolution[0] as usize + left + column;
            for channel in 0..3 {
                self.radiance[i][channel] += splat.mean[channel];
                self.variance[i][channel] += splat.variance[channel];
            }
            of_sum += splat.variance.map(|variance| f64::from(variance).sqrt()).iter().sum::<f64>().powi(2);
        }
        of_sum
    }

    /// Returns the variance of the sum over the pixels and channels of a block, if its pixels are independent.
    fn add_block(&mut self, sums: &TileSums, block: usize) -> f64 {
        let (count, pixels) = (sums.counts[block], sums.area.pixels());
        let n = f64::from(count);
        let (corner, mut squared_sums) = (sums.area.corner(block), 0.0);
        for (row, range) in sums.area.block_rows(block).enumerate() {
            let at = (corner[1] as usize + row) * self.resolution[0] as usize + corner[0] as usize;
            for (i, pixel) in (at..).zip(range) {
                let sum = [0, 1, 2].map(|channel| sums.pixels.value(channel * pixels + pixel));
                let squares = [3, 4, 5].map(|plane| sums.pixels.value(plane * pixels + pixel));
                let variance = [0, 1, 2].map(|c| variance_of_mean(sum[c] * sum[c] / n, squares[c], count));
                self.radiance[i] = single(sum.map(|sum| sum / n));
                self.variance[i] = single(variance);
                self.counts[i] = count;
                let all: f64 = variance.iter().sum();
                self.variances = [self.variances[0] + all, self.variances[1] + all * all];
                squared_sums += (sum[0] + sum[1] + sum[2]).powi(2);
            }
        }
        variance_of_mean(squared_sums / n, sums.blocks.value(block), count)
    }

    /// The image, once all tiles are there.
    ///
    /// Its noise figures come from the variance of the samples alone, unlike those of a film, which also follow how the image moves as
    /// its samples double. They are upper bounds for stratified and Sobol samples.
    pub fn frame(self) -> Frame {
        let spp = self.samples.total();
        let least = self.counts.iter().copied().min().unwrap_or(0);
        let rel_mse_estimate = (least > 1).then(|| self.rel_mse());
        let error_is_lower_bound = least > 1 && has_heavy_tail(&self.radiance, &self.variance);
        let [sum, squares] = self.variances;
        let SplitPicture { resolution: [width, height], path_reuse, radiance, variance, counts, tiles, .. } = self;
        let noise = (least > 1).then(|| SampleNoise {
            width,
            variance,
            blocks: tiles,
            block_degrees: if path_reuse.correlates() { f64::from(least - 1) } else { f64::INFINITY },
            effective_samples: if squares > 0.0 { sum * sum / squares } else { f64::INFINITY },
        });
        let counts = if counts.iter().all(|count| *count == spp) { Vec::new() } else { counts };
        let full_resolution = [width, height];
        Frame {
            width,
            height,
            full_resolution,
            radiance,
            spp,
            counts,
            path_reuse,
            rel_mse_estimate,
            error_is_lower_bound,
            noise,
            ..Frame::default()
        }
    }

    /// The mean over pixels and channels of the variance relative to the squared radiance, smoothed over blocks.
    fn rel_mse(&self) -> f64 {
        let blocks = || Area::tiles(self.resolution).flat_map(|area| (0..area.blocks()).map(move |block| (area, block)));
        let squares = blocks().map(|(area, block)| SquaredRadiance::of(&self.estimates(&area, block)));
        let mean_square = squares.fold(SquaredRadiance::default(), SquaredRadiance::plus).mean(self.resolution);
        let floor = Floor::DEFAULT.of(mean_square);
        let variances = blocks().map(|(area, block)| {
            let estimates = self.estimates(&area, block);
            let means: Vec<[f32; 3]> = estimates.iter().map(|estimate| single(estimate.mean)).collect();
            Doubling::new(&estimates, &means, floor).variance
        });
        variances.sum::<f64>() / (3.0 * self.radiance.len() as f64)
    }

    fn estimates(&self, area: &Area, block: usize) -> Vec<Estimate> {
        let (corner, [width, height]) = (area.corner(block), area.block_size(area.place(block)));
        let estimate = |i: usize| Estimate {
            mean: self.radiance[i].map(f64::from),
            variance_of_mean: Some(self.variance[i].map(f64::from)),
        };
        let row = |y: u32| (corner[1] + y) as usize * self.resolution[0] as usize + corner[0] as usize;
        let rows = (0..height).map(row).flat_map(|start| start..start + width as usize);
        rows.map(estimate).collect::<Vec<_>>()
    }
}

/// The variance of the sum over the pixels and channels of a tile, from the sums of its samples.
fn of_whole(sums: &TileSums) -> f64 {
    let [total, squares] = [sums.whole.value(0), sums.whole.value(1)];
    variance_of_mean(total * total / f64::from(sums.counts[0]), squares, sums.counts[0])
}

/// The variance of a mean, from the squared sum of its samples over their number, and the sum of their squares. 0 if it is smaller
/// than what the sums resolve.
fn variance_of_mean(squared_sum: f64, squares: f64, count: u32) -> f64 {
    let deviations = squares - squared_sum;
    let n = f64::from(count);
    if count > 1 && deviations > RESOLUTION * squares { deviations / (n * (n - 1.0)) } else { 0.0 }
}
