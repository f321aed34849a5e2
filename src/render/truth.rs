//! The picture that a render must converge to: as the scene says, or one by another program.
use std::{borrow::Cow, path::Path, sync::Arc};

use super::{
    frame::Frame,
    image_file::{ImageError, Picture, Provenance, provenance, read},
};
use crate::{
    measure::{Bias, Comparison, Floor, compare},
    scene::{Scene, Truth},
};

/// What a scene's picture is held against. It holds for the camera that the scene opens with.
pub enum Reference {
    /// The same radiance at every pixel, at any resolution.
    Constant([f32; 3]),
    /// A picture of one resolution, and what its file says of its own noise: nothing, if it is exact.
    Picture(Arc<Picture>, Arc<Provenance>),
}

impl Reference {
    /// The scene's reference, if it names one.
    pub fn of(scene: &Scene) -> Option<Reference> {
        match scene.truth.as_ref()? {
            Truth::Radiance(radiance) => Some(Reference::Constant(*radiance)),
            Truth::Image(_, picture) => Some(Reference::Picture(picture.clone(), Arc::default())),
        }
    }

    /// A picture in a file.
    pub fn read(path: &Path) -> Result<Reference, ImageError> {
        Ok(Reference::Picture(Arc::new(read(path)?), Arc::new(provenance(path))))
    }

    /// Why pictures of this resolution cannot be held against the reference, if they cannot.
    pub fn mismatch(&self, [width, height]: [u32; 2]) -> Option<String> {
        match self {
            Reference::Picture(p, _) if [p.width, p.height] != [width, height] => {
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
            Reference::Picture(picture, _) => {
                let same = [picture.width, picture.height] == [frame.width, frame.height];
                same.then(|| picture.radiance.as_slice().into())
            }
        }
    }

    /// The error of a frame, if it has the reference's resolution.
    pub fn compare(&self, frame: &Frame) -> Option<Comparison> {
        Some(compare(&frame.radiance, &self.radiance_of(frame)?, Floor::DEFAULT))
    }

    /// How far the mean of a frame is from the true one, in standard errors that the variances of samples give; `None` where these are
    /// not known, and where samples are exact.
    pub fn bias(&self, frame: &Frame) -> Option<f64> {
        let truth = self.radiance_of(frame)?;
        let of_truth = if let Reference::Picture(_, provenance) = self { provenance.noise.as_ref() } else { None };
        Bias::by_samples(&frame.radiance, &truth, [frame.noise.as_ref(), of_truth], frame.width as usize).z
    }
}
