//! The film: what a picture's samples add up to.
use super::doubling::Doubling;
use crate::integrator::TILE;

/// Sums of samples over all pixels, in tiles that each belong to one thread at a time.
pub struct Film {
    pub(super) resolution: [u32; 2],
    pub tiles: Vec<Tile>,
}

/// The pixels of one tile, row by row. Sums are f64, so that a millionth sample still counts.
pub struct Tile {
    /// Pixel coordinates of the upper left corner.
    pub origin: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples taken of every pixel.
    pub spp: u32,
    sum: Vec<[f64; 3]>,
    sum_of_squares: Vec<[f64; 3]>,
    /// The means when the number of samples was last a power of two.
    before: Vec<[f32; 3]>,
    /// What was seen whenever the number of samples had doubled: at 2, 4, 8, … samples.
    pub(super) doublings: Vec<Doubling>,
    /// Samples that were not finite, or negative; they count as black.
    pub invalid: u64,
}

/// Mean of a pixel's samples and the variance of that mean, a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub mean: [f64; 3],
    /// `None` before the second sample.
    pub variance_of_mean: Option<[f64; 3]>,
}

impl Film {
    /// An empty film. Its memory is taken by the first sample, tile by tile on the threads that render.
    pub fn new(resolution: [u32; 2]) -> Film {
        let [width, height] = resolution;
        let corners = |side: u32| (0..side).step_by(TILE as usize);
        let tile = |x: u32, y: u32| Tile::new([x, y], [TILE.min(width - x), TILE.min(height - y)]);
        Film { resolution, tiles: corners(height).flat_map(|y| corners(width).map(move |x| tile(x, y))).collect() }
    }

    /// An empty film in the memory of this one, if it has the right size.
    pub fn recycled(mut self, resolution: [u32; 2]) -> Film {
        if self.resolution != resolution {
            return Film::new(resolution);
        }
        for tile in &mut self.tiles {
            (tile.spp, tile.invalid) = (0, 0);
        }
        self
    }

    /// The samples that every pixel has at least.
    pub fn spp(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.spp).min().unwrap_or(0)
    }

    pub fn samples(&self) -> u64 {
        self.tiles.iter().map(|tile| u64::from(tile.spp) * tile.pixels() as u64).sum()
    }

    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.invalid).sum()
    }

    /// Rows of tiles from top to bottom.
    pub fn tile_rows(&self) -> impl Iterator<Item = &[Tile]> {
        self.tiles.chunks(self.resolution[0].div_ceil(TILE) as usize)
    }
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
            doublings: Vec::new(),
            invalid: 0,
        }
    }

    pub fn pixels(&self) -> usize {
        (self.size[0] * self.size[1]) as usize
    }

    /// Black, without samples.
    fn clear(&mut self) {
        let pixels = self.pixels();
        for sums in [&mut self.sum, &mut self.sum_of_squares] {
            sums.clear();
            sums.resize(pixels, [0.0; 3]);
        }
        self.doublings.clear();
    }

    /// Adds one sample to every pixel; slot = row · [`TILE`] + column. Returns the first pixel whose sample is invalid.
    pub fn add(&mut self, radiance: &[[f32; 4]]) -> Option<[u32; 2]> {
        if self.spp == 0 {
            self.clear();
        }
        let mut first_invalid = None;
        let width = self.size[0] as usize;
        let rows = self.sum.chunks_exact_mut(width).zip(self.sum_of_squares.chunks_exact_mut(width));
        for (y, ((sums, squares), slots)) in rows.zip(radiance.chunks(TILE as usize)).enumerate() {
            for (x, ((sum, square), sample)) in sums.iter_mut().zip(squares).zip(slots).enumerate() {
                let [r, g, b, _] = *sample;
                // One comparison a channel refuses negative numbers, infinities and NaN alike.
                if ![r, g, b].iter().all(|c| (0.0..=f32::MAX).contains(c)) {
                    self.invalid += 1;
                    first_invalid = first_invalid.or(Some([self.origin[0] + x as u32, self.origin[1] + y as u32]));
                    continue;
                }
                for (channel, value) in [r, g, b].into_iter().enumerate() {
                    let value = f64::from(value);
                    sum[channel] += value;
                    square[channel] += value * value;
                }
            }
        }
        self.spp += 1;
        if self.spp.is_power_of_two() {
            self.double();
        }
        first_invalid
    }

    /// Notes how far the picture has moved since it had half as many samples.
    fn double(&mut self) {
        let estimates: Vec<Estimate> = (0..self.size[1] as usize).flat_map(|row| self.estimates(row)).collect();
        if self.spp > 1 {
            self.doublings.push(Doubling::new(&estimates, &self.before, self.size[0] as usize));
        }
        self.before.clear();
        self.before.extend(estimates.iter().map(|estimate| estimate.mean.map(|c| c as f32)));
    }

    /// The estimates of one row of the tile, which must have a sample; `row` counts from the tile's top.
    pub fn estimates(&self, row: usize) -> impl Iterator<Item = Estimate> {
        let width = self.size[0] as usize;
        let pixels = row * width..(row + 1) * width;
        let n = f64::from(self.spp.max(1));
        let (per_sample, per_degree) = (1.0 / n, 1.0 / (n - 1.0));
        self.sum[pixels.clone()].iter().zip(&self.sum_of_squares[pixels]).map(move |(sum, square)| {
            let mean = sum.map(|s| s / n);
            let variance = |c: usize| ((square[c] * per_sample - mean[c] * mean[c]) * per_degree).max(0.0);
            Estimate { mean, variance_of_mean: (n > 1.0).then(|| [variance(0), variance(1), variance(2)]) }
        })
    }
}
