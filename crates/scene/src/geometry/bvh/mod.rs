//! A bounding volume hierarchy with eight children per node: finds the few items that a ray may hit.
//!
//! | part | file |
//! |---|---|
//! | construction by the surface area heuristic | `build.rs`, `bins.rs`, `collapse.rs`, `item.rs` |
//! | conservative test of a ray against eight boxes at once | `slabs.rs` |
//! | traversal, near boxes first | `traverse.rs`, `stack.rs` |
//! | counts of nodes and leaves | `visits.rs` |
//!
//! The caller owns the contents of leaves: triangles of a mesh or objects of a scene. Leaves are numbered 0, 1, 2, …, and
//! [`Bvh::build`] returns the caller's items in each.
mod bins;
mod build;
mod collapse;
mod item;
mod slabs;
mod stack;
#[cfg(test)]
mod tests;
mod traverse;
mod visits;

pub use self::{
    item::NONE,
    slabs::Slabs,
    traverse::{Leaves, Search, Searches, Stacks, traverse},
    visits::Visits,
};
use super::bounds::Bounds;

/// Children of a node.
const WIDTH: usize = 8;

/// Marks references to leaves; the other bits are the number of the leaf or node.
const LEAF: u32 = 1 << 31;

/// Eight boxes with references to their contents. Unused slots have the empty box, which no ray hits.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Node {
    /// By axis, then by minimum and maximum.
    bounds: [[[f32; WIDTH]; 2]; 3],
    children: [u32; WIDTH],
}

impl Node {
    const EMPTY: Node = Node { bounds: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3], children: [LEAF; WIDTH] };
}

/// A tree of boxes.
pub struct Bvh {
    /// Nodes, with the root first.
    nodes: Vec<Node>,
    bounds: Bounds,
}

impl Bvh {
    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }
}
