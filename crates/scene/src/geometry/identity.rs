//! Compares shapes bit for bit. For `==`, 0 equals −0, and images can differ by that.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::{Motion, Shape, TransformStep};

/// Whether two maps have the same bits.
pub(super) fn same_map(a: &DAffine3, b: &DAffine3) -> bool {
    same_matrix(&a.matrix3, &b.matrix3) && same_point(&a.translation, &b.translation)
}

/// Whether two points have the same bits.
pub fn same_point(a: &DVec3, b: &DVec3) -> bool {
    a.to_array().map(f64::to_bits) == b.to_array().map(f64::to_bits)
}

fn same_matrix(a: &DMat3, b: &DMat3) -> bool {
    a.to_cols_array().map(f64::to_bits) == b.to_cols_array().map(f64::to_bits)
}

impl Shape {
    /// Whether both are the same, bit for bit, and share their data.
    pub fn is_same(&self, other: &Shape) -> bool {
        match (self, other) {
            (Shape::Sphere { center: a, radius: r, turn: x }, Shape::Sphere { center: b, radius: s, turn: y }) => {
                let turn_alike = match (x, y) {
                    (Some(x), Some(y)) => same_matrix(x, y),
                    (None, None) => true,
                    _ => false,
                };
                same_point(a, b) && r.to_bits() == s.to_bits() && turn_alike
            }
            (Shape::Ellipsoid { center: a, axes: x }, Shape::Ellipsoid { center: b, axes: y })
            | (Shape::Cuboid { origin: a, edges: x }, Shape::Cuboid { origin: b, edges: y }) => {
                same_point(a, b) && same_matrix(x, y)
            }
            (
                Shape::Flat { outline: c, origin: a, edges: [u, v], mirrored: m },
                Shape::Flat { outline: d, origin: b, edges: [x, y], mirrored: n },
            ) => (c, m) == (d, n) && same_point(a, b) && same_point(u, x) && same_point(v, y),
            (Shape::Cylinder { base: a, axes: x, capped: c }, Shape::Cylinder { base: b, axes: y, capped: d }) => {
                c == d && same_point(a, b) && same_matrix(x, y)
            }
            (Shape::Mesh { data: a, map: x, .. }, Shape::Mesh { data: b, map: y, .. }) => Arc::ptr_eq(a, b) && same_map(x, y),
            (Shape::Isosurface { surface: a, map: x }, Shape::Isosurface { surface: b, map: y }) => {
                Arc::ptr_eq(a, b) && same_map(x, y)
            }
            _ => false,
        }
    }
}

impl Motion {
    /// Whether both are the same, bit for bit.
    pub fn is_same(&self, other: &Motion) -> bool {
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(|(a, b)| a.is_same(b))
    }
}

impl TransformStep {
    fn is_same(&self, other: &TransformStep) -> bool {
        match (self, other) {
            (TransformStep::Translate(a), TransformStep::Translate(b)) | (TransformStep::Scale(a), TransformStep::Scale(b)) => {
                same_point(a, b)
            }
            (TransformStep::Rotate { axis: a, turns: x }, TransformStep::Rotate { axis: b, turns: y }) => {
                same_point(a, b) && x.is_same(*y)
            }
            (TransformStep::Matrix(a), TransformStep::Matrix(b)) => same_map(a, b),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{MeshData, Turns};

    #[test]
    fn shapes_are_the_same_by_their_bits_and_by_the_data_that_they_share() {
        let sphere = |x: f64| Shape::sphere(DVec3::new(x, 0.0, 0.0), 1.0);
        assert!(sphere(0.5).is_same(&sphere(0.5)) && !sphere(0.5).is_same(&sphere(0.25)));
        assert!(!sphere(0.0).is_same(&sphere(-0.0)), "they can differ by the sign of a normal");
        let turned = |axis| sphere(0.5).transformed(&DAffine3::from_axis_angle(axis, 0.3));
        assert!(turned(DVec3::Y).is_same(&turned(DVec3::Y)) && !turned(DVec3::Y).is_same(&sphere(0.5)));
        let about_center = DAffine3::from_mat3(DMat3::from_rotation_x(1.0));
        assert!(!sphere(0.0).is_same(&sphere(0.0).transformed(&about_center)), "its texture turns");
        let mesh =
            || Shape::mesh(Arc::new(MeshData { vertices: vec![[0.0; 3]; 3], triangles: vec![[0, 1, 2]], ..MeshData::default() }));
        let (a, b) = (mesh(), mesh());
        assert!(a.is_same(&a.clone()) && !a.is_same(&b), "equal data is compared by its address");
        assert!(!a.is_same(&a.transformed(&DAffine3::from_scale(DVec3::splat(2.0)))));
        assert!(!a.is_same(&sphere(0.0)));
    }

    #[test]
    fn motions_are_the_same_step_by_step() {
        let turn = |degrees: f64| TransformStep::Rotate { axis: DVec3::Y, turns: Turns::from_degrees(degrees) };
        let motion = |degrees: f64| Motion(vec![TransformStep::Translate(DVec3::X), turn(degrees)]);
        assert!(motion(90.0).is_same(&motion(90.0)) && !motion(90.0).is_same(&motion(450.0)));
        assert!(!motion(90.0).is_same(&Motion::default()));
    }
}
