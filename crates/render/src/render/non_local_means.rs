//! Non-local means: each pixel becomes a weighted mean of those around it, and weights compare patches (A. Buades, B. Coll and J.-M.
//! Morel 2005). Distances are relative to the variance of the pixels, as in Rousselle, Knaus and Zwicker 2012, equations 5 to 7.
use rayon::prelude::*;

/// Pixels on each side of the search window.
const SEARCH_RADIUS: isize = 7;
/// Pixels on each side of a patch.
const PATCH_RADIUS: usize = 3;
/// The squared strength k² of the filter, with k = 0.45 as in Rousselle et al. 2012; a smaller k keeps more noise.
const STRENGTH: f32 = 0.45 * 0.45;
/// Rows of a band, which one thread filters.
const BAND: usize = 16;
/// Distances beyond this have no weight.
const FARTHEST: f32 = 20.0;

/// An image and the variance of its pixels, row by row.
#[derive(Clone, Copy)]
pub struct Buffer<'a> {
    pub mean: &'a [[f32; 3]],
    pub variance: &'a [[f32; 3]],
}

/// Filters an image by weights from another image of the same scene, whose noise is independent. `floor` is a squared radiance that is
/// invisible. `None` if it was cancelled.
pub fn filter(
    image: Buffer,
    guide: Buffer,
    [width, height]: [usize; 2],
    floor: f32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<[f32; 3]>> {
    let mut result = vec![[0.0; 3]; image.mean.len()];
    let bands = result.par_chunks_mut(width.max(1) * BAND).enumerate();
    let is_complete = bands.map(|(band, pixels)| {
        let filter = Band { guide, width, height, first: band * BAND, rows: pixels.len() / width, floor };
        filter.run(image.mean, pixels, cancelled).is_some()
    });
    is_complete.reduce(|| true, |a, b| a && b).then_some(result)
}

/// How often [`filter`] asks whether it was cancelled.
pub fn steps([_, height]: [usize; 2]) -> usize {
    height.div_ceil(BAND) * (2 * SEARCH_RADIUS as usize + 1)
}

/// Some rows of the image.
struct Band<'a> {
    guide: Buffer<'a>,
    width: usize,
    height: usize,
    first: usize,
    rows: usize,
    floor: f32,
}

impl Band<'_> {
    fn run(&self, image: &[[f32; 3]], result: &mut [[f32; 3]], cancelled: &(dyn Fn() -> bool + Sync)) -> Option<()> {
        let mut sums = vec![[0.0f32; 4]; self.rows * self.width];
        let mut distances = Distances::default();
        for dy in -SEARCH_RADIUS..=SEARCH_RADIUS {
            if cancelled() {
                return None;
            }
            for dx in -SEARCH_RADIUS..=SEARCH_RADIUS {
                distances.measure(self, [dx, dy]);
                self.add([dx, dy], &distances, image, &mut sums);
            }
        }
        result.iter_mut().zip(&sums).for_each(|(pixel, [r, g, b, weight])| *pixel = [r / weight, g / weight, b / weight]);
        Some(())
    }

    /// Adds the pixels at an offset with their weights.
    fn add(&self, [dx, dy]: [isize; 2], distances: &Distances, image: &[[f32; 3]], sums: &mut [[f32; 4]]) {
        let columns = inside(dx, self.width);
        for row in 0..self.rows {
            let Some(there) = (self.first + row).checked_add_signed(dy).filter(|y| *y < self.height) else { continue };
            for x in columns.clone() {
                let distance = distances.of_patch(self, x, row);
                if distance < FARTHEST {
                    let weight = (-distance.max(0.0)).exp();
                    let [r, g, b] = image[there * self.width + x.wrapping_add_signed(dx)];
                    let sum = &mut sums[row * self.width + x];
                    *sum = [sum[0] + weight * r, sum[1] + weight * g, sum[2] + weight * b, sum[3] + weight];
                }
            }
        }
    }

    /// Rows of the image that patches around the band cover.
    fn covered(&self) -> std::ops::Range<usize> {
        self.first.saturating_sub(PATCH_RADIUS)..(self.first + self.rows + PATCH_RADIUS).min(self.height)
    }

    /// The distance of two pixels, averaged over the channels: the squared difference without the part that noise explains, relative to
    /// the noise.
    fn distance(&self, p: usize, q: usize) -> f32 {
        let (mean, variance) = (self.guide.mean, self.guide.variance);
        let of_channel = |c: usize| {
            let (of_p, of_q) = (variance[p][c], variance[q][c]);
            let difference = mean[p][c] - mean[q][c];
            (difference * difference - (of_p + of_p.min(of_q))) / (self.floor + STRENGTH * (of_p + of_q))
        };
        (of_channel(0) + of_channel(1) + of_channel(2)) / 3.0
    }
}

/// Distances between the pixels of a band and those at one offset, summed along rows.
#[derive(Default)]
struct Distances {
    pixels: Vec<f32>,
    sums: Vec<f32>,
}

impl Distances {
    fn measure(&mut self, band: &Band, [dx, dy]: [isize; 2]) {
        self.sums.clear();
        let width = band.width;
        for y in band.covered() {
            // Patches that reach beyond the edge of the image repeat its outermost pixels.
            let there = y.saturating_add_signed(dy).min(band.height - 1) * width;
            let distance = |x: usize| band.distance(y * width + x, there + x.saturating_add_signed(dx).min(width - 1));
            self.pixels.clear();
            self.pixels.extend((0..width).map(distance));
            let sum = |x: usize| self.pixels[around(x, width)].iter().sum::<f32>();
            self.sums.extend((0..width).map(sum));
        }
    }

    /// The mean distance of the patches around a pixel of the band.
    fn of_patch(&self, band: &Band, x: usize, row: usize) -> f32 {
        let first = band.covered().start;
        let rows = around(band.first + row, band.height);
        let count = rows.len() * around(x, band.width).len();
        rows.map(|y| self.sums[(y - first) * band.width + x]).sum::<f32>() / count as f32
    }
}

/// The places of a patch around a place, within an image of this side.
fn around(at: usize, side: usize) -> std::ops::Range<usize> {
    at.saturating_sub(PATCH_RADIUS)..(at + PATCH_RADIUS + 1).min(side)
}

/// The places whose neighbours at an offset lie inside.
fn inside(offset: isize, side: usize) -> std::ops::Range<usize> {
    let away = offset.unsigned_abs().min(side);
    if offset < 0 { away..side } else { 0..side - away }
}
