//! Images of all directions under a transform that is not a rotation, as images without one.
use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use noisefall_scene::image::Picture;

/// Fewest and most columns of the new image.
const COLUMNS: [u32; 2] = [512, 8192];

/// The image in Mitsuba's orientation: for each direction the colour that Mitsuba finds there, which does not normalize what the inverse
/// transform makes of the direction. Rows reach from pole to pole.
pub fn resampled(picture: &Picture, map: &DMat3) -> Picture {
    let width = picture.width.clamp(COLUMNS[0], COLUMNS[1]);
    let height = width / 2;
    let inverse = map.inverse();
    let pixel = |index: u32| {
        let (column, row) = (index % width, index / width);
        let (sin_azimuth, cos_azimuth) = ((f64::from(column) + 0.5) / f64::from(width) * TAU).sin_cos();
        let (sin, cos) = (f64::from(row) / f64::from(height - 1) * PI).sin_cos();
        let found = inverse * DVec3::new(sin * sin_azimuth, cos, -sin * cos_azimuth);
        let u = found.x.atan2(-found.z) / TAU;
        colour(picture, u - u.floor(), found.y.clamp(-1.0, 1.0).acos() / PI)
    };
    Picture { width, height, radiance: (0..width * height).into_par_iter().map(pixel).collect() }
}

/// Between four pixels; rows are at the poles and between them.
fn colour(picture: &Picture, u: f64, v: f64) -> [f32; 3] {
    let [width, height] = [picture.width, picture.height].map(|size| size as usize);
    let (x, y) = (u * width as f64 - 0.5, v * (height - 1) as f64);
    let (left, upper) = (x.floor(), y.floor());
    let columns = [0, 1].map(|step| (left as i64 + step).rem_euclid(width as i64) as usize);
    let rows = [0, 1].map(|step| (upper as usize + step).min(height - 1));
    let (across, down) = ((x - left) as f32, (y - upper) as f32);
    let at = |row: usize, column: usize| picture.radiance[rows[row] * width + columns[column]];
    [0, 1, 2].map(|channel| {
        let mixed = |row: usize| at(row, 0)[channel] * (1.0 - across) + at(row, 1)[channel] * across;
        mixed(0) * (1.0 - down) + mixed(1) * down
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_moves_columns_and_a_stretched_zenith_vanishes() {
        // Bright in the upper half, and red in a quarter.
        let pixel = |i: u32| {
            let (column, row) = (i % 64, i / 64);
            [f32::from(u8::from(column < 16)), if row < 16 { 1.0 } else { 0.25 }, 0.0]
        };
        let picture = Picture { width: 64, height: 32, radiance: (0..64 * 32).map(pixel).collect() };
        let at = |picture: &Picture, u: f64, v: f64| colour(picture, u, v);
        let same = resampled(&picture, &DMat3::IDENTITY);
        let turned = resampled(&picture, &DMat3::from_rotation_y(-0.5 * PI));
        for (u, v) in [(0.125, 0.25), (0.4, 0.75), (0.8, 0.1)] {
            assert_eq!(at(&same, u, v).map(|x| (x * 100.0).round()), at(&picture, u, v).map(|x| (x * 100.0).round()));
            let before = (u - 0.25_f64).rem_euclid(1.0);
            assert_eq!(at(&turned, u, v).map(|x| (x * 100.0).round()), at(&picture, before, v).map(|x| (x * 100.0).round()));
        }
        // Towards the zenith, half of a unit upwards is 30° above the horizon.
        let stretched = resampled(&picture, &DMat3::from_diagonal(DVec3::new(1.0, 2.0, 1.0)));
        let row = |v: f64| (0..8).map(|i| at(&stretched, (f64::from(i) + 0.5) / 8.0, v)[1]).sum::<f32>();
        assert!((row(0.01) - 8.0).abs() < 1e-3 && (row(0.99) - 2.0).abs() < 1e-3);
    }
}
