//! Triangles and vertices of a mesh where it stands.
use std::sync::Arc;

use glam::DAffine3;
use rayon::prelude::*;

use super::{MeshData, data::Pose};
use noisefall_base::math::{F, Lanes, MAX_LANES, U};

/// The image of mesh data under a map. It shares with the data what the map leaves as it is.
pub(super) struct Vertices {
    data: Arc<MeshData>,
    /// Positions, normals and tangents, if the map moves them.
    moved: Option<Moved>,
    /// Triangles, if they are not all those of the data, or turned.
    triangles: Option<Vec<[u32; 3]>>,
}

struct Moved {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    tangents: Vec<[f32; 4]>,
}

impl Vertices {
    pub fn new(data: &Arc<MeshData>, map: &DAffine3) -> Vertices {
        let pose = Pose::new(map);
        let moved = (*map != DAffine3::IDENTITY).then(|| Moved {
            positions: data.vertices.par_iter().map(|p| pose.point(p)).collect(),
            normals: data.normals.par_iter().map(|n| pose.normal(n)).collect(),
            tangents: data.tangents.par_iter().map(|t| pose.tangent(t)).collect(),
        });
        let turn = |triangle| pose.triangle(triangle);
        let triangles = pose.is_mirrored.then(|| data.triangles.par_iter().copied().map(turn).collect());
        Vertices { data: data.clone(), moved, triangles }
    }

    /// Drops the triangles that are not `kept`, by their numbers and corners. The others get new numbers in the same order.
    pub fn retain_triangles(&mut self, kept: impl Fn(usize, [[f32; 3]; 3]) -> bool + Sync) {
        let is_kept = |(number, triangle): (usize, &[u32; 3])| kept(number, self.corners(*triangle));
        // Almost all meshes keep all triangles.
        if !self.triangles().par_iter().enumerate().all(is_kept) {
            let numbered = self.triangles().iter().enumerate();
            self.triangles = Some(numbered.filter(|numbered| is_kept(*numbered)).map(|(_, triangle)| *triangle).collect());
        }
    }

    pub fn positions(&self) -> &[[f32; 3]] {
        self.moved.as_ref().map_or(&self.data.vertices, |moved| &moved.positions)
    }

    /// Normals of any length; may be empty.
    pub fn normals(&self) -> &[[f32; 3]] {
        self.moved.as_ref().map_or(&self.data.normals, |moved| &moved.normals)
    }

    /// Tangents and their handedness; may be empty.
    pub fn tangents(&self) -> &[[f32; 4]] {
        self.moved.as_ref().map_or(&self.data.tangents, |moved| &moved.tangents)
    }

    /// Texture coordinates; may be empty.
    pub fn uvs(&self) -> &[[f32; 2]] {
        &self.data.uvs
    }

    /// Colour and opacity; may be empty.
    pub fn colours(&self) -> &[[f32; 4]] {
        &self.data.colours
    }

    /// The vertices of the triangles, counter-clockwise seen from the front.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.triangles.as_ref().unwrap_or(&self.data.triangles)
    }

    /// The positions of the vertices of a triangle.
    #[inline]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f32; 3]; 3] {
        let positions = self.positions();
        let [a, b, c] = triangle;
        [positions[a as usize], positions[b as usize], positions[c as usize]]
    }
}

/// The rows of a table for the vertices of `triangles[triangle]`: by vertex, then column. Columns that the table does not have
/// contain any value.
#[inline(always)]
pub(super) fn rows<L: Lanes, const COLUMNS: usize>(
    l: L,
    triangles: &[[u32; 3]],
    triangle: U<L>,
    table: &[[f32; COLUMNS]],
) -> [[F<L>; 4]; 3] {
    let triangle = triangle.to_array();
    let mut rows = [[[0.0; 4]; MAX_LANES]; 3];
    for lane in 0..L::N {
        let [a, b, c] = triangles[triangle[lane] as usize];
        rows[0][lane] = row(table, a);
        rows[1][lane] = row(table, b);
        rows[2][lane] = row(table, c);
    }
    [l.transposed(&rows[0]), l.transposed(&rows[1]), l.transposed(&rows[2])]
}

/// A row of a table, and what follows it: four numbers are loaded at once.
#[inline(always)]
fn row<const COLUMNS: usize>(table: &[[f32; COLUMNS]], vertex: u32) -> [f32; 4] {
    let flat: &[f32] = bytemuck::cast_slice(table);
    let first = vertex as usize * COLUMNS;
    match flat.get(first..first + 4) {
        Some(row) => [row[0], row[1], row[2], row[3]],
        None => {
            let mut row = [0.0; 4];
            row[..COLUMNS].copy_from_slice(&table[vertex as usize]);
            row
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use noisefall_base::math::One;

    fn tetrahedron() -> Arc<MeshData> {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 4.0]];
        let uvs = vec![[0.0, 0.5], [0.25, 1.0], [0.5, 0.0], [0.75, 0.125]];
        Arc::new(MeshData { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], uvs, ..MeshData::default() })
    }

    #[test]
    fn a_mesh_that_is_not_moved_shares_its_vertices_and_a_mirrored_one_keeps_its_front() {
        let data = tetrahedron();
        let mut here = Vertices::new(&data, &DAffine3::IDENTITY);
        assert_eq!(here.positions().as_ptr(), data.vertices.as_ptr());
        here.retain_triangles(|_, _| true);
        assert_eq!(here.triangles().as_ptr(), data.triangles.as_ptr());
        let mirrored = Vertices::new(&data, &DAffine3::from_scale(DVec3::new(1.0, 1.0, -2.0)));
        assert_eq!(mirrored.corners(mirrored.triangles()[1]), [[0.0, 0.0, 0.0], [0.0, 0.0, -8.0], [0.0, 2.0, 0.0]]);
        assert_eq!(mirrored.uvs().as_ptr(), data.uvs.as_ptr());
    }

    #[test]
    fn rows_end_with_the_last_vertex() {
        let data = tetrahedron();
        let [a, b, c] = rows(One, &data.triangles, U(1), &data.uvs);
        assert_eq!([a, b, c].map(|[u, v, ..]| [u.0, v.0]), [[0.0, 0.5], [0.5, 0.0], [0.75, 0.125]]);
        let [.., [x, y, z, _]] = rows(One, &data.triangles, U(1), &data.vertices);
        assert_eq!([x.0, y.0, z.0], [0.0, 0.0, 4.0]);
    }
}
