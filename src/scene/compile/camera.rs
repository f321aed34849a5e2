//! The camera of a scene file.
use glam::DVec3;
use toml::Spanned;

use crate::{
    sampling::Filter,
    scene::{
        Camera, CameraError, Lens, Shutter,
        check::{Checker, short},
        desc::{CameraDesc, Exactly, ProjectionDesc},
        diagnostic::SceneError,
        errors::Errors,
    },
};

/// What an orthographic camera has in place of an angle; it takes no part in anything.
const NO_FOV: f64 = 40.0;

/// None where something is wrong.
pub fn camera(check: &Checker, desc: &Spanned<CameraDesc>, errors: &mut Errors) -> Option<Camera> {
    let c = desc.as_ref();
    let orthographic = match c.projection.as_ref().map(Spanned::as_ref) {
        Some(ProjectionDesc::Orthographic { width }) => Some(*width),
        Some(ProjectionDesc::Perspective) | None => None,
    };
    let fov = errors.keep(desc, fov(check, desc, orthographic));
    let eye = errors.keep(desc, check.point("eye", &c.eye));
    let look_at = errors.keep(desc, check.point("look_at", &c.look_at));
    let up = errors.keep(desc, c.up.as_ref().map_or(Ok(DVec3::Y), |up| check.point("up", up)));
    let shutter = errors.keep(desc, c.shutter.as_ref().map(|times| shutter(check, times)).transpose());
    let camera = Camera {
        eye: eye?,
        look_at: look_at?,
        up: up?,
        fov: fov?,
        orthographic,
        lens: c.lens.as_ref().map(|lens| Lens { radius: lens.as_ref().radius, focus: lens.as_ref().focus }),
        filter: c.filter.as_ref().map_or(Filter::Box, |filter| filter.as_ref().0),
        shutter: shutter?,
        resolution: c.resolution.as_ref().0,
    };
    errors.keep(desc, checked(check, desc, camera))
}

/// The angle of view: of perspective cameras only.
fn fov(check: &Checker, desc: &Spanned<CameraDesc>, orthographic: Option<f64>) -> Result<f64, SceneError> {
    match (&desc.as_ref().fov, orthographic) {
        (Some(fov), None) => Ok(*fov.as_ref()),
        (None, Some(_)) => Ok(NO_FOV),
        (None, None) => Err(check.missing(desc, "fov")),
        (Some(fov), Some(_)) => {
            Err(check.0.error(fov.span(), "an orthographic camera has no `fov`", "remove it, or the projection"))
        }
    }
}

fn checked(check: &Checker, desc: &Spanned<CameraDesc>, camera: Camera) -> Result<Camera, SceneError> {
    camera.check().map_err(|error| {
        let told = check.0.error(place(desc, error), error.to_string(), label(error));
        let is_default = error == CameraError::UpIsForward && desc.as_ref().up.is_none();
        if is_default {
            told.with_help("`up` is [0, 1, 0] where it is not given: give another, such as [0, 0, -1]")
        } else {
            told
        }
    })?;
    // A lens without extent is a pinhole.
    Ok(Camera { lens: camera.lens.filter(|lens| lens.radius > 0.0), ..camera })
}

fn shutter(check: &Checker, times: &Spanned<Exactly<f64, 2>>) -> Result<Shutter, SceneError> {
    let [open, close] = times.as_ref().0;
    if -Shutter::FARTHEST <= open && open <= close && close <= Shutter::FARTHEST {
        return Ok(Shutter { open, close });
    }
    let message = format!("`shutter` is out of range: it opens at {} and closes at {}", short(open), short(close));
    let label = format!("expected two times from {0:e} to {1:e}, the earlier one first", -Shutter::FARTHEST, Shutter::FARTHEST);
    Err(check.0.error(times.span(), message, label))
}

/// What stands at the key that an error is about.
fn label(error: CameraError) -> &'static str {
    match error {
        CameraError::Resolution => "width and height in pixels",
        CameraError::Fov => "degrees",
        CameraError::NotFinite => "not a finite number",
        CameraError::NoDirection => "the same as `eye`",
        CameraError::UpIsForward => "choose another direction",
        CameraError::UpIsZero => "a direction, such as [0, 1, 0]",
        CameraError::Width | CameraError::LensRadius | CameraError::Focus => "metres",
        CameraError::LensOrthographic => "remove it, or the projection",
        CameraError::Filter => "pixels",
    }
}

/// The key that an error is about.
fn place(desc: &Spanned<CameraDesc>, error: CameraError) -> std::ops::Range<usize> {
    let c = desc.as_ref();
    let key = match error {
        CameraError::Resolution => Some(c.resolution.span()),
        CameraError::Fov | CameraError::NotFinite => c.fov.as_ref().map(Spanned::span),
        CameraError::NoDirection => Some(c.look_at.span()),
        CameraError::UpIsForward | CameraError::UpIsZero => Some(c.up.as_ref().unwrap_or(&c.look_at).span()),
        CameraError::Width => c.projection.as_ref().map(Spanned::span),
        CameraError::LensRadius | CameraError::Focus | CameraError::LensOrthographic => c.lens.as_ref().map(Spanned::span),
        CameraError::Filter => c.filter.as_ref().map(Spanned::span),
    };
    key.unwrap_or_else(|| desc.span())
}
