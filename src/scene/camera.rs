//! The pinhole camera.
use glam::DVec3;
use serde::Serialize;

use crate::math::{F, Lanes, V};

/// Where the picture is taken from. Right-handed world, y usually up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Camera {
    pub eye: DVec3,
    pub look_at: DVec3,
    pub up: DVec3,
    /// Full angle across the picture's width, degrees.
    pub fov: f64,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
}

/// Why a camera cannot take a picture.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    #[error("a camera position or angle is not a finite number")]
    NotFinite,
    #[error("`eye` and `look_at` are the same point")]
    NoDirection,
    #[error("`up` is parallel to the direction of view")]
    UpIsForward,
    #[error("`fov` must lie between 0.001 and 179.9 degrees")]
    Fov,
    #[error("the resolution must be at least 1 × 1, at most {0} a side and {MOST_PIXELS} pixels in all", Camera::MOST_SIDE)]
    Resolution,
}

/// 8K UHD fits.
const MOST_PIXELS: u64 = 1 << 25;

impl Camera {
    /// Limit of width and of height.
    pub const MOST_SIDE: u32 = 16_384;

    pub fn check(&self) -> Result<(), CameraError> {
        self.check_resolution()?;
        if !(self.eye.is_finite() && self.look_at.is_finite() && self.up.is_finite() && self.fov.is_finite()) {
            return Err(CameraError::NotFinite);
        }
        if !(0.001..=179.9).contains(&self.fov) {
            return Err(CameraError::Fov);
        }
        let forward = (self.look_at - self.eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let up = self.up.try_normalize().ok_or(CameraError::UpIsForward)?;
        if forward.cross(up).length() < 1e-6 {
            return Err(CameraError::UpIsForward);
        }
        Ok(())
    }

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

    pub fn rays(&self) -> CameraRays {
        let [right, up, forward] = self.axes();
        let half_width = (self.fov.to_radians() / 2.0).tan();
        let [w, h] = self.resolution.map(f64::from);
        let half_height = half_width * h / w;
        CameraRays {
            eye: self.eye.as_vec3().to_array(),
            corner: (forward - right * half_width + up * half_height).as_vec3().to_array(),
            per_x: (right * (2.0 * half_width / w)).as_vec3().to_array(),
            per_y: (up * (-2.0 * half_height / h)).as_vec3().to_array(),
        }
    }
}

/// The rays of a camera, ready for lanes.
#[derive(Clone, Copy, Debug)]
pub struct CameraRays {
    eye: [f32; 3],
    /// Direction to the upper left corner of the picture, and its change per pixel to the right and down.
    corner: [f32; 3],
    per_x: [f32; 3],
    per_y: [f32; 3],
}

impl CameraRays {
    /// Origin and unit direction of the rays through raster points, in pixels from the upper left corner of the picture.
    #[inline(always)]
    pub fn through<L: Lanes>(&self, l: L, x: F<L>, y: F<L>) -> (V<L>, V<L>) {
        let d = V::splat(l, self.per_x) * x + V::splat(l, self.per_y) * y + self.corner;
        (V::splat(l, self.eye), d.normalized())
    }
}
