//! Images of all directions on a square, whose equal areas are equal solid angles.
//!
//! P. Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", Journal of Graphics Tools 13(3), 2008. The middle is +z,
//! the corners are −z.
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::DVec3;
use rayon::prelude::*;

use noisefall_scene::image::Texels;

/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;

/// The point of the unit square, downwards from its top left, for a unit direction.
fn point(d: DVec3) -> [f64; 2] {
    let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
    let r = (1.0 - z).max(0.0).sqrt();
    let (long, short) = (x.max(y), x.min(y));
    let angle = if long == 0.0 { 0.0 } else { (short / long).atan() / FRAC_PI_2 };
    let angle = if x < y { 1.0 - angle } else { angle };
    let (mut u, mut v) = (r - angle * r, angle * r);
    if d.z < 0.0 {
        (u, v) = (1.0 - v, 1.0 - u);
    }
    [0.5 * (u.copysign(d.x) + 1.0), 0.5 * (v.copysign(d.y) + 1.0)]
}

/// The unit direction for a point of the unit square.
pub fn direction(at: [f64; 2]) -> DVec3 {
    let [u, v] = at.map(|x| 2.0 * x - 1.0);
    let (up, vp) = (u.abs(), v.abs());
    let signed = 1.0 - (up + vp);
    let r = 1.0 - signed.abs();
    let angle = if r == 0.0 { FRAC_PI_4 } else { ((vp - up) / r + 1.0) * FRAC_PI_4 };
    let z = (1.0 - r * r).copysign(signed);
    let across = r * (2.0 - r * r).max(0.0).sqrt();
    DVec3::new(angle.cos().copysign(u) * across, angle.sin().copysign(v) * across, z)
}

/// The image as an equirectangular one of our orientation, in the same coordinates: its top is +y, its middle −z, with +x to the
/// right. Returns its width, twice its height, and its pixels.
pub fn equirectangular(square: &Texels, width: u32) -> (u32, Vec<[f32; 3]>) {
    let height = width / 2;
    let width = 2 * height;
    let size = square.width;
    let texel = |d: DVec3| {
        let [column, row] = point(d).map(|x| ((x * f64::from(size)) as usize).min(size as usize - 1));
        square.radiance[row * size as usize + column]
    };
    let pixel = |index: usize| {
        let (column, row) = (index % width as usize, index / width as usize);
        let mut sum = [0f64; 3];
        for sample in 0..SAMPLES * SAMPLES {
            let [x, y] = [sample % SAMPLES, sample / SAMPLES].map(|i| (f64::from(i) + 0.5) / f64::from(SAMPLES));
            let (sin_azimuth, cos_azimuth) = (((column as f64 + x) / f64::from(width) - 0.5) * TAU).sin_cos();
            let (sin, cos) = ((row as f64 + y) / f64::from(height) * PI).sin_cos();
            let found = texel(DVec3::new(sin * sin_azimuth, cos, -sin * cos_azimuth));
            for (sum, x) in sum.iter_mut().zip(found) {
                *sum += f64::from(x);
            }
        }
        sum.map(|x| (x / f64::from(SAMPLES * SAMPLES)) as f32)
    };
    (width, (0..(width * height) as usize).into_par_iter().map(pixel).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_directions_are_inverse() {
        for row in 0..33 {
            for column in 0..33 {
                let at = [f64::from(column), f64::from(row)].map(|x| (x + 0.37) / 33.5);
                let d = direction(at);
                let back = point(d);
                assert!((d.length() - 1.0).abs() < 1e-9 && (0..2).all(|i| (back[i] - at[i]).abs() < 1e-6), "{at:?} {d} {back:?}");
            }
        }
        assert!(direction([0.5; 2]).z > 0.999 && direction([0.0; 2]).z < -0.999 && direction([1.0, 0.5]).x > 0.999);
    }

    #[test]
    fn bright_places_stay_where_they_are() {
        let size = 64;
        let mut square = Texels { width: size, height: size, radiance: vec![[0.0; 4]; (size * size) as usize] };
        let towards = DVec3::new(1.0, 2.0, -0.5).normalize();
        let [column, row] = point(towards).map(|x| (x * f64::from(size)) as usize);
        square.radiance[row * size as usize + column] = [3.0; 4];
        let (width, sky) = equirectangular(&square, 2 * size);
        let brightest = (0..sky.len()).max_by(|a, b| sky[*a][0].total_cmp(&sky[*b][0])).expect("it has pixels");
        let azimuth = (((brightest % width as usize) as f64 + 0.5) / f64::from(width) - 0.5) * TAU;
        let polar = ((brightest / width as usize) as f64 + 0.5) / f64::from(width / 2) * PI;
        let found = DVec3::new(polar.sin() * azimuth.sin(), polar.cos(), -polar.sin() * azimuth.cos());
        assert!(found.dot(towards) > 0.99, "{found}");
        let mean: f64 = sky.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / sky.len() as f64;
        assert!(mean > 0.0);
    }
}
