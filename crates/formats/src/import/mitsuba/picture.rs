//! Images that the translation must look at.
use std::{fs, path::Path};

use super::context::Import;
use crate::import::pictures;
use noisefall_scene::{
    image::{self, Encoding, Picture},
    texture::image::Image,
};

/// The image of a texture, if it can be read.
pub fn read(import: &Import, image: &Image) -> Option<Picture> {
    image::read(import.images.get(&image.path)?, image.encoding).ok()
}

/// Width over height.
pub fn aspect(import: &Import, image: &Image) -> Option<f64> {
    read(import, image).map(|picture| f64::from(picture.width) / f64::from(picture.height))
}

/// The image within 0 and 1, encoded, if it has other values.
pub fn within_unit(import: &Import, image: &Image) -> Option<Vec<u8>> {
    let (picture, _) = beyond_unit(import, image)?;
    mapped(&picture, |x| x.clamp(0.0, 1.0))
}

/// The image with its least value as 0 and its greatest as 1, encoded, and these two, if some are beyond 0 and 1.
pub fn spread(import: &Import, image: &Image) -> Option<(Vec<u8>, [f32; 2])> {
    let (picture, [least, most]) = beyond_unit(import, image)?;
    let encoded = mapped(&picture, |x| (x - least) / (most - least))?;
    Some((encoded, [least, most]))
}

/// An image with values beyond 0 and 1, and its least and greatest values, these two included. Only some formats can have them.
fn beyond_unit(import: &Import, image: &Image) -> Option<(Picture, [f32; 2])> {
    const FORMATS: [&str; 3] = ["exr", "hdr", "pfm"];
    let extension = Path::new(&image.path).extension()?.to_str()?.to_ascii_lowercase();
    let picture = FORMATS.contains(&&*extension).then(|| read(import, image)).flatten()?;
    let values = picture.radiance.as_flattened().iter();
    let ends = values.fold([0.0f32, 1.0], |[least, most], x| [least.min(*x), most.max(*x)]);
    let is_spread = ends != [0.0, 1.0] && ends.iter().all(|x| x.is_finite());
    is_spread.then_some((picture, ends))
}

fn mapped(picture: &Picture, map: impl Fn(f32) -> f32) -> Option<Vec<u8>> {
    let pixels: Vec<[f32; 3]> = picture.radiance.iter().map(|pixel| pixel.map(&map)).collect();
    pictures::exr(picture.width, picture.height, &pixels)
}

/// Whether an image is black everywhere.
pub fn is_black(import: &Import, image: &Image) -> bool {
    import.images.get(&image.path).is_some_and(|path| is_black_file(path))
}

/// Whether an image file is black. Black images compress well, so large files are not read.
pub fn is_black_file(path: &Path) -> bool {
    const LARGEST: u64 = 4 << 20;
    let is_small = fs::metadata(path).is_ok_and(|known| known.len() <= LARGEST);
    let read = || image::read(path, Encoding::Linear).ok();
    is_small && read().is_some_and(|picture| picture.radiance.iter().all(|pixel| *pixel == [0.0; 3]))
}

/// An image of one colour.
pub fn plain(colour: [f64; 3]) -> Option<Vec<u8>> {
    pictures::exr(2, 2, &[colour.map(|x| x as f32); 4])
}
