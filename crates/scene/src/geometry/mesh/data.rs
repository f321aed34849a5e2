//! Vertices and triangles of a mesh, as a scene describes them.
use std::borrow::Cow;

use glam::{DAffine3, DMat3, DVec3, Vec3};
use rayon::prelude::*;

use crate::geometry::bounds::Bounds;

/// Vertices and triangles. `normals`, `uvs`, `colours` and `tangents` have one entry for each vertex, or none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Positions, metres.
    pub vertices: Vec<[f32; 3]>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Shading normals of any length.
    pub normals: Vec<[f32; 3]>,
    /// v is upwards.
    pub uvs: Vec<[f32; 2]>,
    /// Linear Rec. 709 and opacity, from 0 to 1.
    pub colours: Vec<[f32; 4]>,
    /// Directions t in the surface, of any length, and a handedness w: red of a normal map tilts along t, and green along w n × t, where
    /// n is the normal on the front. Highlights of anisotropic facets are turned from t towards w n × t. A negative w stands for −1,
    /// any other for 1. Without tangents, t is ∂p/∂u, and green tilts upwards in the image.
    pub tangents: Vec<[f32; 4]>,
}

impl MeshData {
    /// Bounding boxes of the vertices in each cell of a coarse grid. Their images under an affine map bound the image of the mesh
    /// tightly.
    pub fn boxes(&self) -> Vec<Bounds> {
        const CELLS: usize = 4;
        let all = Bounds::of_points(self.vertices.iter().copied());
        let size = all.size();
        let mut boxes = vec![Bounds::EMPTY; CELLS * CELLS * CELLS];
        for vertex in &self.vertices {
            let cell = (0..3).fold(0, |cell, axis| {
                let place = (vertex[axis] - all.min[axis]) / size[axis] * CELLS as f32;
                cell * CELLS + (place as usize).min(CELLS - 1)
            });
            boxes[cell] = boxes[cell].union(&Bounds { min: *vertex, max: *vertex });
        }
        boxes.retain(|bounds| !bounds.is_empty());
        boxes
    }

    /// The image of the mesh under a map.
    pub fn transformed(&self, map: &DAffine3) -> Cow<'_, MeshData> {
        if *map == DAffine3::IDENTITY {
            return Cow::Borrowed(self);
        }
        let pose = Pose::new(map);
        Cow::Owned(MeshData {
            vertices: self.vertices.par_iter().map(|p| pose.point(p)).collect(),
            triangles: self.triangles.par_iter().map(|triangle| pose.triangle(*triangle)).collect(),
            normals: self.normals.par_iter().map(|n| pose.normal(n)).collect(),
            uvs: self.uvs.clone(),
            colours: self.colours.clone(),
            tangents: self.tangents.par_iter().map(|t| pose.tangent(t)).collect(),
        })
    }

    /// Whether a point lies inside a closed mesh, that is, whether a ray from it crosses the mesh an odd number of times.
    pub fn contains(&self, p: DVec3) -> bool {
        // No edge or corner of a mesh made by hand lies in this direction.
        let d = DVec3::new(0.577_215, 0.691_417, 0.432_294);
        let vertex = |id: u32| Vec3::from(self.vertices[id as usize]).as_dvec3() - p;
        let crosses = |triangle: &&[u32; 3]| {
            let [a, b, c] = triangle.map(vertex);
            let weights = DVec3::new(d.dot(b.cross(c)), d.dot(c.cross(a)), d.dot(a.cross(b)));
            let ahead = (a.dot(b.cross(c)) > 0.0) == (weights.element_sum() > 0.0);
            ahead && (weights.min_element() > 0.0 || weights.max_element() < 0.0)
        };
        self.triangles.iter().filter(crosses).count() % 2 == 1
    }
}

/// A map of the vertices and triangles of a mesh.
pub(super) struct Pose {
    map: DAffine3,
    covector: DMat3,
    pub is_mirrored: bool,
}

impl Pose {
    pub fn new(map: &DAffine3) -> Pose {
        let covector = map.matrix3.inverse().transpose();
        Pose { map: *map, covector, is_mirrored: map.matrix3.determinant() < 0.0 }
    }

    /// The vertices in the order in which the front stays the front, even if the map mirrors.
    pub fn triangle(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        if self.is_mirrored { [a, c, b] } else { [a, b, c] }
    }

    pub fn point(&self, p: &[f32; 3]) -> [f32; 3] {
        self.map.transform_point3(Vec3::from(*p).as_dvec3()).as_vec3().to_array()
    }

    /// A mirror turns the handedness round: it keeps the front, and with it the direction of the normal.
    pub fn tangent(&self, [x, y, z, w]: &[f32; 4]) -> [f32; 4] {
        let t = self.map.transform_vector3(Vec3::new(*x, *y, *z).as_dvec3()).as_vec3();
        t.extend(if self.is_mirrored { -w } else { *w }).to_array()
    }

    pub fn normal(&self, n: &[f32; 3]) -> [f32; 3] {
        (self.covector * Vec3::from(*n).as_dvec3()).normalize_or_zero().as_vec3().to_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distant_vertices_have_separate_boxes() {
        let vertices = vec![[-4.0, 1.0, 2.0], [-4.0, 1.25, 2.0], [4.0, 9.0, 6.0], [4.0, 9.0, 5.5]];
        let data = MeshData { vertices, triangles: vec![[0, 1, 2], [1, 2, 3]], ..MeshData::default() };
        let boxes = data.boxes();
        let found: Vec<_> = boxes.iter().map(|bounds| (bounds.min, bounds.max)).collect();
        assert_eq!(found, [([-4.0, 1.0, 2.0], [-4.0, 1.25, 2.0]), ([4.0, 9.0, 5.5], [4.0, 9.0, 6.0])]);
    }
}
