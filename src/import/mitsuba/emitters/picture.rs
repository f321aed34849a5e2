//! Images of projectors.
use super::super::{context::Import, pictures};
use crate::{
    image::{self, Picture},
    texture::image::Image,
};

/// The cone of a spot.
pub struct Cone {
    /// Radiant intensity on the axis.
    pub intensity: [f64; 3],
    /// Where the light ends, degrees.
    pub angle: f64,
    /// Where it begins to fall, degrees.
    pub inner: f64,
}

/// Pixels of a side of the image of a spot.
const LEAST_SIDE: u32 = 512;
const MOST_SIDE: u32 = 2048;

fn read(import: &Import, image: &Image) -> Option<Picture> {
    image::read(import.images.get(&image.path)?, image.encoding).ok()
}

/// Width over height.
pub fn aspect(import: &Import, image: &Image) -> Option<f64> {
    read(import, image).map(|picture| f64::from(picture.width) / f64::from(picture.height))
}

/// An image of one colour.
pub fn plain(colour: [f64; 3]) -> Option<Vec<u8>> {
    pictures::exr(2, 2, &[colour.map(|x| x as f32); 4])
}

/// The image of a projector of scale 1 that shines like a spot: its intensity times the picture, times the falloff, times cos³ θ, since
/// the intensity of a projector rises by 1/cos³ θ.
pub fn of_spot(import: &Import, image: &Image, cone: &Cone) -> Option<Vec<u8>> {
    let picture = read(import, image)?;
    let side = (4 * picture.width.max(picture.height)).clamp(LEAST_SIDE, MOST_SIDE);
    let reach = cone.angle.to_radians().tan();
    let pixel = |i: u32| {
        let [u, v] = [i % side, i / side].map(|x| (f64::from(x) + 0.5) / f64::from(side));
        let tan = reach * (2.0 * u - 1.0).hypot(2.0 * v - 1.0);
        let theta = tan.atan();
        let degrees = theta.to_degrees();
        let falloff = ((cone.angle - degrees) / (cone.angle - cone.inner).max(1e-9)).clamp(0.0, 1.0);
        let factor = falloff * theta.cos().powi(3);
        // Columns and rows of the picture run against x and y of the spot's frame as those of a projector do.
        let texel = lookup(&picture, 1.0 - u, 1.0 - v);
        [0, 1, 2].map(|channel| (cone.intensity[channel] * factor * f64::from(texel[channel]).max(0.0)) as f32)
    };
    let pixels: Vec<[f32; 3]> = (0..side * side).map(pixel).collect();
    pictures::exr(side, side, &pixels)
}

/// The bilinear colour at u and v in [0, 1].
fn lookup(picture: &Picture, u: f64, v: f64) -> [f32; 3] {
    let axis = |t: f64, size: u32| {
        let x = (t * f64::from(size) - 0.5).clamp(0.0, f64::from(size - 1));
        let low = x.floor();
        (low as usize, (low as usize + 1).min(size as usize - 1), (x - low) as f32)
    };
    let (left, right, s) = axis(u, picture.width);
    let (upper, lower, t) = axis(v, picture.height);
    let texel = |x: usize, y: usize| picture.radiance[y * picture.width as usize + x];
    let mix = |a: [f32; 3], b: [f32; 3], t: f32| [0, 1, 2].map(|c| a[c] + (b[c] - a[c]) * t);
    mix(mix(texel(left, upper), texel(right, upper), s), mix(texel(left, lower), texel(right, lower), s), t)
}
