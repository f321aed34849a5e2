//! Images of projectors.
use super::super::context::Import;
use crate::{
    image::{self, Picture},
    import::pictures,
    texture::image::Image,
};

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
