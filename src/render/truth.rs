//! The picture that a scene says it must converge to.
use super::{
    frame::Frame,
    image_file::{Picture, read},
};
use crate::{
    measure::{Comparison, compare},
    scene::{Scene, Truth},
};

/// What a scene's picture is held against. It holds for the camera that the scene opens with.
pub enum Reference {
    /// The same radiance at every pixel, at any resolution.
    Constant([f32; 3]),
    /// A picture of one resolution.
    Picture(Picture),
}

impl Reference {
    /// The scene's reference, if it names one. An error is one line of text.
    pub fn of(scene: &Scene) -> Result<Option<Reference>, String> {
        match &scene.truth {
            None => Ok(None),
            Some(Truth::Radiance(radiance)) => Ok(Some(Reference::Constant(*radiance))),
            Some(Truth::Image(path)) => {
                read(path).map(|picture| Some(Reference::Picture(picture))).map_err(|error| error.to_string())
            }
        }
    }

    /// The error of a frame, if it has the reference's resolution.
    pub fn compare(&self, frame: &Frame) -> Option<Comparison> {
        match self {
            Reference::Constant(radiance) => Some(compare(&frame.radiance, &vec![*radiance; frame.radiance.len()])),
            Reference::Picture(picture) if [picture.width, picture.height] == [frame.width, frame.height] => {
                Some(compare(&frame.radiance, &picture.radiance))
            }
            Reference::Picture(_) => None,
        }
    }
}
