//! Triangle meshes.
//!
//! | part | file |
//! |---|---|
//! | a ray against several triangles at once | `block.rs` |
//! | construction | `build.rs` |
//! | the surface point at a hit | `surface.rs` |
//! | pieces of long triangles | `pieces.rs` |
//! | the order of triangles in leaves | `slots.rs` |
//! | coordinates, smooth normals and colours there | `shading.rs` |
//! | directions towards one that emits | `toward.rs` |
//! | vertices and triangles, as a scene describes them | `data.rs` |
//! | the same where the mesh stands | `vertices.rs` |
//! | procedural meshes | `generate.rs` |
mod block;
mod build;
mod data;
mod edges;
pub mod generate;
mod pieces;
mod shading;
mod slots;
mod surface;
#[cfg(test)]
mod tests;
mod toward;
mod vertices;

use fearless_simd::Simd;
use fearless_simd_macros::simd;

use self::{
    block::{Block, Shears},
    vertices::{Vertices, rows},
};
pub use self::{data::MeshData, surface::MeshPoint};
use super::{
    bounds::Bounds,
    bvh::{Bvh, Leaves, NONE, Search, Searches, Slabs, Stacks, traverse},
};
use crate::{
    math::{F, Lanes, MAX_LANES, U, V},
    memory::Reservation,
};

/// A triangle mesh with its tree. A triangle's front is the side from which its vertices run counter-clockwise.
pub struct Mesh {
    bvh: Bvh,
    blocks: Vec<Block>,
    /// The vertices of the triangles, in the order of the leaves.
    triangles: Vec<[u32; 3]>,
    /// The triangle in each slot of the blocks; empty if it is the slot itself.
    triangle_of: Vec<u32>,
    vertices: Vertices,
    dropped: usize,
    _room_for_pieces: Option<Reservation>,
}

/// The slots of the nearest triangles so far; tests leaves for nearer ones.
struct NearestTriangles<'a> {
    blocks: &'a [Block],
    rays: &'a Shears,
    slots: [u32; MAX_LANES],
}

impl<S: Simd> Leaves<S> for NearestTriangles<'_> {
    #[inline(always)]
    fn meet(&mut self, s: S, lane: usize, leaf: u32, mut t_max: f32) -> f32 {
        let (block, ray) = (&self.blocks[leaf as usize], self.rays.lane(lane));
        let sheared = block.sheared(s, &ray);
        let mut candidates = sheared.candidates(s);
        while candidates != 0 {
            let place = candidates.trailing_zeros();
            candidates &= candidates - 1;
            let t = sheared.distance(place as usize, &ray);
            let nearer = (t > 0.0) & (t < t_max);
            t_max = if nearer { t } else { t_max };
            self.slots[lane] = if nearer { block.first + place } else { self.slots[lane] };
        }
        t_max
    }
}

/// Rays of several lanes, prepared for boxes and triangles.
struct Rays {
    slabs: Slabs,
    shears: Shears,
}

impl Rays {
    /// Prepares rays o + td towards the contents of `bounds`.
    #[inline(always)]
    fn new<L: Lanes>(l: L, o: V<L>, d: V<L>, bounds: &Bounds) -> Rays {
        Rays { slabs: Slabs::new(l, o, d, bounds), shears: Shears::new(l, o, d) }
    }
}

impl Mesh {
    /// The first triangle along o + td with 0 < t < `t_max`: t, or `t_max` if there is none, and the triangle's number or `NONE`.
    /// Both sides count. d need not be of unit length. Lanes with a `t_max` of 0 cost almost nothing.
    #[inline(always)]
    pub fn closest<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, t_max: F<L>) -> (F<L>, U<L>) {
        self.closest_by(l.token(), l, &mut Stacks::<false>::default(), (o, d), Search::nearest(l, t_max))
    }

    /// The same within the limit of a search; boxes and triangles are tested with the instructions of `s`, for any lanes.
    #[simd]
    pub fn closest_by<S: Simd, L: Lanes, const COUNTS: bool>(
        &self,
        s: S,
        l: L,
        stacks: &mut Stacks<COUNTS>,
        (o, d): (V<L>, V<L>),
        search: Search<L>,
    ) -> (F<L>, U<L>) {
        let rays = Rays::new(l, o, d, &self.bounds());
        let mut searches = Searches::new(search.limit.above(0.0), search);
        let mut nearest = NearestTriangles { blocks: &self.blocks, rays: &rays.shears, slots: [NONE; MAX_LANES] };
        traverse(s, &self.bvh, stacks, (&rays.slabs, &mut searches), &mut nearest);
        let mut triangles = nearest.slots;
        if !self.triangle_of.is_empty() {
            for slot in &mut triangles[..L::N] {
                *slot = self.triangle_of.get(*slot as usize).copied().unwrap_or(NONE);
            }
        }
        (l.load(&searches.t_max), l.load(bytemuck::cast_slice(&triangles)).bits())
    }

    /// The vertices of a triangle.
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.vertices.corners(self.triangles[triangle as usize])
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }

    /// Number of triangles, which are numbered 0, 1, … in the mesh's own order.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Whether it has interpolated normals.
    pub fn is_smooth(&self) -> bool {
        !self.vertices.normals().is_empty()
    }

    /// Whether vertices have texture coordinates.
    pub fn has_uvs(&self) -> bool {
        !self.vertices.uvs().is_empty()
    }

    /// Number of dropped triangles.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// See [`rows`].
    #[inline(always)]
    fn rows<L: Lanes, const COLUMNS: usize>(&self, l: L, triangle: U<L>, table: &[[f32; COLUMNS]]) -> [[F<L>; 4]; 3] {
        rows(l, &self.triangles, triangle, table)
    }
}
