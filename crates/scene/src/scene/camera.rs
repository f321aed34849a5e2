//! The camera: position, direction, lens and pixel filter.
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Projection, Shutter};
use crate::sampling::Filter;
use noisefall_base::declare::check;

/// A camera in a right-handed world, in which y is usually up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Position, metres.
    pub eye: DVec3,
    /// The point at the centre of the image without a shift, metres.
    pub look_at: DVec3,
    /// The direction that is up in the image, of any length.
    pub up: DVec3,
    /// Field of view across the width of the image, degrees, of projections that have one.
    pub fov: f64,
    /// The projection.
    #[serde(default, alias = "orthographic", deserialize_with = "Projection::deserialize")]
    pub projection: Projection,
    /// Shift of the image plane to the right and up, in widths of the image.
    #[serde(default)]
    pub shift: [f64; 2],
    /// The thin lens; `None` is a pinhole.
    pub lens: Option<Lens>,
    /// The pixel filter.
    pub filter: Filter,
    /// The times at which the shutter is open, which blurs motion; `None` is time 0.
    pub shutter: Option<Shutter>,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
}

/// A thin lens: an open disk around the eye that brings the plane at distance `focus` into focus.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lens {
    /// Radius, metres.
    pub radius: f64,
    /// Distance of the plane in focus from the eye along the axis, metres.
    pub focus: f64,
}

/// Error in the values of a camera.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A number is infinite or NaN.
    #[error("a camera position or angle is not a finite number")]
    NotFinite,
    /// The direction of view has no length.
    #[error("`eye` and `look_at` are the same point")]
    NoDirection,
    /// The upward direction has no length.
    #[error("`up` is zero: it must be a direction")]
    UpIsZero,
    /// The upward direction is the direction of view.
    #[error("`up` is parallel to the direction of view")]
    UpIsForward,
    /// The field of view is out of range.
    #[error("`fov` must lie between 0.001 and 179.9 degrees")]
    Fov,
    /// The width of an orthographic image is out of range.
    #[error("the width of an orthographic image must lie between 1e-9 and 1e9 metres")]
    Width,
    /// The shift is out of range.
    #[error("the shift of the image must lie between -100 and 100 widths")]
    Shift,
    /// The radius of the lens is out of range.
    #[error("the radius of a lens must lie between 0 and 1e9 metres")]
    LensRadius,
    /// The distance of the plane in focus is out of range.
    #[error("the distance in focus must lie between 1e-9 and 1e12 metres")]
    Focus,
    /// A lens and parallel rays exclude each other.
    #[error("a lens needs a perspective camera")]
    LensOrthographic,
    /// The width of the pixel filter is out of range.
    #[error("the width of a pixel filter must lie between 0.01 and 16 pixels")]
    Filter,
    /// The resolution is out of range.
    #[error("the resolution must be at least 1 × 1, at most {0} a side and {MOST_PIXELS} pixels in all", Camera::MOST_SIDE)]
    Resolution,
}

/// Largest number of pixels, enough for 8K UHD.
const MOST_PIXELS: u64 = 1 << 25;

impl Camera {
    /// Limit of width and of height.
    pub const MOST_SIDE: u32 = 16_384;

    /// Checks all values, including the resolution.
    pub fn check(&self) -> Result<(), CameraError> {
        self.check_resolution()?;
        if !(self.eye.is_finite() && self.look_at.is_finite() && self.up.is_finite() && self.fov.is_finite()) {
            return Err(CameraError::NotFinite);
        }
        if !(0.001..=179.9).contains(&self.fov) {
            return Err(CameraError::Fov);
        }
        self.check_optics()?;
        let forward = (self.look_at - self.eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let up = self.up.try_normalize().ok_or(CameraError::UpIsZero)?;
        if forward.cross(up).length() < 1e-6 {
            return Err(CameraError::UpIsForward);
        }
        Ok(())
    }

    fn check_optics(&self) -> Result<(), CameraError> {
        if !check(&mut self.projection.clone()).is_empty() {
            return Err(CameraError::Width);
        }
        if !self.shift.iter().all(|shift| (-100.0..=100.0).contains(shift)) {
            return Err(CameraError::Shift);
        }
        if let Some(lens) = self.lens {
            if !(0.0..=1e9).contains(&lens.radius) {
                return Err(CameraError::LensRadius);
            }
            if !(1e-9..=1e12).contains(&lens.focus) {
                return Err(CameraError::Focus);
            }
            if !self.projection.takes_lens() {
                return Err(CameraError::LensOrthographic);
            }
        }
        if check(&mut self.filter.clone()).is_empty() { Ok(()) } else { Err(CameraError::Filter) }
    }

    /// Checks the resolution alone.
    pub fn check_resolution(&self) -> Result<(), CameraError> {
        let [w, h] = self.resolution;
        let fits = |side: u32| (1..=Self::MOST_SIDE).contains(&side);
        if fits(w) && fits(h) && u64::from(w) * u64::from(h) <= MOST_PIXELS { Ok(()) } else { Err(CameraError::Resolution) }
    }

    /// Unit vectors to the right, up and forward, in world space.
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = (self.look_at - self.eye).normalize();
        let right = forward.cross(self.up).normalize();
        [right, right.cross(forward), forward]
    }

    /// The width of the image at the look-at point, metres.
    pub fn width_at_look_at(&self) -> f64 {
        self.projection.width_at(self.eye.distance(self.look_at), self.fov)
    }
}
