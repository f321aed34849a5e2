//! The series by bounces of one tile.
use noisefall_kernel::integrator::{SHARES, TERMS, TILE, Terms};

/// Sums of one tile, stored only while the series is shown. They are in single precision to save memory: after a million samples,
/// the error of their means is about 10⁻⁴.
pub(super) struct TileSeries {
    /// Sums for each term, row by row.
    pub sums: [Vec<[f32; 3]>; TERMS],
    pub light: [f64; SHARES],
}

impl TileSeries {
    pub fn new(pixels: usize) -> TileSeries {
        TileSeries { sums: std::array::from_fn(|_| vec![[0.0; 3]; pixels]), light: [0.0; SHARES] }
    }

    /// Adds a sample of every pixel; `radiance` is the total by slot = row · [`TILE`] + column.
    pub fn add(&mut self, [width, height]: [u32; 2], terms: &Terms, radiance: &[[f32; 4]]) {
        for (k, sums) in self.sums.iter_mut().enumerate() {
            for (row, sums) in (0..height).zip(sums.chunks_mut(width as usize)) {
                for (column, sum) in sums.iter_mut().enumerate() {
                    let slot = (row * TILE) as usize + column;
                    let term = terms.term(k, slot, radiance[slot]);
                    // Samples that the film drops are dropped here too; the film counts them.
                    if radiance[slot][..3].iter().all(|c| (0.0..=f32::MAX).contains(c)) {
                        (0..3).for_each(|c| sum[c] += term[c]);
                    }
                }
            }
        }
        self.light.iter_mut().zip(terms.light()).for_each(|(sum, light)| *sum += light);
    }
}
