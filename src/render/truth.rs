//! The picture that a render must converge to: as the scene says, or one by another program.
use std::{borrow::Cow, path::Path, sync::Arc};

use super::{
    frame::Frame,
    image_file::{ImageError, Picture, read},
};
use crate::{
    math::colour::luminance,
    measure::{Comparison, Deviations, compare},
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

    /// A picture in a file.
    pub fn read(path: &Path) -> Result<Reference, ImageError> {
        Ok(Reference::Picture(Arc::new(read(path)?)))
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

    /// What every pixel of a frame should be, if the frame has the reference's resolution.
    pub fn radiance_of(&self, frame: &Frame) -> Option<Cow<'_, [[f32; 3]]>> {
        match self {
            Reference::Constant(radiance) => Some(vec![*radiance; frame.radiance.len()].into()),
            Reference::Picture(picture) => {
                let same = [picture.width, picture.height] == [frame.width, frame.height];
                same.then(|| picture.radiance.as_slice().into())
            }
        }
    }

    /// The error of a frame, if it has the reference's resolution.
    pub fn compare(&self, frame: &Frame) -> Option<Comparison> {
        Some(compare(&frame.radiance, &self.radiance_of(frame)?))
    }

    /// How far the mean of a frame is from the true one, in standard errors that the scatter over the picture gives; `None` if that
    /// cannot be told.
    pub fn bias(&self, frame: &Frame) -> Option<f64> {
        let truth = self.radiance_of(frame)?;
        let pairs = frame.radiance.iter().zip(truth.iter());
        let differences: Vec<f64> = pairs.map(|(x, r)| f64::from(luminance(*x)) - f64::from(luminance(*r))).collect();
        Deviations::of(&differences, frame.width as usize).map(|deviations| deviations.of_mean)
    }
}
