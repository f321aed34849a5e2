//! The picture that a scene says it must converge to.
use std::sync::Arc;

use super::{frame::Frame, image_file::Picture};
use crate::{
    measure::{Comparison, compare},
    scene::{Scene, Truth},
};

/// What a scene's picture is held against. It holds for the camera that the scene opens with.
pub enum Reference {
    /// The same radiance at every pixel, at any resolution.
    Constant([f32; 3]),
    /// A picture of one resolution.
    Picture(Arc<Picture>),
}

impl Reference {
    /// The scene's reference, if it names one.
    pub fn of(scene: &Scene) -> Option<Reference> {
        match scene.truth.as_ref()? {
            Truth::Radiance(radiance) => Some(Reference::Constant(*radiance)),
            Truth::Image(_, picture) => Some(Reference::Picture(picture.clone())),
        }
    }

    /// Why pictures of this resolution cannot be held against the reference, if they cannot.
    pub fn mismatch(&self, [width, height]: [u32; 2]) -> Option<String> {
        match self {
            Reference::Picture(p) if [p.width, p.height] != [width, height] => {
                let size = format!("{} × {}", p.width, p.height);
                Some(format!("the true picture is {size} and this one {width} × {height}, so the true error is not known"))
            }
            _ => None,
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
