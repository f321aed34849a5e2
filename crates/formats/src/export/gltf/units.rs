//! Shapes of unit size, which nodes scale and move.
use glam::{DAffine3, DMat3, DVec3};

use noisefall_scene::geometry::{Outline, Shape};

/// Returns the shape at unit size, and the map from there; `None` for meshes and isosurfaces. A map that mirrors keeps the front.
pub fn unit(shape: &Shape) -> Option<(Shape, DAffine3)> {
    let sphere = Shape::sphere(DVec3::ZERO, 1.0);
    Some(match shape {
        Shape::Sphere { center, radius, turn } => {
            let matrix3 = turn.unwrap_or(DMat3::IDENTITY) * *radius;
            (sphere, DAffine3 { matrix3, translation: *center })
        }
        Shape::Ellipsoid { center, axes } => (sphere, DAffine3 { matrix3: *axes, translation: *center }),
        Shape::Flat { outline, origin, edges: [a, b], mirrored } => {
            // The normal of the front, as long as the edges are.
            let front = a.cross(*b) * if *mirrored { -1.0 } else { 1.0 };
            let matrix3 = DMat3::from_cols(*a, *b, front / front.length().sqrt());
            let flat = Shape::Flat { outline: *outline, origin: DVec3::ZERO, edges: [DVec3::X, DVec3::Y], mirrored: false };
            (flat, DAffine3 { matrix3, translation: *origin })
        }
        Shape::Cuboid { origin, edges } => {
            let cube = Shape::Cuboid { origin: DVec3::ZERO, edges: DMat3::IDENTITY };
            (cube, DAffine3 { matrix3: *edges, translation: *origin })
        }
        Shape::Cylinder { base, axes, capped } => {
            let cylinder = Shape::Cylinder { base: DVec3::ZERO, axes: DMat3::IDENTITY, capped: *capped };
            (cylinder, DAffine3 { matrix3: *axes, translation: *base })
        }
        Shape::Mesh { .. } | Shape::Isosurface { .. } => return None,
    })
}

/// A number that tells the unit shapes apart.
pub fn number(shape: &Shape) -> usize {
    match shape {
        Shape::Sphere { .. } | Shape::Ellipsoid { .. } => 0,
        Shape::Flat { outline: Outline::Parallelogram, .. } => 1,
        Shape::Flat { outline: Outline::Triangle, .. } => 2,
        Shape::Flat { outline: Outline::Ellipse, .. } => 3,
        Shape::Cuboid { .. } => 4,
        Shape::Cylinder { capped, .. } => 5 + usize::from(*capped),
        Shape::Mesh { .. } | Shape::Isosurface { .. } => 7,
    }
}
