//! The cameras of numbered frames.
use std::path::PathBuf;

use super::{Camera, CameraPath};

/// The source of the cameras of numbered frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CameraSequence {
    /// A full turn around the look-at point, with this number of frames.
    Turntable(u32),
    /// A file with a [`CameraPath`].
    Path(PathBuf),
}

impl CameraSequence {
    /// The cameras of all frames. A turntable begins at `camera`; a path takes from it what the file leaves open. Fails if the file
    /// cannot be read or has an impossible camera.
    pub fn cameras(&self, camera: &Camera) -> Result<Vec<Camera>, String> {
        match self {
            CameraSequence::Turntable(frames) => Ok(camera.turntable(*frames).collect()),
            CameraSequence::Path(path) => CameraPath::load(path).map_err(|error| error.report())?.cameras(camera),
        }
    }
}
