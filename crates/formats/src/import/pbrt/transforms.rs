//! Transformation directives, as matrices.
use glam::{DAffine3, DMat3, DMat4, DVec3};

use noisefall_scene::scene::SceneError;

use super::source::TextSpan;

/// A transform of 16 numbers, column by column.
pub fn matrix(numbers: &[f64], place: &TextSpan) -> Result<DAffine3, SceneError> {
    let Ok(columns) = <[f64; 16]>::try_from(numbers) else {
        return Err(place.error("a transform has 16 numbers", format!("there are {}", numbers.len())));
    };
    let full = DMat4::from_cols_array(&columns);
    let last = full.row(3);
    if last.truncate() != DVec3::ZERO || last.w == 0.0 {
        return Err(place.error("the transform is not affine", "the fourth number of each column must be 0, 0, 0, 1"));
    }
    Ok(DAffine3::from_mat4(full * (1.0 / last.w)))
}

/// From the world to a camera at `eye` that looks along its +z, with +y up and +x to the right: left-handed.
pub fn look_at(numbers: &[f64], place: &TextSpan) -> Result<DAffine3, SceneError> {
    let vector = |at: usize| DVec3::new(numbers[at], numbers[at + 1], numbers[at + 2]);
    let (eye, target, up) = (vector(0), vector(3), vector(6));
    let forward = (target - eye).try_normalize();
    let right = forward.and_then(|forward| up.cross(forward).try_normalize());
    let (Some(forward), Some(right)) = (forward, right) else {
        return Err(
            place.error("the camera has no direction", "eye and target must differ, and `up` must not be parallel to the view")
        );
    };
    let columns = DMat3::from_cols(right, forward.cross(right), forward);
    Ok(DAffine3 { matrix3: columns, translation: eye }.inverse())
}

/// A rotation about an axis, degrees.
pub fn rotation(numbers: &[f64], place: &TextSpan) -> Result<DAffine3, SceneError> {
    let axis = DVec3::new(numbers[1], numbers[2], numbers[3]).try_normalize();
    let axis = axis.ok_or_else(|| place.error("the axis of rotation is zero", "it needs a direction"))?;
    Ok(DAffine3::from_axis_angle(axis, numbers[0].to_radians()))
}

/// Whether a map can be inverted.
pub fn is_invertible(map: &DAffine3) -> bool {
    let lengths: f64 = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis].iter().map(|axis| axis.length()).product();
    map.is_finite() && map.matrix3.determinant().abs() > 1e-9 * lengths
}
