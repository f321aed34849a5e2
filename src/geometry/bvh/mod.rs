//! A tree of boxes over boxes, eight children a node: finds the few things a ray could meet among many.
//!
//! | part | file |
//! |---|---|
//! | building, by the surface area heuristic | `build.rs`, `bins.rs`, `collapse.rs` |
//! | the ray against eight boxes at once, conservatively | `slabs.rs` |
//! | descending, near boxes first | `traverse.rs` |
//!
//! What a leaf holds is the caller's: triangles of a mesh or objects of a scene. Leaves are numbered 0, 1, 2, …, and the tree
//! says which of the caller's items each holds ([`Bvh::build`]).
mod bins;
mod build;
mod collapse;
mod slabs;
#[cfg(test)]
mod tests;
mod traverse;

pub use self::{
    build::NONE,
    slabs::Slabs,
    traverse::{Leaves, Stack, traverse},
};
use super::bounds::Bounds;

/// Children of a node.
const WIDTH: usize = 8;

/// Set in the reference to a child that is a leaf; the other bits number leaves or nodes.
const LEAF: u32 = 1 << 31;

/// Eight boxes and what is in them. A place that is not used has the empty box, which no ray meets.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Node {
    /// By axis, then minima and maxima.
    bounds: [[[f32; WIDTH]; 2]; 3],
    children: [u32; WIDTH],
}

impl Node {
    const EMPTY: Node = Node { bounds: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3], children: [LEAF; WIDTH] };

    /// A word of each cache line.
    #[inline(always)]
    fn touch(&self) -> u32 {
        let [[x, _], [y, _], [z, _]] = &self.bounds;
        x[0].to_bits() | y[0].to_bits() | z[0].to_bits() | self.children[0]
    }
}

/// A tree of boxes.
pub struct Bvh {
    /// The root first.
    nodes: Vec<Node>,
    bounds: Bounds,
}

impl Bvh {
    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<Node>()
    }
}
