//! Images that the translation must look at.
use std::{fs, path::Path};

use super::context::Import;
use crate::{
    image::{self, Encoding, Picture},
    import::pictures,
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

/// The image within 0 and 1, encoded, if it has other values. Only some formats can.
pub fn within_unit(import: &Import, image: &Image) -> Option<Vec<u8>> {
    const FORMATS: [&str; 3] = ["exr", "hdr", "pfm"];
    let extension = Path::new(&image.path).extension()?.to_str()?.to_ascii_lowercase();
    let picture = FORMATS.contains(&&*extension).then(|| read(import, image)).flatten()?;
    let is_within = |x: &f32| (0.0..=1.0).contains(x);
    if picture.radiance.as_flattened().iter().all(is_within) {
        return None;
    }
    let pixels: Vec<[f32; 3]> = picture.radiance.iter().map(|pixel| pixel.map(|x| x.clamp(0.0, 1.0))).collect();
    pictures::exr(picture.width, picture.height, &pixels)
}

/// Whether an image is black everywhere.
pub fn is_black(import: &Import, image: &Image) -> bool {
    import.images.get(&image.path).is_some_and(|path| is_black_file(path))
}

/// The same for a file. One that is black compresses well: large files are not read for that.
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
