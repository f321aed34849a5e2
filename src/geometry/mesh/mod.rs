//! Triangle meshes.
//!
//! | part | file |
//! |---|---|
//! | a ray against several triangles at once | `block.rs` |
//! | the surface point at a hit | `surface.rs` |
//! | coordinates, smooth normals and colours there | `shading.rs` |
//! | directions towards one that emits | `toward.rs` |
//! | vertices and triangles | `data.rs` |
//! | procedural meshes | `generate.rs` |
mod block;
mod data;
mod edges;
pub mod generate;
mod shading;
mod surface;
#[cfg(test)]
mod tests;
mod toward;

use std::{borrow::Cow, sync::Arc};

use fearless_simd::Simd;
use fearless_simd_macros::simd;
use glam::DAffine3;
use rayon::prelude::*;

use self::{
    block::{Block, Shear, Shears},
    data::Posed,
    edges::scaled_area_squared,
};
pub use self::{
    data::MeshData,
    surface::{Attributes, MeshPoint},
};
use super::{
    bounds::Bounds,
    bvh::{Bvh, Leaves, NONE, Search, Slabs, Stack, traverse},
};
use crate::{
    math::{F, Lanes, MAX_LANES, One, U, V},
    progress::{Cancelled, Progress},
};

/// Limit of coordinates: products of larger ones could overflow.
const LARGEST: f32 = 1e11;

/// A triangle mesh with its tree. A triangle's front is the side from which its vertices run counter-clockwise.
pub struct Mesh {
    bvh: Bvh,
    blocks: Vec<Block>,
    /// The vertices of the triangles as integers in bits, in the order of the leaves.
    triangles: Vec<[f32; 4]>,
    /// Position, then u.
    vertices: Vec<[f32; 4]>,
    /// Normal, then v. Empty if the mesh has neither.
    normals: Vec<[f32; 4]>,
    /// Colour and opacity of the vertices; may be empty.
    colours: Arc<Vec<[f32; 4]>>,
    is_smooth: bool,
    has_uvs: bool,
    dropped: usize,
}

/// The nearest intersection so far; tests leaves for nearer ones.
struct Nearest<'a> {
    blocks: &'a [Block],
    ray: Shear,
    triangle: u32,
}

