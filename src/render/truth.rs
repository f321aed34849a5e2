//! The picture that a scene says it must converge to.
use super::image_file::read;
use crate::scene::{Scene, Truth};

/// The scene's exact picture at a resolution, if it names one of that resolution. An error is one line of text.
pub fn reference(scene: &Scene, [width, height]: [u32; 2]) -> Result<Option<Vec<[f32; 3]>>, String> {
    match &scene.truth {
        None => Ok(None),
        Some(Truth::Radiance(radiance)) => Ok(Some(vec![*radiance; width as usize * height as usize])),
        Some(Truth::Image(path)) => {
            let picture = read(path).map_err(|error| error.to_string())?;
            // At another resolution the reference says nothing about single pixels.
            Ok(([picture.width, picture.height] == [width, height]).then_some(picture.radiance))
        }
    }
}
