//! Collapses a binary tree to one with eight children per node, at the lowest cost.
//!
//! The cost of a node is its area, and that of a leaf its area times [`LEAF_COST`], because the area is proportional to the
//! probability of a hit. The cheapest forest of up to k trees under a branch follows from those under its two sides: C(k) = min
//! over i of C_left(i) + C_right(k − i), or one tree, a node over the cheapest eight. (Dynamic programming after H. Ylitalo et
//! al., "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", HPG 2017.) The usual method, splitting the
//! largest children until there are eight, leaves half of the slots empty, mostly at the bottom, where most nodes are.
use super::{
    LEAF, Node, WIDTH,
    bins::Extent,
    item::{Item, NONE},
};

/// Cost of a leaf relative to a node.
const LEAF_COST: f32 = 1.0;

/// The cheapest forests under a branch; entry k − 1 is for up to k trees.
#[derive(Clone, Copy)]
pub(super) struct Forest {
    sides: [u32; 2],
    costs: [f32; WIDTH],
    /// Number of trees of each side; [0, 0] if the branch stays one tree.
    shares: [[u8; 2]; WIDTH],
    /// Number of the eight children of each side, if the branch is a node.
    children: [u8; 2],
}

/// A box of the binary tree.
#[derive(Clone, Copy)]
pub(super) struct Branch {
    bounds: Extent,
    first: u32,
    count: u32,
    /// For a leaf, only costs.
    pub forest: Forest,
}

impl Branch {
    pub fn leaf(bounds: Extent, first: u32, count: u32) -> Branch {
        let costs = [bounds.half_area() * LEAF_COST; WIDTH];
        let forest = Forest { sides: [0; 2], costs, shares: [[0; 2]; WIDTH], children: [0; 2] };
        Branch { bounds, first, count, forest }
    }
}

impl Forest {
    /// Combines two finished branches.
    pub fn over(bounds: &Extent, sides: [u32; 2], branches: &[Branch]) -> Forest {
        let [left, right] = sides.map(|side| &branches[side as usize].forest.costs);
        let (mut costs, mut shares) = ([f32::INFINITY; WIDTH], [[0; 2]; WIDTH]);
        for trees in 2..=WIDTH {
            for share in 1..trees {
                let cost = left[share - 1] + right[trees - share - 1];
                // The first is taken even if areas overflow.
                if share == 1 || cost < costs[trees - 1] {
                    costs[trees - 1] = cost;
                    shares[trees - 1] = [share as u8, (trees - share) as u8];
                }
            }
        }
        let children = shares[WIDTH - 1];
        costs[0] = bounds.half_area() + costs[WIDTH - 1];
        for trees in 1..WIDTH {
            if costs[trees] >= costs[trees - 1] {
                costs[trees] = costs[trees - 1];
                shares[trees] = shares[trees - 1];
            }
        }
        Forest { sides, costs, shares, children }
    }
}

/// The wide tree during construction.
pub(super) struct Collapse<'a> {
    branches: &'a [Branch],
    items: &'a [Item],
    leaf_size: usize,
    nodes: Vec<Node>,
    order: Vec<u32>,
}

/// Indices of the branches that become the children of a node.
struct Children {
    places: [u32; WIDTH],
    count: usize,
}

impl Collapse<'_> {
    /// Returns the nodes, with the root first (none if there are no items), and the numbers of the items in leaves.
    pub fn of(branches: &[Branch], items: &[Item], leaf_size: usize) -> (Vec<Node>, Vec<u32>) {
        let mut collapse = Collapse { branches, items, leaf_size, nodes: Vec::new(), order: Vec::new() };
        let mut children = Children { places: [0; WIDTH], count: 0 };
        let root = &branches[0];
        if root.count as usize > leaf_size {
            collapse.gather(root.forest.sides, root.forest.children, &mut children);
        } else {
            children.count = 1;
        }
        if root.count > 0 {
            collapse.node(&children);
        }
        (collapse.nodes, collapse.order)
    }

    /// Appends `shares` trees from both sides of a branch.
    fn gather(&self, sides: [u32; 2], shares: [u8; 2], into: &mut Children) {
        for (side, share) in sides.into_iter().zip(shares) {
            let forest = &self.branches[side as usize].forest;
            match forest.shares[share as usize - 1] {
                [0, 0] => {
                    into.places[into.count] = side;
                    into.count += 1;
                }
                shares => self.gather(forest.sides, shares, into),
            }
        }
    }

    /// Adds a node and its subtree, and returns its number.
    fn node(&mut self, children: &Children) -> u32 {
        let number = self.nodes.len();
        let mut node = Node::EMPTY;
        self.nodes.push(node);
        let branches = self.branches;
        let children = &children.places[..children.count];
        for (place, &child) in children.iter().enumerate() {
            let branch = &branches[child as usize];
            for axis in 0..3 {
                node.bounds[axis][0][place] = branch.bounds.min[axis];
                node.bounds[axis][1][place] = branch.bounds.max[axis];
            }
            if branch.count as usize <= self.leaf_size {
                node.children[place] = self.leaf(branch);
            }
        }
        for (place, &child) in children.iter().enumerate() {
            let branch = &branches[child as usize];
            if branch.count as usize > self.leaf_size {
                let mut below = Children { places: [0; WIDTH], count: 0 };
                self.gather(branch.forest.sides, branch.forest.children, &mut below);
                node.children[place] = self.node(&below);
            }
        }
        self.nodes[number] = node;
        number as u32
    }

    fn leaf(&mut self, branch: &Branch) -> u32 {
        let leaf = (self.order.len() / self.leaf_size) as u32;
        self.order.extend(self.items[branch.first as usize..][..branch.count as usize].iter().map(Item::number));
        self.order.resize((leaf as usize + 1) * self.leaf_size, NONE);
        LEAF | leaf
    }
}