impl<S: Simd> Leaves<S> for Nearest<'_> {
    #[inline(always)]
    fn meet(&mut self, s: S, leaf: u32, mut t_max: f32) -> f32 {
        let block = &self.blocks[leaf as usize];
        let sheared = block.sheared(s, &self.ray);
        let mut candidates = sheared.candidates(s);
        while candidates != 0 {
            let place = candidates.trailing_zeros();
            candidates &= candidates - 1;
            let t = sheared.distance(place as usize, &self.ray);
            let nearer = (t > 0.0) & (t < t_max);
            t_max = if nearer { t } else { t_max };
            self.triangle = if nearer { block.first + place } else { self.triangle };
        }
        t_max
    }

    #[inline(always)]
    fn touch(&self, leaf: u32) -> u32 {
        self.blocks[leaf as usize].touch()
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
    /// [`Mesh::build`] where it stands, without progress.
    #[cfg(test)]
    pub fn new(data: &MeshData) -> Mesh {
        Mesh::build(data, &DAffine3::IDENTITY, &Progress::default()).expect("nobody cancels")
    }

    /// Builds the image of a mesh under a map. Drops degenerate triangles, and those with coordinates that are not finite or beyond
    /// 10¹¹. Of triangles in one place with the same vertices, it has the first. Progress counts triangles.
    pub fn build(data: &MeshData, map: &DAffine3, progress: &Progress) -> Result<Mesh, Cancelled> {
        let (vertices, normals) = rows(data, &data.posed(map));
        let all = data.posed(map).triangles();
        let corners = |triangle: [u32; 3]| triangle.map(|vertex| position(&vertices, vertex));
        let is_kept = |triangle: &[u32; 3]| has_area(corners(*triangle));
        // Almost all meshes keep all triangles.
        let kept: Cow<[[u32; 3]]> = match all.par_iter().all(is_kept) {
            true => all,
            false => all.iter().copied().filter(is_kept).collect(),
        };
        let bounds = |number: usize| Bounds::of_points(corners(kept[number]));
        let bits = |number: u32| corners(kept[number as usize]).map(|corner| corner.map(f32::to_bits));
        let contents = |a: u32, b: u32| bits(a).cmp(&bits(b));
        let (bvh, order) = Bvh::build_watched::<{ block::SIZE }>(kept.len(), bounds, Some(&contents), progress)?;

        let mut triangles = Vec::with_capacity(kept.len());
        let mut first = Vec::with_capacity(order.len() / block::SIZE);
        for leaf in order.chunks_exact(block::SIZE) {
            first.push(triangles.len() as u32);
            let members = leaf.iter().filter(|&&number| number != NONE).map(|&number| kept[number as usize]);
            triangles.extend(members.map(|[a, b, c]| [a, b, c, 0].map(f32::from_bits)));
        }
        progress.check()?;
        drop(order);
        let block = |leaf: usize| {
            let end = first.get(leaf + 1).map_or(triangles.len(), |next| *next as usize);
            let mut members = [[[0.0; 3]; 3]; block::SIZE];
            let rows = &triangles[first[leaf] as usize..end];
            members.iter_mut().zip(rows).for_each(|(member, row)| *member = corners(ids(row)));
            Block::new(&members[..rows.len()], first[leaf])
        };
        let blocks = (0..first.len()).into_par_iter().map(block).collect();
        let (is_smooth, has_uvs) = (!data.normals.is_empty(), !data.uvs.is_empty());
        let dropped = data.triangles.len() - kept.len();
        Ok(Mesh { bvh, blocks, triangles, vertices, normals, colours: data.colours.clone(), is_smooth, has_uvs, dropped })
    }

    /// The first triangle along o + td with 0 < t < `t_max`: t, or `t_max` if there is none, and the triangle's number or `NONE`.
    /// Both sides count. d need not be of unit length. Lanes with a `t_max` of 0 cost almost nothing.
    #[inline(always)]
    pub fn closest<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, t_max: F<L>) -> (F<L>, U<L>) {
        self.closest_by(l, l.token(), &mut Stack::<false>::default(), (o, d), Search::nearest(l, t_max))
    }

    /// The same within the limit of a search; boxes and triangles are tested with the instructions of `s`, for any lanes.
    #[inline(always)]
    pub fn closest_by<L: Lanes, S: Simd, const COUNTS: bool>(
        &self,
        l: L,
        s: S,
        stack: &mut Stack<COUNTS>,
        (o, d): (V<L>, V<L>),
        search: Search<L>,
    ) -> (F<L>, U<L>) {
        let rays = Rays::new(l, o, d, &self.bounds());
        let (mut distances, enough) = (search.limit.to_array(), search.enough.to_array());
        let mut triangles = [0.0; MAX_LANES];
        for lane in 0..L::N {
            let (t, triangle) = self.closest_of(s, stack, &rays, lane, (distances[lane], enough[lane]));
            distances[lane] = t;
            triangles[lane] = f32::from_bits(triangle);
        }
        (l.load(&distances), l.load(&triangles).bits())
    }

    /// The same for the ray in one lane.
    #[simd]
    fn closest_of<S: Simd, const COUNTS: bool>(
        &self,
        s: S,
        stack: &mut Stack<COUNTS>,
        rays: &Rays,
        lane: usize,
        search: (f32, f32),
    ) -> (f32, u32) {
        let mut nearest = Nearest { blocks: &self.blocks, ray: rays.shears.lane(lane), triangle: NONE };
        let t = traverse(s, &self.bvh, stack, (&rays.slabs, lane), search, &mut nearest);
        (t, nearest.triangle)
    }

    /// The vertices of a triangle.
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        ids(&self.triangles[triangle as usize]).map(|vertex| position(&self.vertices, vertex))
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
        self.is_smooth
    }

    /// Whether vertices have texture coordinates.
    pub fn has_uvs(&self) -> bool {
        self.has_uvs
    }

    /// Number of dropped triangles.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        let rows = self.triangles.len() + self.vertices.len() + self.normals.len() + self.colours.len();
        self.bvh.bytes() + size_of_val(self.blocks.as_slice()) + rows * size_of::<[f32; 4]>()
    }
}

fn ids(row: &[f32; 4]) -> [u32; 3] {
    [row[0].to_bits(), row[1].to_bits(), row[2].to_bits()]
}

/// The position of a vertex.
fn position(vertices: &[[f32; 4]], vertex: u32) -> [f32; 3] {
    let [x, y, z, _] = vertices[vertex as usize];
    [x, y, z]
}

/// The tables of vertices and normals.
fn rows(data: &MeshData, posed: &Posed) -> (Vec<[f32; 4]>, Vec<[f32; 4]>) {
    let uv = |vertex: usize| data.uvs.get(vertex).copied().unwrap_or_default();
    let row = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w];
    let vertices = data.vertices.par_iter().enumerate().map(|(vertex, p)| row(posed.point(p), uv(vertex)[0])).collect();
    let count = data.normals.len().max(data.uvs.len());
    let normal = |vertex: usize| data.normals.get(vertex).map_or([0.0; 3], |normal| posed.normal(normal));
    let normals = (0..count).into_par_iter().map(|vertex| row(normal(vertex), uv(vertex)[1])).collect();
    (vertices, normals)
}

/// Whether the triangle has a normal in f32, and coordinates within the limit.
fn has_area(corners: [[f32; 3]; 3]) -> bool {
    let fine = corners.as_flattened().iter().all(|x| x.abs() <= LARGEST);
    let [a, b, c] = corners.map(|corner| V::splat(One, corner));
    let area_squared = scaled_area_squared(a, b, c).0;
    fine && area_squared > 0.0 && area_squared.is_finite()
}
