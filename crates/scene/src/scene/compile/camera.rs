//! The camera of a description.
use glam::DVec3;

use crate::scene::{Camera, CameraError, Projection, Shutter, description::CameraDescription};
use noisefall_base::declare::{OneOf, Problem, short};

/// Stand-in for the angle of a camera that has none; it has no effect.
const NO_FOV: f64 = 40.0;

pub fn camera(described: &CameraDescription) -> Result<Camera, Problem> {
    let camera = Camera {
        eye: described.eye,
        look_at: described.look_at,
        up: described.up.unwrap_or(DVec3::Y),
        fov: fov(described.fov, described.projection)?,
        projection: described.projection,
        shift: described.shift,
        lens: described.lens,
        filter: described.filter,
        shutter: described.shutter.map(shutter).transpose()?,
        resolution: described.resolution,
    };
    camera.check().map_err(|error| {
        let problem = Problem::at(key(error), error.to_string(), label(error));
        if error == CameraError::UpIsForward && described.up.is_none() {
            problem.help("`up` is [0, 1, 0] by default: give another, such as [0, 0, -1]")
        } else {
            problem
        }
    })?;
    // A lens without extent is a pinhole.
    Ok(Camera { lens: camera.lens.filter(|lens| lens.radius > 0.0), ..camera })
}

/// The angle of view, of projections that have one.
fn fov(fov: Option<f64>, projection: Projection) -> Result<f64, Problem> {
    match (fov, projection.has_angle()) {
        (Some(fov), true) => Ok(fov),
        (None, false) => Ok(NO_FOV),
        (None, true) => Err(Problem::at("", "missing key `fov`", "`fov` must be given here")),
        (Some(_), false) => {
            let message = format!("an {} camera has no `fov`", projection.name());
            Err(Problem::at("fov", message, "remove it, or the projection"))
        }
    }
}

fn shutter([open, close]: [f64; 2]) -> Result<Shutter, Problem> {
    if -Shutter::FARTHEST <= open && open <= close && close <= Shutter::FARTHEST {
        return Ok(Shutter { open, close });
    }
    let message = format!("`shutter` is out of range: it opens at {} and closes at {}", short(open), short(close));
    let label = format!("expected two times from {0:e} to {1:e}, the earlier one first", -Shutter::FARTHEST, Shutter::FARTHEST);
    Err(Problem::at("shutter", message, label))
}

/// The text at the key of an error.
fn label(error: CameraError) -> &'static str {
    match error {
        CameraError::Resolution => "width and height in pixels",
        CameraError::Fov => "degrees",
        CameraError::NotFinite => "not a finite number",
        CameraError::NoDirection => "the same as `eye`",
        CameraError::UpIsForward => "choose another direction",
        CameraError::UpIsZero => "a direction, such as [0, 1, 0]",
        CameraError::Shift => "widths of the image",
        CameraError::Width | CameraError::LensRadius | CameraError::Focus => "metres",
        CameraError::LensOrthographic => "remove it, or the projection",
        CameraError::Filter => "pixels",
    }
}

/// The key that an error is about.
fn key(error: CameraError) -> &'static str {
    match error {
        CameraError::Resolution => "resolution",
        CameraError::Fov | CameraError::NotFinite => "fov",
        CameraError::NoDirection => "look_at",
        CameraError::UpIsForward | CameraError::UpIsZero => "up",
        CameraError::Shift => "shift",
        CameraError::Width => "projection",
        CameraError::LensRadius | CameraError::Focus | CameraError::LensOrthographic => "lens",
        CameraError::Filter => "filter",
    }
}
