//! How thin a piece of a shape is.
use glam::{DMat3, DVec3};

use super::{extent::longest, shape::Shape};

impl Shape {
    /// A lower bound of the least width of a piece; infinite for shapes that are no pieces, and for isosurfaces.
    pub fn least_width(&self) -> f64 {
        match self {
            Shape::Sphere { radius, .. } => 2.0 * radius,
            Shape::Ellipsoid { axes, .. } | Shape::Cylinder { axes, .. } => shortest(axes),
            Shape::Flat { edges: [a, b], .. } => {
                a.cross(*b).length() / [*a, *b, *a - *b].into_iter().map(DVec3::length).fold(0.0, f64::max)
            }
            Shape::Cuboid { .. } | Shape::Mesh { .. } | Shape::Isosurface { .. } => f64::INFINITY,
        }
    }
}

/// The least singular value.
fn shortest(axes: &DMat3) -> f64 {
    1.0 / longest(&axes.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Outline, oracle::pieces};

    #[test]
    fn no_piece_is_thinner() {
        let flat = |outline, edges| Shape::Flat { outline, origin: DVec3::ONE, edges, mirrored: false };
        let needle = [DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 1e-3)];
        for (shape, least, most) in [
            (Shape::sphere(DVec3::ONE, 0.25), 0.5, 0.5),
            (Shape::Ellipsoid { center: DVec3::ZERO, axes: DMat3::from_diagonal(DVec3::new(3.0, 0.2, 5.0)) }, 0.199, 0.4),
            (Shape::cylinder(DVec3::ZERO, DVec3::new(0.0, 0.3, 0.0), 0.1, false), 0.099, 0.2),
            (Shape::disk(DVec3::ZERO, DVec3::Y, 0.1), 0.07, 0.2),
            (flat(Outline::Parallelogram, [DVec3::X * 4.0, DVec3::Y * 0.5]), 0.49, 0.5),
            (flat(Outline::Triangle, needle), 0.99e-3, 1e-3),
        ] {
            let width = pieces(&shape)[0].least_width();
            assert!((least..=most).contains(&width), "{}: {width}", shape.name());
        }
    }
}
