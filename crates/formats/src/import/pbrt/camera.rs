//! Cameras.
//!
//! The camera of pbrt looks along its +z, with +y up and +x to the right: it is left-handed. Ours is right-handed. If the transform of
//! the camera keeps the handedness, its image of our world would be mirrored, so the whole world is mirrored instead. Scenes of
//! right-handed programs contain `Scale -1 1 1` before the camera, and stay as they are.
use glam::{DAffine3, DVec3};

use super::{import::Import, options::Options, parameters::Entity};
use noisefall_scene::scene::{Lens, Projection, SceneError, description::CameraDescription};

/// The reflection of mirrored worlds.
const MIRROR: DAffine3 = DAffine3 { matrix3: glam::DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::Z), translation: DVec3::ZERO };
/// Scale factors that differ by less are equal.
const EQUAL: f64 = 1e-4;
/// Range of our angles of view, degrees.
const ANGLES: [f64; 2] = [0.001, 179.9];

/// Translates the camera. The film is known already.
pub fn camera(import: &mut Import, options: &Options) -> Result<(), SceneError> {
    let default = [DAffine3::IDENTITY; 2];
    let (entity, maps) = match &options.camera {
        Some((entity, maps)) => (Some(&**entity), *maps),
        None => (None, default),
    };
    let to_world = maps[0].inverse();
    if !super::transforms::is_invertible(&maps[0]) {
        let message = "the transform of the camera cannot be inverted";
        return Err(entity.map_or_else(
            || SceneError::of_file(std::path::Path::new("camera"), message, message),
            |entity| entity.error(message, "it flattens space"),
        ));
    }
    if to_world.matrix3.determinant() > 0.0 {
        import.mirror = MIRROR;
    }
    let frame = import.mirror * to_world;
    let [right, up, forward] = [frame.matrix3.x_axis, frame.matrix3.y_axis, frame.matrix3.z_axis];
    let eye = frame.translation;
    // A point at a distance that does not lose digits of the direction.
    let distance = eye.length().max(1.0);
    let seen = CameraDescription {
        eye,
        look_at: eye + forward.normalize() * distance,
        up: Some(up.normalize()),
        fov: Some(fov(0.5 * std::f64::consts::PI, aspect(import))),
        ..import.description.camera.clone()
    };
    import.description.camera = seen;
    let Some(entity) = entity else { return Ok(()) };
    if maps[0] != maps[1] {
        import.remark(entity, "the camera at the first time", "the motion of the camera is not blurred");
    }
    let scales = [right, up, forward].map(DVec3::length);
    let skew = [right.dot(up), up.dot(forward), forward.dot(right)].iter().fold(0.0, |most: f64, dot| most.max(dot.abs()));
    if (scales[0] / scales[1] - 1.0).abs() > EQUAL || skew > EQUAL * scales[0] * scales[2] {
        import.remark(entity, "a camera without shear and uneven scale", "the image is stretched differently");
    }
    optics(import, entity, scales)?;
    shutter(import, entity)?;
    import.remark_unused(entity);
    Ok(())
}

/// Projection and lens. `scales` are those of the axes of the camera.
fn optics(import: &mut Import, entity: &Entity, scales: [f64; 3]) -> Result<(), SceneError> {
    let width = screen_width(import, entity)?;
    let lens = Lens {
        radius: entity.float("lensradius", 0.0)?.abs() * scales[0],
        focus: (entity.float("focaldistance", 1e6)?.abs() * scales[2]).clamp(1e-9, 1e12),
    };
    let lens = (lens.radius > 0.0).then_some(lens);
    let mut angle = entity.float("fov", 90.0)?;
    let half = entity.float("halffov", -1.0)?;
    if half > 0.0 {
        angle = 2.0 * half;
    }
    match entity.kind.as_str() {
        "perspective" => import.description.camera.lens = lens,
        "orthographic" => {
            import.description.camera.fov = None;
            import.description.camera.projection = Projection::orthographic((width * scales[0]).clamp(1e-9, 1e9));
            if lens.is_some() {
                import.remark(entity, "an orthographic camera without lens", "everything is in focus");
            }
            return Ok(());
        }
        "realistic" => {
            entity.ignore(&["lensfile", "aperturediameter", "focusdistance", "simpleweighting", "aperture"]);
            import.remark(entity, "a pinhole with an angle of 40°", "framing, distortion and focus differ");
            angle = 40.0;
        }
        "spherical" => {
            entity.ignore(&["mapping"]);
            import.remark(entity, "a perspective camera with an angle of 90°", "only a part of all directions is seen");
            angle = 90.0;
        }
        other => return Err(entity.error(format!("`{other}` is not a camera of pbrt-v4"), "perspective or orthographic")),
    }
    let ratio = width / 2.0 * scales[0] / scales[2];
    import.description.camera.fov = Some(fov(angle.to_radians(), ratio));
    Ok(())
}

/// The angle across the width, degrees, from the angle that a screen of 2 subtends and half the width of the screen.
fn fov(angle: f64, half_width: f64) -> f64 {
    let fov = 2.0 * ((0.5 * angle).tan() * half_width).atan().to_degrees();
    if fov.is_nan() { 90.0 } else { fov.clamp(ANGLES[0], ANGLES[1]) }
}

/// Width of the film over its height; at least 1, since the shorter side of the screen is from −1 to 1.
fn aspect(import: &Import) -> f64 {
    let [width, height] = import.description.camera.resolution.map(f64::from);
    (width / height).max(1.0)
}

/// Width of the screen, whose shorter side is 2.
fn screen_width(import: &mut Import, entity: &Entity) -> Result<f64, SceneError> {
    let [columns, rows] = import.description.camera.resolution.map(f64::from);
    let frame = entity.float("frameaspectratio", columns / rows)?;
    let [mut width, mut height] = if frame > 1.0 { [2.0 * frame, 2.0] } else { [2.0, 2.0 / frame] };
    let window = entity.list("screenwindow").map(<[f64]>::to_vec);
    if let Some(window) = window {
        let [x0, x1, y0, y1] = window[..] else {
            return Err(entity.error("`screenwindow` has four numbers", "left, right, bottom and top"));
        };
        [width, height] = [(x1 - x0).abs(), (y1 - y0).abs()];
        if x1 <= x0 || y1 <= y0 {
            import.remark_parameter(entity, "screenwindow", "a screen that is not mirrored", "the image is not mirrored");
        }
        import.description.camera.shift = [x0 + x1, y0 + y1].map(|sum| (0.5 * sum / width).clamp(-100.0, 100.0));
    }
    if (width / height / (columns / rows) - 1.0).abs() > 1e-3 {
        let effect = "the image shows more or less at the top and bottom, and is not stretched";
        import.remark(entity, "square pixels", effect);
    }
    Ok(width)
}

/// The shutter, relative to the times of the transforms.
fn shutter(import: &mut Import, entity: &Entity) -> Result<(), SceneError> {
    let [start, end] = import.times;
    let times = [entity.float("shutteropen", 0.0)?, entity.float("shutterclose", 1.0)?];
    let relative = |time: f64| if end > start { ((time - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 };
    import.description.camera.shutter =
        Some(times.map(relative).into_iter().fold([1.0, 0.0], |[open, close]: [f64; 2], time| [open.min(time), close.max(time)]));
    Ok(())
}
