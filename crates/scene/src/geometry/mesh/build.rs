//! Builds a mesh: its vertices, its tree and its leaves.
use std::sync::Arc;

use glam::DAffine3;

use super::{Mesh, MeshData, edges::scaled_area_squared, items::Items, pieces::Pieces, vertices::Vertices};
use noisefall_base::{
    math::{One, V},
    progress::{Cancelled, Progress},
};

/// Limit of coordinates: products of larger ones could overflow.
const LARGEST: f32 = 1e11;

impl Mesh {
    /// [`Mesh::build`] where it stands, without progress.
    #[cfg(test)]
    pub fn new(data: &MeshData) -> Mesh {
        Mesh::build(&Arc::new(data.clone()), &DAffine3::IDENTITY, &Progress::default()).expect("nobody cancels")
    }

    /// Builds the image of a mesh under a map. Drops degenerate triangles, and those with coordinates that are not finite or beyond
    /// 10¹¹. Of many triangles in one place with the same vertices, it has the first. Progress counts triangles.
    pub fn build(data: &Arc<MeshData>, map: &DAffine3, progress: &Progress) -> Result<Mesh, Cancelled> {
        let mut vertices = Vertices::new(data, map);
        vertices.retain_triangles(|_, corners| has_area(corners));
        let dropped = data.triangles.len() - vertices.triangles().len();
        loop {
            let corners = |triangle: u32| vertices.corners(vertices.triangles()[triangle as usize]);
            let count = vertices.triangles().len();
            let items = Items::of(count, corners);
            let (bvh, order) = items.tree(count, corners, progress)?;
            progress.check()?;
            // Without copies, each of which would be a light that no ray reaches.
            if let Some(present) = items.present(count, &order) {
                vertices.retain_triangles(|triangle, _| present[triangle]);
                continue;
            }
            let leaves = items.leaves(&order, corners);
            let room_for_pieces = if let Items::Pieces(Pieces { memory, .. }) = items { Some(memory) } else { None };
            return Ok(Mesh { bvh, leaves, dropped, vertices, _room_for_pieces: room_for_pieces });
        }
    }
}

/// Whether the triangle has a normal in f32, and coordinates within the limit.
fn has_area(corners: [[f32; 3]; 3]) -> bool {
    let fine = corners.as_flattened().iter().all(|x| x.abs() <= LARGEST);
    let [a, b, c] = corners.map(|corner| V::splat(One, corner));
    let area_squared = scaled_area_squared(a, b, c).0;
    fine && area_squared > 0.0 && area_squared.is_finite()
}
