//! The light that light paths bring to the pixels, as exact sums: they do not depend on the order in which threads add it.
use std::sync::{
    Mutex, MutexGuard, PoisonError,
    atomic::{AtomicU64, Ordering},
};

use super::{
    area::Area,
    exact_sum::{ExactSums, MOST_VALUES},
};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_kernel::integrator::{Splat, TILE};
use noisefall_scene::sampling::Filter;

/// Sums of a pixel: of the channels, and of their squares.
pub const PLANES: usize = 6;

/// Sums over the batches of light paths.
///
/// The light of a batch is added up for each pixel first. So its paths may be correlated, and the squares still tell the variance.
pub struct SplatFilm {
    resolution: [u32; 2],
    tiles: Vec<Mutex<TileSplats>>,
    batches: AtomicU64,
    /// Splats that were negative or not finite; they count as black.
    invalid: AtomicU64,
}

/// Sums of a tile.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TileSplats {
    /// For each pixel, row by row, the sums of red, green, blue, and of their squares.
    pub sums: ExactSums,
    /// For each pixel the number of values in its sums.
    pub counts: Vec<u32>,
}

/// Estimate of the radiance that splats add to a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SplatEstimate {
    /// Mean over all paths.
    pub mean: [f32; 3],
    /// Variance of the mean.
    pub variance: [f32; 3],
}

impl SplatFilm {
    /// A film without light.
    pub fn new(resolution: [u32; 2]) -> SplatFilm {
        let tiles = Area::tiles(resolution).map(|area| Mutex::new(TileSplats::new(area.pixels()))).collect();
        SplatFilm { resolution, tiles, batches: AtomicU64::new(0), invalid: AtomicU64::new(0) }
    }

