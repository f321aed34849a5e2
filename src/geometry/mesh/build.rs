//! Builds a mesh: its tables, its tree and the blocks of its leaves.
use std::borrow::Cow;

use glam::DAffine3;
use rayon::prelude::*;

use super::{
    Mesh, MeshData,
    block::{Block, SIZE},
    data::Posed,
    edges::scaled_area_squared,
    ids,
    pieces::{Piece, Pieces, pieces},
    position,
    slots::Slots,
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
        Mesh::build(data, &DAffine3::IDENTITY, &Progress::default()).expect("nobody cancels")
    }

    /// Builds the image of a mesh under a map. Drops degenerate triangles, and those with coordinates that are not finite or beyond
    /// 10¹¹. Of triangles in one place with the same vertices, it has the first. Progress counts triangles.
    pub fn build(data: &MeshData, map: &DAffine3, progress: &Progress) -> Result<Mesh, Cancelled> {
        let rows = Rows { data, posed: data.posed(map) };
        let (vertices, all) = (rows.vertices(), rows.posed.triangles());
        let corners = |[a, b, c]: [u32; 3]| [position(&vertices, a), position(&vertices, b), position(&vertices, c)];
        let is_kept = |triangle: &[u32; 3]| has_area(corners(*triangle));
        // Almost all meshes keep all triangles.
        let kept: Cow<[[u32; 3]]> = match all.par_iter().all(is_kept) {
            true => all,
            false => all.iter().copied().filter(is_kept).collect(),
        };
        let of_triangle = |number: usize| corners(kept[number]);
        let (pieces, room_for_pieces) = match pieces(kept.len(), of_triangle) {
            Some(Pieces { pieces, memory }) => (Some(pieces), Some(memory)),
            None => (None, None),
        };
        let (bvh, order) = tree(kept.len(), &of_triangle, pieces.as_deref(), progress)?;
        let slots = Slots::new(&order, &kept, pieces.as_deref());
        drop((order, pieces));
        progress.check()?;
        let block = |leaf: usize| {
            let (first, members) = slots.leaf(leaf);
            let mut triangles = [[[0.0; 3]; 3]; SIZE];
            let count = members.len();
            triangles.iter_mut().zip(members).for_each(|(triangle, row)| *triangle = corners(ids(row)));
            Block::new(&triangles[..count], first)
        };
        let blocks = (0..slots.leaves()).into_par_iter().map(block).collect();
        let Slots { triangles, triangle_of, .. } = slots;
        let normals = rows.normals();
        let (is_smooth, has_uvs) = (!data.normals.is_empty(), !data.uvs.is_empty());
        let dropped = data.triangles.len() - kept.len();
        Ok(Mesh {
            bvh,
            blocks,
            triangle_of,
            triangles,
            vertices,
            normals,
            colours: data.colours.clone(),
            is_smooth,
            has_uvs,
            dropped,
            _room_for_pieces: room_for_pieces,
        })
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

/// The table of vertices, and that of normals.
struct Rows<'a> {
    data: &'a MeshData,
    posed: Posed<'a>,
}

impl Rows<'_> {
    fn vertices(&self) -> Vec<[f32; 4]> {
        let row = |(vertex, p): (usize, &[f32; 3])| with(self.posed.point(p), self.uv(vertex)[0]);
        self.data.vertices.par_iter().enumerate().map(row).collect()
    }

    fn normals(&self) -> Vec<[f32; 4]> {
        let count = self.data.normals.len().max(self.data.uvs.len());
        let normal = |vertex: usize| self.data.normals.get(vertex).map_or([0.0; 3], |normal| self.posed.normal(normal));
        (0..count).into_par_iter().map(|vertex| with(normal(vertex), self.uv(vertex)[1])).collect()
    }

    fn uv(&self, vertex: usize) -> [f32; 2] {
        self.data.uvs.get(vertex).copied().unwrap_or_default()
    }
}

fn with([x, y, z]: [f32; 3], w: f32) -> [f32; 4] {
    [x, y, z, w]
}

/// Whether the triangle has a normal in f32, and coordinates within the limit.
fn has_area(corners: [[f32; 3]; 3]) -> bool {
    let fine = corners.as_flattened().iter().all(|x| x.abs() <= LARGEST);
    let [a, b, c] = corners.map(|corner| V::splat(One, corner));
    let area_squared = scaled_area_squared(a, b, c).0;
    fine && area_squared > 0.0 && area_squared.is_finite()
}
