//! The image as a series: sums of samples by number of bounces, and the share of the light of each number.
use rayon::prelude::*;

use super::{film::Film, tile::Tile};
use noisefall_kernel::integrator::{SHARES, TERMS, TILE};

/// The contribution of each number of bounces to an image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Mean radiance of light reflected k times, row by row from the top left; the last of [`TERMS`] is the sum of all others.
    pub terms: Vec<Vec<[f32; 3]>>,
    /// Fraction of the image's luminance with k bounces; the last of [`SHARES`] is the sum of all others.
    pub shares: Vec<f64>,
}

impl Series {
    /// The series of a film, if it stores one.
    pub(super) fn of_film(film: &Film) -> Option<Series> {
        film.tiles.first()?.series.as_ref()?;
        let width = film.resolution[0] as usize;
        let rows: Vec<&[Tile]> = film.tile_rows().collect();
        let term = |k: usize| {
            let mut picture = vec![[0.0; 3]; width * film.resolution[1] as usize];
            picture.par_chunks_mut(width * TILE as usize).zip(&rows).for_each(|(band, tiles)| {
                tiles.iter().for_each(|tile| place(tile, k, width, band));
            });
            picture
        };
        let light =
            |k: usize| film.tiles.iter().filter_map(|tile| Some(tile.series.as_ref()?.light[k] / f64::from(tile.spp))).sum();
        let lights: Vec<f64> = (0..SHARES).map(light).collect();
        let all: f64 = lights.iter().sum();
        let shares = lights.into_iter().map(|light| if all > 0.0 { light / all } else { 0.0 }).collect();
        Some(Series { terms: (0..TERMS).map(term).collect(), shares })
    }

    /// The fraction of the light that a cap of `n` bounces would lose.
    pub fn lost_by_cap(&self, n: usize) -> f64 {
        self.shares.iter().skip(n + 1).sum()
    }

    /// Mean radiance of light that bounced at most `k` times.
    pub fn up_to(&self, k: usize) -> Vec<[f32; 3]> {
        let mut sum = self.terms.first().cloned().unwrap_or_default();
        for term in self.terms.iter().take(k + 1).skip(1) {
            sum.iter_mut().zip(term).for_each(|(sum, term)| *sum = std::array::from_fn(|c| sum[c] + term[c]));
        }
        sum
    }
}

/// Writes the means of one term of a tile to its band of the image.
fn place(tile: &Tile, k: usize, width: usize, band: &mut [[f32; 3]]) {
    let Some(series) = &tile.series else { return };
    let scale = 1.0 / tile.spp as f32;
    let rows = series.sums[k].chunks(tile.size[0] as usize);
    for (row, sums) in rows.enumerate() {
        let start = row * width + tile.origin[0] as usize;
        band[start..start + sums.len()].iter_mut().zip(sums).for_each(|(mean, sum)| *mean = sum.map(|c| c * scale));
    }
}