    /// Reserves memory for the sums of an image of this size, and for their means.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        const PIXEL: u64 = PLANES as u64 * ExactSums::BYTES + 4 + size_of::<SplatEstimate>() as u64;
        memory::reserve(format_args!("light paths to {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// Adds the light of a batch, spread over the pixels by their filter.
    pub fn add(&self, filter: Filter, splats: &[Splat]) {
        self.batches.fetch_add(1, Ordering::Relaxed);
        let mut shares = Vec::with_capacity(splats.len());
        for splat in splats {
            if splat.light.iter().all(|light| (0.0..=f32::MAX).contains(light)) {
                shares.extend(self.share(filter, splat));
            } else {
                self.invalid.fetch_add(1, Ordering::Relaxed);
            }
        }
        // By tile and pixel, and the light of a pixel in the order of the batch.
        let mut order: Vec<u64> =
            shares.iter().zip(0..).map(|(share, place): (&Share, u64)| u64::from(share.key) << 32 | place).collect();
        order.sort_unstable();
        let share = |key: &u64| &shares[*key as u32 as usize];
        for of_tile in order.chunk_by(|a, b| share(a).tile() == share(b).tile()) {
            let mut tile = self.lock(share(&of_tile[0]).tile());
            for of_pixel in of_tile.chunk_by(|a, b| share(a).key == share(b).key) {
                let mut light = [0.0; 3];
                for key in of_pixel {
                    (0..3).for_each(|channel| light[channel] += share(key).light[channel]);
                }
                tile.add(share(&of_pixel[0]).pixel(), light);
            }
        }
    }

    /// Returns the light that a splat adds to its pixel.
    fn share(&self, filter: Filter, splat: &Splat) -> Option<Share> {
        let ([column, row], light) = splat.land(filter, self.resolution)?;
        let [width, _] = self.resolution;
        let tile = row / TILE * width.div_ceil(TILE) + column / TILE;
        let pixel = row % TILE * TILE.min(width - column / TILE * TILE) + column % TILE;
        Some(Share { key: tile * TILE * TILE + pixel, light })
    }

    /// The estimates of the pixels of a tile after `paths` light paths.
    pub fn estimates(&self, tile: usize, paths: u64) -> Vec<SplatEstimate> {
        self.lock(tile).estimates(paths, self.batches())
    }

    /// Number of batches of paths.
    pub fn batches(&self) -> u64 {
        self.batches.load(Ordering::Relaxed)
    }

    /// The sums of a tile.
    pub fn tile(&self, tile: usize) -> TileSplats {
        self.lock(tile).clone()
    }

    /// The film with these sums.
    pub fn of_tiles(resolution: [u32; 2], tiles: Vec<TileSplats>, [batches, invalid]: [u64; 2]) -> SplatFilm {
        let tiles = tiles.into_iter().map(Mutex::new).collect();
        SplatFilm { resolution, tiles, batches: AtomicU64::new(batches), invalid: AtomicU64::new(invalid) }
    }

    /// Whether the sums of a pixel can take no more values. Its light would be too dark.
    pub fn is_full(&self) -> bool {
        (0..self.tiles.len()).any(|tile| self.lock(tile).counts.iter().any(|count| *count >= MOST_VALUES))
    }

    fn lock(&self, tile: usize) -> MutexGuard<'_, TileSplats> {
        self.tiles[tile].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Splats that were negative or not finite since this was called before.
    pub fn take_invalid(&self) -> u64 {
        self.invalid.swap(0, Ordering::Relaxed)
    }

    /// Splats that were negative or not finite.
    pub fn invalid(&self) -> u64 {
        self.invalid.load(Ordering::Relaxed)
    }
}

/// The light of a splat in one pixel.
struct Share {
    /// The tile times the most pixels of a tile, plus the index of the pixel within the tile.
    key: u32,
    light: [f64; 3],
}

impl Share {
    fn tile(&self) -> usize {
        (self.key / (TILE * TILE)) as usize
    }

    fn pixel(&self) -> usize {
        (self.key % (TILE * TILE)) as usize
    }
}

impl TileSplats {
    /// Sums of no values.
    pub fn new(pixels: usize) -> TileSplats {
        TileSplats { sums: ExactSums::new(PLANES * pixels), counts: vec![0; pixels] }
    }

    /// Adds the light of a batch to a pixel.
    fn add(&mut self, pixel: usize, [r, g, b]: [f64; 3]) {
        let count = &mut self.counts[pixel];
        if *count < MOST_VALUES {
            *count += 1;
            self.sums.add(PLANES * pixel, &[r, g, b, r * r, g * g, b * b]);
        }
    }

    /// Adds the sums of other paths.
    pub fn merge(&mut self, other: &TileSplats) {
        self.sums.merge(&other.sums);
        self.counts.iter_mut().zip(&other.counts).for_each(|(count, more)| *count = count.saturating_add(*more));
    }

    /// The estimates of the pixels after `batches` of together `paths` paths.
    pub fn estimates(&self, paths: u64, batches: u64) -> Vec<SplatEstimate> {
        let (paths, batches) = (paths.max(1) as f64, batches.max(1) as f64);
        let estimate = |pixel: usize| {
            let sum = |plane: usize| self.sums.quick_value(PLANES * pixel + plane);
            let mut estimate = SplatEstimate::default();
            for channel in 0..3 {
                let total = sum(channel);
                let deviations = (sum(channel + 3) - total.powi(2) / batches).max(0.0);
                estimate.mean[channel] = (total / paths) as f32;
                estimate.variance[channel] = (deviations / (paths * paths)) as f32;
            }
            estimate
        };
        (0..self.counts.len()).map(estimate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn splat(x: f32, y: f32, light: f32) -> Splat {
        Splat { place: [x, y], u: [0.4, 0.7], light: [light, 2.0 * light, 0.0] }
    }

    #[test]
    fn a_splat_goes_to_the_pixels_whose_filter_reaches_it_by_their_filters() {
        const STEPS: u16 = 16;
        let steps = || (0..STEPS).map(|i| (f32::from(i) + 0.5) / f32::from(STEPS));
        for (filter, pixels) in [(Filter::default(), 1), (Filter::TENT, 4)] {
            let film = SplatFilm::new([40, 40]);
            let at = |u: [f32; 2]| Splat { u, ..splat(32.25, 31.75, 3.0) };
            let all: Vec<Splat> = steps().flat_map(|u| steps().map(move |v| at([u, v]))).collect();
            film.add(filter, &all);
            let estimates: Vec<SplatEstimate> = (0..4).flat_map(|tile| film.estimates(tile, 256)).collect();
            let lit = estimates.iter().map(|estimate| estimate.mean[1]).filter(|mean| *mean > 0.0);
            assert_eq!(lit.clone().count(), pixels, "{filter:?}");
            assert!((lit.clone().sum::<f32>() - 6.0).abs() < 1e-5, "filters of neighbours add up to 1");
            // A quarter of a pixel from the middle of one, three quarters from that of the other, in both directions.
            let most = lit.fold(0.0, f32::max);
            assert!(pixels == 1 || (most - 6.0 * 0.75 * 0.75).abs() < 1e-5, "{most}");
        }
    }

    #[test]
    fn the_order_of_batches_does_not_matter() {
        let batches: Vec<Vec<Splat>> = (0..50)
            .map(|i| (0..9).map(|j| splat(4.1 + 0.3 * j as f32, 7.9, 1e-3 * (i * j * j) as f32 + 1e-9)).collect())
            .collect();
        let [there, back] = [SplatFilm::new([9, 9]), SplatFilm::new([9, 9])];
        batches.iter().for_each(|batch| there.add(Filter::TENT, batch));
        batches.iter().rev().for_each(|batch| back.add(Filter::TENT, batch));
        assert_eq!(there.estimates(0, 50), back.estimates(0, 50));
    }

    #[test]
    fn splats_outside_the_image_and_invalid_ones_are_left_out() {
        let film = SplatFilm::new([4, 4]);
        film.add(Filter::TENT, &[splat(-3.0, 1.0, 1.0), splat(1.0, 99.0, 1.0), splat(2.0, 2.0, f32::NAN), splat(1.0, 1.0, -1.0)]);
        assert!(film.estimates(0, 1).iter().all(|estimate| *estimate == SplatEstimate::default()));
        assert_eq!(film.invalid(), 2);
    }
}
