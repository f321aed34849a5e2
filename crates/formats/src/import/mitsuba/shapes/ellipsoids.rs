//! Clouds of ellipsoids.
use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::{
    super::{context::Import, tree::Element},
    Geometry, MOST_OBJECTS, Placed,
    ply_values::{read_file, read_values},
};
use noisefall_scene::{scene::SceneError, shape::Sphere};

/// Properties of a vertex: its centre, the logarithms of its half axes, and its rotation as w x y z.
const PROPERTIES: [&str; 10] = ["x", "y", "z", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"];

/// Surfaces of ellipsoids. Mitsuba uses them as bounds of Gaussians, which only its integrators for volumes render.
pub fn ellipsoids(import: &mut Import, element: Element, placed: Placed) -> Result<Vec<Geometry>, SceneError> {
    import.remark(element, "solid ellipsoids", "their opacities and harmonics are left out, as in Mitsuba's path tracer");
    element.ignore(&["extent_adaptive_clamping", "shell"]);
    let size = element.number("scale_factor", 1.0)? * element.number("extent", 3.0)?;
    let path = import.file(element, "filename")?;
    let bytes = read_file(element, &path)?;
    let flip = placed.flip ^ placed.is_mirrored();
    let (mut found, mut count, mut wrong) = (Vec::new(), 0, None);
    let channel = |name: &str| PROPERTIES.iter().position(|property| *property == name);
    let read = read_values(&bytes, "vertex", channel, |channels, _| {
        match ellipsoid(channels, size) {
            None => wrong = wrong.or(Some(count)),
            // Ellipsoids beyond the limit are only counted.
            Some(map) if count < MOST_OBJECTS => {
                let shape = Sphere { center: DVec3::ZERO, radius: 1.0 };
                found.push(Geometry { shape: shape.into(), map: placed.map * map, flip });
            }
            Some(_) => {}
        }
        count += 1;
    });
    let error = |message: String, help: &str| Err(element.error(format!("`{}`: {message}", path.display()), help));
    if let Some(place) = wrong {
        return error(
            format!("ellipsoid {} has no size or place", place + 1),
            "scales are logarithms, and rotations are not zero",
        );
    }
    if read.is_none() || count == 0 {
        return error("there are no ellipsoids".to_owned(), "a PLY with x y z, scale_0 to scale_2 and rot_0 to rot_3");
    }
    if count > MOST_OBJECTS {
        return error(format!("there are {count} ellipsoids, more than {MOST_OBJECTS}"), "thin them out");
    }
    Ok(found)
}

/// The map of the unit sphere to an ellipsoid; `None` if a number is missing or too large.
fn ellipsoid(channels: [Option<f64>; PROPERTIES.len()], size: f64) -> Option<DAffine3> {
    /// Half axes that the renderer can tell from nothing.
    const HALF_AXES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;
    let number = |i: usize| channels[i].filter(|number| number.abs() < 1e30);
    let vector = |i: usize| Some(DVec3::new(number(i)?, number(i + 1)?, number(i + 2)?));
    let axes = vector(3)?.exp() * size;
    let imaginary = vector(7)?;
    let rotation = DQuat::from_xyzw(imaginary.x, imaginary.y, imaginary.z, number(6)?);
    if !axes.to_array().iter().all(|axis| HALF_AXES.contains(axis)) || rotation.length_squared() < 1e-30 {
        return None;
    }
    let matrix3 = DMat3::from_quat(rotation.normalize()) * DMat3::from_diagonal(axes);
    Some(DAffine3 { matrix3, translation: vector(0)? })
}
