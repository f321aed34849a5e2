//! Triangle meshes.
//!
//! | part | file |
//! |---|---|
//! | a ray against several triangles at once | `shear.rs` |
//! | the triangles of leaves | `leaves.rs` |
//! | construction | `build.rs` |
//! | what leaves hold: triangles, pairs or pieces | `items.rs` |
//! | pairs of triangles with a common edge | `pairs.rs` |
//! | pieces of long triangles | `pieces.rs` |
//! | the surface point at a hit | `surface.rs` |
//! | coordinates, smooth normals and colours there | `shading.rs` |
//! | directions towards one that emits | `toward.rs` |
//! | vertices and triangles, as a scene describes them | `data.rs` |
//! | the same where the mesh stands | `vertices.rs` |
//! | procedural meshes | `generate.rs` |
mod build;
mod data;
mod edges;
pub mod generate;
mod items;
mod leaves;
mod pairs;
mod pieces;
mod shading;
mod shear;
mod surface;
#[cfg(test)]
mod tests;
mod toward;
mod vertices;

use std::hint::cold_path;

use fearless_simd::Simd;
use fearless_simd_macros::simd;

pub use self::{data::MeshData, surface::MeshPoint};
use self::{
    leaves::{Filled, Leaf, TriangleLeaves},
    shear::{SIZE, Shears},
    vertices::{Vertices, rows},
};
use super::{
    bounds::Bounds,
    bvh::{Bvh, Leaves, NONE, Search, Searches, Slabs, Stacks, traverse},
};
use noisefall_base::{
    math::{F, Lanes, MAX_LANES, U, V},
    memory::Reservation,
};

/// A triangle mesh with its tree. A triangle's front is the side from which its vertices run counter-clockwise.
pub struct Mesh {
    bvh: Bvh,
    leaves: TriangleLeaves,
    vertices: Vertices,
    dropped: usize,
    _room_for_pieces: Option<Reservation>,
}

/// The slots of the nearest triangles so far; tests leaves for nearer ones.
struct NearestTriangles<'a, C> {
    leaves: &'a [C],
    rays: &'a Shears,
    slots: [u32; MAX_LANES],
}

impl<S: Simd, C: Leaf> Leaves<S> for NearestTriangles<'_, C> {
    #[inline(always)]
    fn meet(&mut self, s: S, lane: usize, leaf: u32, mut t_max: f32) -> f32 {
        let ray = self.rays.lane(lane);
        let sheared = self.leaves[leaf as usize].sheared(s, &ray);
        let mut candidates = sheared.candidates(s);
        while candidates != 0 {
            let place = candidates.trailing_zeros();
            candidates &= candidates - 1;
            let t = sheared.distance(place as usize, &ray);
            // The compiler keeps this branch, so that the processor goes on with what it predicts and does not wait for the distance.
            if !(t > 0.0 && t < t_max) {
                cold_path();
                continue;
            }
            t_max = t;
            self.slots[lane] = leaf * SIZE as u32 + place;
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

    /// The first triangle within the limit of a search. Boxes and triangles are tested with the instructions of `s`, for any lanes.
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
        let triangles = match &self.leaves {
            TriangleLeaves::Apart(filled) => self.nearest(s, stacks, (&rays, &mut searches), filled),
            TriangleLeaves::Shared(filled) => self.nearest(s, stacks, (&rays, &mut searches), filled),
        };
        (l.load(&searches.t_max), l.load(bytemuck::cast_slice(&triangles)).bits())
    }

    /// The nearest triangles, by lane.
    #[inline(always)]
    fn nearest<S: Simd, L: Lanes, C: Leaf, const COUNTS: bool>(
        &self,
        s: S,
        stacks: &mut Stacks<COUNTS>,
        (rays, searches): (&Rays, &mut Searches<L>),
        filled: &Filled<C>,
    ) -> [u32; MAX_LANES] {
        let mut nearest = NearestTriangles { leaves: &filled.leaves, rays: &rays.shears, slots: [NONE; MAX_LANES] };
        traverse(s, &self.bvh, stacks, (&rays.slabs, searches), &mut nearest);
        for slot in &mut nearest.slots[..L::N] {
            *slot = filled.triangle(*slot);
        }
        nearest.slots
    }

    /// The vertices of a triangle.
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.vertices.corners(self.vertices.triangles()[triangle as usize])
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }

    /// Number of triangles. They are numbered in the order of the data, without dropped ones.
    pub fn len(&self) -> usize {
        self.vertices.triangles().len()
    }

    /// Whether there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.vertices.triangles().is_empty()
    }

    /// Whether it has interpolated normals.
    pub fn is_smooth(&self) -> bool {
        !self.vertices.normals().is_empty()
    }

    /// Whether vertices have tangents.
    pub fn has_tangents(&self) -> bool {
        !self.vertices.tangents().is_empty()
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
        rows(l, self.vertices.triangles(), triangle, table)
    }
}
