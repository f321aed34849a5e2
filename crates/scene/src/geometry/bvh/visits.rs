//! The work of rays in trees.
use std::ops::Add;

/// Work on the way of rays through trees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Visits {
    /// Nodes, each a test of eight boxes.
    pub nodes: u64,
    /// Leaves, each a test of up to eight triangles or of an object.
    pub leaves: u64,
}

impl Add for Visits {
    type Output = Visits;

    fn add(self, other: Visits) -> Visits {
        Visits { nodes: self.nodes + other.nodes, leaves: self.leaves + other.leaves }
    }
}
