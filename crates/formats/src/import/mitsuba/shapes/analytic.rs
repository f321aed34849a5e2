//! Spheres, cylinders and rectangles.
use glam::{DAffine3, DMat3, DVec3};

use super::{
    super::{context::Import, tree::Element},
    Geometry, Placed,
};
use noisefall_scene::{
    scene::SceneError,
    shape::{Sphere, cylinder::Cylinder, rectangle::Rectangle},
};

pub fn sphere(_: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let center = element.vector("center")?.unwrap_or(DVec3::ZERO);
    let radius = length(element, element.number("radius", 1.0)?)?;
    let mirrors = placed.is_mirrored();
    let flip = placed.flip ^ mirrors ^ (element.number("radius", 1.0)? < 0.0);
    if !placed.uses.coordinates {
        return Ok(Geometry { shape: Sphere { center, radius }.into(), map: placed.map, flip });
    }
    // Coordinates of Mitsuba turn about z, and ours about y.
    let turned = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    let local = DAffine3 { matrix3: turned * radius, translation: center };
    Ok(Geometry { shape: Sphere { center: DVec3::ZERO, radius: 1.0 }.into(), map: placed.map * local, flip })
}

pub fn cylinder(_: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let base = element.vector("p0")?.unwrap_or(DVec3::ZERO);
    let top = element.vector("p1")?.unwrap_or(DVec3::Z);
    let radius = length(element, element.number("radius", 1.0)?)?;
    let flip = placed.flip;
    if base == top {
        return Err(element.error("the cylinder has no height", "`p1` must differ from `p0`"));
    }
    if !placed.uses.coordinates {
        return Ok(Geometry { shape: Cylinder { base, top, radius, capped: false }.into(), map: placed.map, flip });
    }
    // Our v runs from the top to the base, and Mitsuba's from `p0` to `p1`.
    let (a, b) = (top - base).normalize().any_orthonormal_pair();
    let local = DAffine3 { matrix3: DMat3::from_cols(a * radius, b * radius, base - top), translation: top };
    let unit = Cylinder { base: DVec3::ZERO, top: DVec3::Z, radius: 1.0, capped: false };
    Ok(Geometry { shape: unit.into(), map: placed.map * local, flip })
}

pub fn rectangle(_: &mut Import, _: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let map = &placed.map;
    let edge = |v: DVec3| map.transform_vector3(v);
    // Our v runs against the second edge, and Mitsuba's upwards.
    let (corner, edge_v) = if placed.uses.coordinates {
        (DVec3::new(-1.0, 1.0, 0.0), edge(DVec3::new(0.0, -2.0, 0.0)))
    } else {
        (DVec3::new(-1.0, -1.0, 0.0), edge(DVec3::new(0.0, 2.0, 0.0)))
    };
    let edge_u = edge(DVec3::new(2.0, 0.0, 0.0));
    let front = map.matrix3.inverse().transpose() * DVec3::Z;
    let flip = placed.flip ^ (edge_u.cross(edge_v).dot(front) < 0.0);
    let shape = Rectangle { origin: map.transform_point3(corner), edge_u, edge_v };
    Ok(Geometry { shape: shape.into(), map: DAffine3::IDENTITY, flip })
}

fn length(element: Element, length: f64) -> Result<f64, SceneError> {
    let length = length.abs();
    if (1e-9..=1e9).contains(&length) {
        return Ok(length);
    }
    Err(element.error(format!("the radius {length} is zero or too large"), "choose one from 1e-9 to 1e9"))
}
