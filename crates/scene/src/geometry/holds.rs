//! Whether a shape holds all of a box.
use glam::{DVec3, Vec3};

use super::{Bounds, Shape};

impl Shape {
    /// Whether all of a box lies inside the shape, or none of it; `None` where the surface may pass through the box.
    pub fn holds(&self, bounds: &Bounds) -> Option<bool> {
        let corner = |number: usize| {
            let at = |axis: usize| f64::from(if number >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] });
            DVec3::new(at(0), at(1), at(2))
        };
        match self {
            Shape::Sphere { .. } | Shape::Ellipsoid { .. } | Shape::Cuboid { .. } | Shape::Cylinder { .. } => {
                // These are convex.
                (0..8).all(|number| self.contains(corner(number))).then_some(true)
            }
            Shape::Mesh { data, map, .. } => {
                let place =
                    |id: &u32| map.transform_point3(Vec3::from(data.vertices[*id as usize]).as_dvec3()).as_vec3().to_array();
                let is_near = |triangle: &[u32; 3]| Bounds::of_points(triangle.iter().map(place)).overlaps(bounds);
                (!data.triangles.iter().any(is_near)).then(|| self.contains(corner(0)))
            }
            Shape::Flat { .. } | Shape::Isosurface { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::{DAffine3, DMat3};

    use super::*;
    use crate::geometry::MeshData;

    fn around(center: [f32; 3], half: f32) -> Bounds {
        Bounds { min: center.map(|x| x - half), max: center.map(|x| x + half) }
    }

    #[test]
    fn convex_shapes_hold_boxes_whose_corners_they_contain() {
        let ball = Shape::Sphere { center: DVec3::ZERO, radius: 1.0, turn: None };
        let pool = Shape::Cuboid { origin: DVec3::NEG_ONE, edges: DMat3::from_diagonal(DVec3::splat(2.0)) };
        for shape in [ball, pool] {
            assert_eq!(shape.holds(&around([0.0; 3], 0.5)), Some(true), "{shape:?}");
            assert_eq!(shape.holds(&around([1.0, 0.0, 0.0], 0.5)), None, "{shape:?}");
            assert_eq!(shape.holds(&around([0.0; 3], 1.0)), None, "{shape:?}");
        }
    }

    #[test]
    fn a_mesh_holds_boxes_that_no_triangle_is_near() {
        let vertices = (0..8).map(|corner| [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 })).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let data = Arc::new(MeshData { vertices, triangles, ..MeshData::default() });
        let shape = Shape::mesh(data).transformed(&DAffine3::from_scale(DVec3::splat(2.0)));
        assert_eq!(shape.holds(&around([0.0; 3], 1.5)), Some(true));
        assert_eq!(shape.holds(&around([1.0, 0.0, 0.0], 1.5)), None);
        assert_eq!(shape.holds(&around([5.0, 0.0, 0.0], 1.0)), Some(false));
    }
}
