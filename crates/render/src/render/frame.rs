//! A frame: a snapshot of the image, for use while the render continues.
use std::time::Duration;

use rayon::prelude::*;

use super::{
    error_estimator::block_errors,
    estimate::{Estimate, single},
    film::Film,
    halves::Halves,
    heavy_tail::has_heavy_tail,
    sample_counts::SampleCounts,
    scatter::VarianceParts,
    series::Series,
    tile::Tile,
};
use noisefall_base::math::colour::luminance;
use noisefall_kernel::{
    integrator::TILE,
    measure::{BlockErrors, SampleNoise},
};
use noisefall_scene::scene::PathReuse;

// The blocks of [`SampleNoise`] are the tiles.
const _: () = assert!(SampleNoise::BLOCK == TILE as usize);

/// Linear radiance, row by row from the top left. Immutable once published.
#[derive(Debug, Default)]
pub struct Frame {
    /// Number of the image that it belongs to.
    pub generation: u64,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The full resolution of the image; larger than that of the frame while the image is coarse.
    pub full_resolution: [u32; 2],
    /// Linear Rec. 709.
    pub radiance: Vec<[f32; 3]>,
    /// Upper bound of the standard error of the pixel's luminance, as if its channels were fully correlated; NaN before the second
    /// sample.
    pub standard_error: Vec<f32>,
    /// Minimum number of samples per pixel; with adaptive sampling, an upper bound of the average.
    pub spp: u32,
    /// Samples of every pixel, row by row; empty if all have `spp`.
    pub counts: Vec<u32>,
    /// Path reuse between its pixels.
    pub path_reuse: PathReuse,
    /// Time spent rendering it.
    pub elapsed: Duration,
    /// The series by number of bounces, if requested.
    pub series: Option<Series>,
    /// Estimated relMSE of the image: see `render/error_estimator.rs`; `None` before the second sample, and until light is found.
    pub rel_mse_estimate: Option<f64>,
    /// Whether few pixels carry the estimated error, so that the true one may be much larger: see `render/heavy_tail.rs`.
    pub error_is_lower_bound: bool,
    /// Estimated relMSE with each block left out; `None` where the estimate of the whole is.
    pub block_errors: Option<BlockErrors>,
    /// Two halves of the samples, if requested.
    pub halves: Option<Halves>,
    /// Noise of the means from the variance of the samples; `None` before the second sample.
    pub noise: Option<SampleNoise>,
}

impl Frame {
    /// The means of a film so far. A coarse film has a smaller resolution than `full_resolution`.
    pub fn of_film(film: &Film, generation: u64, [width, height]: [u32; 2], full_resolution: [u32; 2]) -> Frame {
        let pixels = width as usize * height as usize;
        let mut radiance = vec![[0.0; 3]; pixels];
        let mut standard_error = vec![f32::NAN; pixels];
        let mut variance = vec![[0.0; 3]; pixels];
        let band = (width * TILE) as usize;
        let rows: Vec<_> = film.tile_rows().collect();
        let bands = radiance.par_chunks_mut(band).zip(standard_error.par_chunks_mut(band)).zip(variance.par_chunks_mut(band));
        bands.zip(rows).for_each(|(((radiance, error), variance), tiles)| {
            for tile in tiles {
                for row in 0..tile.size[1] as usize {
                    let start = row * width as usize + tile.origin[0] as usize;
                    let mut i = start;
                    tile.visit_estimates(row, |estimate| {
                        radiance[i] = single(estimate.mean);
                        error[i] = luminance_error(&estimate);
                        variance[i] = single(estimate.variance_of_mean.unwrap_or_default());
                        i += 1;
                    });
                }
            }
        });
        let block_errors = block_errors(film);
        let error_is_lower_bound = block_errors.is_some() && has_heavy_tail(&radiance, &variance);
        Frame {
            generation,
            width,
            height,
            full_resolution,
            radiance,
            standard_error,
            spp: film.spp(),
            counts: counts(film),
            path_reuse: film.path_reuse,
            elapsed: Duration::ZERO,
            series: Series::of_film(film),
            halves: None,
            rel_mse_estimate: block_errors.as_ref().map(|errors| errors.whole),
            error_is_lower_bound,
            block_errors,
            noise: noise(film, variance),
        }
    }

    /// Samples of a pixel, by its index.
    pub fn spp_at(&self, index: usize) -> u32 {
        self.counts.get(index).copied().unwrap_or(self.spp)
    }

    /// Sample counts of the pixels.
    pub fn sample_counts(&self) -> SampleCounts {
        SampleCounts::of((0..self.radiance.len()).map(|index| self.spp_at(index)))
    }

    /// The index of the pixel of the frame that covers a pixel of the full image.
    pub fn index_at(&self, [x, y]: [u32; 2]) -> Option<usize> {
        let [w, h] = self.full_resolution;
        if x >= w || y >= h {
            return None;
        }
        let scaled = |at: u32, from: u32, to: u32| u64::from(at) * u64::from(to) / u64::from(from);
        Some((scaled(y, h, self.height) * u64::from(self.width) + scaled(x, w, self.width)) as usize)
    }

    /// Whether no sample has found any light.
    pub fn is_black(&self) -> bool {
        self.radiance.iter().all(|radiance| *radiance == [0.0; 3])
    }

    /// Whether the resolution is lower than that of the image.
    pub fn is_coarse(&self) -> bool {
        [self.width, self.height] != self.full_resolution
    }
}

/// See [`Frame::noise`].
fn noise(film: &Film, variance: Vec<[f32; 3]>) -> Option<SampleNoise> {
    let least = film.tiles.iter().flat_map(|tile| &tile.blocks).map(|block| block.spp).min()?;
    (least > 1).then(|| SampleNoise {
        width: film.resolution[0],
        variance,
        blocks: film.tiles.iter().map(|tile| tile.variance_of_mean(film.path_reuse.correlates())).collect(),
        block_degrees: if film.path_reuse.correlates() { f64::from(least - 1) } else { f64::INFINITY },
        effective_samples: VarianceParts::effective_count(film.tiles.iter().flat_map(Tile::parts)),
    })
}

/// See [`Frame::counts`].
fn counts(film: &Film) -> Vec<u32> {
    let spp = film.spp();
    if film.tiles.iter().all(|tile| !tile.is_adaptive() && tile.spp == spp) {
        return Vec::new();
    }
    let row = |tiles: &[Tile], row: usize| tiles.iter().flat_map(|tile| tile.counts(row)).collect::<Vec<_>>();
    let rows = film.tile_rows().flat_map(|tiles| (0..tiles[0].size[1] as usize).map(move |y| row(tiles, y)));
    rows.collect::<Vec<_>>().concat()
}

/// Standard error of the luminance. The channels of a sample come from one path: their errors are added as if fully correlated,
/// which is an upper bound.
#[inline]
fn luminance_error(estimate: &Estimate) -> f32 {
    let error = |variance: f64| (variance as f32).sqrt();
    estimate.variance_of_mean.map_or(f32::NAN, |[r, g, b]| luminance([error(r), error(g), error(b)]))
}
