//! An equirectangular image of the sky, with a sun that keeps its irradiance.
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rayon::prelude::*;

use crate::image::Texels;

/// Size of the image in texels.
pub const WIDTH: u32 = 2048;
pub const HEIGHT: u32 = 1024;

/// Width and height of a texel, radians.
const STEP: f64 = PI / HEIGHT as f64;

/// An image of all directions, linear Rec. 709, in double precision.
pub struct Raster {
    texels: Vec<[f64; 3]>,
}

impl Raster {
    /// The image of the sky above the horizon.
    pub fn of(radiance: impl Fn(DVec3) -> [f64; 3] + Sync) -> Raster {
        let mut texels = vec![[0.0; 3]; (WIDTH * HEIGHT) as usize];
        let above = texels.par_chunks_exact_mut(WIDTH as usize).take(HEIGHT as usize / 2).enumerate();
        above.for_each(|(row, texels)| {
            for (column, texel) in texels.iter_mut().enumerate() {
                *texel = radiance(direction(column as f64 + 0.5, row as f64 + 0.5));
            }
        });
        Raster { texels }
    }

    /// Adds the part above the horizon of a sun of a solid angle.
    ///
    /// A texel gets the radiance times the fraction that the disk covers. All are then scaled so that the interpolated image has
    /// exactly the irradiance of the disk.
    pub fn add_sun(&mut self, sun: DVec3, radiance: [f64; 3], solid_angle_of_sun: f64) {
        let disk = Disk::new(sun, solid_angle_of_sun);
        let visible = solid_angle_of_sun * disk.above;
        let drawn: f64 = disk.covered.iter().map(|(texel, fraction)| fraction * solid_angle(texel / WIDTH as usize)).sum();
        if drawn == 0.0 {
            return;
        }
        for (texel, fraction) in disk.covered {
            let scale = fraction * visible / drawn;
            self.texels[texel] = [0, 1, 2].map(|c| self.texels[texel][c] + radiance[c] * scale);
        }
    }

    /// The image for the renderer.
    pub fn into_texels(self) -> Texels {
        let radiance = self.texels.into_iter().map(|[r, g, b]| [r as f32, g as f32, b as f32, 0.0]).collect();
        Texels { width: WIDTH, height: HEIGHT, radiance }
    }
}

/// The sun's disk as texels.
struct Disk {
    /// Texels above the horizon, and the fraction of each that the disk covers.
    covered: Vec<(usize, f64)>,
    /// The fraction of the disk above the horizon.
    above: f64,
}

impl Disk {
    fn new(sun: DVec3, solid_angle_of_sun: f64) -> Disk {
        /// Points of a texel in each direction.
        const POINTS: usize = 16;
        let cos_radius = 1.0 - solid_angle_of_sun / TAU;
        // The diagonal of a texel is less than 1.5 steps.
        let cos_reach = (cos_radius.acos() + 1.5 * STEP).cos();
        let rows = {
            let (middle, reach) = (sun.y.clamp(-1.0, 1.0).acos() / STEP, cos_reach.acos() / STEP);
            (middle - reach).floor().max(0.0) as usize..((middle + reach).ceil() as usize).min(HEIGHT as usize)
        };
        let mut disk = Disk { covered: Vec::new(), above: 0.0 };
        let (mut whole, mut above) = (0.0, 0.0);
        for (row, column) in rows.flat_map(|row| (0..WIDTH as usize).map(move |column| (row, column))) {
            if direction(column as f64 + 0.5, row as f64 + 0.5).dot(sun) < cos_reach {
                continue;
            }
            let place = |cell: usize, point: usize| cell as f64 + (point as f64 + 0.5) / POINTS as f64;
            let points = (0..POINTS * POINTS).map(|i| direction(place(column, i % POINTS), place(row, i / POINTS)));
            let covered = points.filter(|point| point.dot(sun) >= cos_radius).count() as f64 / (POINTS * POINTS) as f64;
            whole += covered * solid_angle(row);
            if covered > 0.0 && row < HEIGHT as usize / 2 {
                above += covered * solid_angle(row);
                disk.covered.push((row * WIDTH as usize + column, covered));
            }
        }
        disk.above = if whole > 0.0 { above / whole } else { 0.0 };
        disk
    }
}

/// The direction of a place in the image, in texels from its upper left corner.
fn direction(column: f64, row: f64) -> DVec3 {
    let (sin, cos) = (row * STEP).sin_cos();
    // The middle of the image is −z, and +x is to its right.
    let (sin_azimuth, cos_azimuth) = (column * STEP - PI).sin_cos();
    DVec3::new(sin * sin_azimuth, cos, -sin * cos_azimuth)
}

/// The integral of a texel's weight in linear interpolation over all directions, sr: of 1 in the middle of the texel that falls to 0 in
/// the middle of the next ones, and stays 1 up to the pole in the first and the last row.
fn solid_angle(row: usize) -> f64 {
    let theta = (row as f64 + 0.5) * STEP;
    let is_last = row == 0 || row == HEIGHT as usize - 1;
    if is_last {
        return STEP * (1.0 - ((1.5 * STEP).sin() - (0.5 * STEP).sin()) / STEP);
    }
    theta.sin() * 2.0 * (1.0 - STEP.cos())
}
