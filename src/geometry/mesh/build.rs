//! Builds a mesh: its tables, its tree and the blocks of its leaves.
use std::sync::Arc;

use glam::DAffine3;
use rayon::prelude::*;

use super::{
    Mesh, MeshData,
    block::{Block, SIZE},
    edges::scaled_area_squared,
    pieces::{Piece, Pieces, pieces},
    slots::Slots,
    vertices::Vertices,
};
use crate::{
    geometry::{bounds::Bounds, bvh::Bvh},
    math::{One, V},
    progress::{Cancelled, Progress, Stage},
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
    /// 10¹¹. Of triangles in one place with the same vertices, it has the first. Progress counts triangles.
    pub fn build(data: &Arc<MeshData>, map: &DAffine3, progress: &Progress) -> Result<Mesh, Cancelled> {
        let vertices = Vertices::new(data, map);
        let is_kept = |number: &u32| has_area(vertices.corners(vertices.triangle(*number)));
        let all = 0..vertices.triangle_count() as u32;
        // Almost all meshes keep all triangles.
        let kept: Option<Vec<u32>> = match all.clone().into_par_iter().all(|number| is_kept(&number)) {
            true => None,
            false => Some(all.clone().filter(is_kept).collect()),
        };
        let count = kept.as_ref().map_or(all.len(), Vec::len);
        let triangle = |item: u32| vertices.triangle(kept.as_ref().map_or(item, |kept| kept[item as usize]));
        let corners = |item: usize| vertices.corners(triangle(item as u32));
        let (pieces, room_for_pieces) = match pieces(count, corners) {
            Some(Pieces { pieces, memory }) => (Some(pieces), Some(memory)),
            None => (None, None),
        };
        let (bvh, order) = tree(count, &corners, pieces.as_deref(), progress)?;
        let slots = Slots::new(&order, count, pieces.as_deref(), triangle);
        drop((order, pieces));
        progress.check()?;
        let block = |leaf: usize| {
            let (first, members) = slots.leaf(leaf);
            Block::new(members.map(|triangle| vertices.corners(triangle)), first)
        };
        let blocks = (0..slots.leaves()).into_par_iter().map(block).collect();
        let Slots { triangles, triangle_of, .. } = slots;
        let dropped = all.len() - count;
        Ok(Mesh { bvh, blocks, triangles, triangle_of, vertices, dropped, _room_for_pieces: room_for_pieces })
    }
}

/// The tree over triangles, or over their pieces, and the order of the leaves.
fn tree(
    count: usize,
    corners: &(impl Fn(usize) -> [[f32; 3]; 3] + Sync),
    pieces: Option<&[Piece]>,
    progress: &Progress,
) -> Result<(Bvh, Vec<u32>), Cancelled> {
    let bits = |triangle: u32| corners(triangle as usize).map(|corner| corner.map(f32::to_bits));
    let contents = |a: u32, b: u32| bits(a).cmp(&bits(b));
    let Some(pieces) = pieces else {
        let bounds = |triangle: usize| Bounds::of_points(corners(triangle));
        return Bvh::build_watched::<{ SIZE }>(count, bounds, Some(&contents), progress);
    };
    progress.expect(Stage::Trees, (pieces.len() - count) as u64);
    let contents = |a: u32, b: u32| contents(pieces[a as usize].triangle, pieces[b as usize].triangle);
    Bvh::build_watched::<{ SIZE }>(pieces.len(), |piece| pieces[piece].bounds, Some(&contents), progress)
}

/// Whether the triangle has a normal in f32, and coordinates within the limit.
fn has_area(corners: [[f32; 3]; 3]) -> bool {
    let fine = corners.as_flattened().iter().all(|x| x.abs() <= LARGEST);
    let [a, b, c] = corners.map(|corner| V::splat(One, corner));
    let area_squared = scaled_area_squared(a, b, c).0;
    fine && area_squared > 0.0 && area_squared.is_finite()
}
