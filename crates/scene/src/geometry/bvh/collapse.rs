//! Collapses a binary tree to one with eight children per node, at the lowest cost.
//!
//! The cost of a node is its area, and that of a leaf its area times [`LEAF_COST`], because the area is proportional to the
//! probability of a hit. The cheapest forest of up to k trees under a branch follows from those under its two sides: C(k) = min
//! over i of C_left(i) + C_right(k − i), or one tree, a node over the cheapest eight. (Dynamic programming after H. Ylitie et
//! al., "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", HPG 2017.) The usual method, splitting the
//! largest children until there are eight, leaves half of the slots empty, mostly at the bottom, where most nodes are.
use super::{LEAF, Node, WIDTH, bins::Aabb, item::NONE};

/// Cost of a leaf relative to a node.
const LEAF_COST: f32 = 1.0;

/// The costs of the cheapest forests under a branch; entry k − 1 is for up to k trees.
pub(super) type Costs = [f32; WIDTH];

/// A box of the binary tree, in an order in which the left side of a branch follows it.
#[derive(Clone, Copy)]
pub(super) struct Branch {
    min: [f32; 3],
    max: [f32; 3],
    /// The first item of a leaf; elsewhere, the distance in branches to the right side.
    link: u32,
    /// The number of items of a leaf; 0 elsewhere.
    count: u32,
    /// Entry k − 1 has the shares of both sides in the cheapest forest of up to k trees; 0 if that is one tree. One tree is never
    /// divided: entry 0 has the children of each side, if the branch is a node.
    shares: [Shares; WIDTH],
}

/// The numbers of trees of both sides, each up to 7, in half a byte.
#[derive(Clone, Copy, Default)]
struct Shares(u8);

impl Shares {
    fn new(left: usize, right: usize) -> Shares {
        Shares((left << 4 | right) as u8)
    }

    fn sides(self) -> [usize; 2] {
        [self.0 >> 4, self.0 & 15].map(usize::from)
    }
}

impl Branch {
    /// A leaf, with the costs of its forests.
    pub fn leaf(bounds: &Aabb, first: usize, count: usize) -> (Branch, Costs) {
        let branch = Branch { link: first as u32, count: count as u32, ..Branch::around(bounds) };
        (branch, [bounds.half_area() * LEAF_COST; WIDTH])
    }

    /// A branch over two sides with these costs, the right one of which is `right` branches further, with its own costs.
    pub fn over(bounds: &Aabb, right: usize, [left_costs, right_costs]: &[Costs; 2]) -> (Branch, Costs) {
        let (mut costs, mut shares) = ([f32::INFINITY; WIDTH], [Shares::default(); WIDTH]);
        for trees in 2..=WIDTH {
            for share in 1..trees {
                let cost = left_costs[share - 1] + right_costs[trees - share - 1];
                // The first is taken even if areas overflow.
                if share == 1 || cost < costs[trees - 1] {
                    costs[trees - 1] = cost;
                    shares[trees - 1] = Shares::new(share, trees - share);
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
        shares[0] = children;
        (Branch { link: right as u32, shares, ..Branch::around(bounds) }, costs)
    }

    fn around(bounds: &Aabb) -> Branch {
        let (min, max) = (bounds.min.truncate().to_array(), bounds.max.truncate().to_array());
        Branch { min, max, link: 0, count: 0, shares: [Shares::default(); WIDTH] }
    }

    fn is_leaf(&self) -> bool {
        self.count > 0
    }
}

/// The wide tree during construction.
pub(super) struct Collapse<'a> {
    branches: &'a [Branch],
    /// The numbers of all items, in the order of the branches.
    items: &'a [u32],
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
    pub fn of(branches: &[Branch], items: &[u32], leaf_size: usize) -> (Vec<Node>, Vec<u32>) {
        let leaves = branches.len().div_ceil(2);
        let (nodes, order) = (Vec::with_capacity(leaves / (WIDTH - 2)), Vec::with_capacity(leaves * leaf_size));
        let mut collapse = Collapse { branches, items, leaf_size, nodes, order };
        if let Some(root) = branches.first() {
            let children = match root.is_leaf() {
                true => Children { places: [0; WIDTH], count: 1 },
                false => collapse.children(0),
            };
            collapse.node(&children);
        }
        collapse.nodes.shrink_to_fit();
        (collapse.nodes, collapse.order)
    }

    /// The children of a branch that becomes a node.
    fn children(&self, branch: u32) -> Children {
        let mut children = Children { places: [0; WIDTH], count: 0 };
        self.gather(branch, self.branches[branch as usize].shares[0], &mut children);
        children
    }

    /// Appends `shares` trees from both sides of a branch.
    fn gather(&self, branch: u32, shares: Shares, into: &mut Children) {
        let sides = [branch + 1, branch + self.branches[branch as usize].link];
        for (side, share) in sides.into_iter().zip(shares.sides()) {
            let below = self.branches[side as usize].shares[share - 1];
            if share == 1 || below.0 == 0 {
                into.places[into.count] = side;
                into.count += 1;
            } else {
                self.gather(side, below, into);
            }
        }
    }

    /// Adds a node and its subtree, and returns its number.
    fn node(&mut self, children: &Children) -> u32 {
        let number = self.nodes.len();
        let mut node = Node::EMPTY;
        self.nodes.push(node);
        let branches = self.branches;
        // Places break ties of distance: nodes come before leaves.
        let mut places = children.places;
        let children = &mut places[..children.count];
        children.sort_by_key(|child| branches[*child as usize].is_leaf());
        for (place, &child) in children.iter().enumerate() {
            let branch = &branches[child as usize];
            for axis in 0..3 {
                node.bounds[axis][0][place] = branch.min[axis];
                node.bounds[axis][1][place] = branch.max[axis];
            }
            if branch.is_leaf() {
                node.children[place] = self.leaf(branch);
            }
        }
        for (place, &child) in children.iter().enumerate() {
            if !branches[child as usize].is_leaf() {
                node.children[place] = self.node(&self.children(child));
            }
        }
        self.nodes[number] = node;
        number as u32
    }

    fn leaf(&mut self, branch: &Branch) -> u32 {
        let leaf = (self.order.len() / self.leaf_size) as u32;
        self.order.extend_from_slice(&self.items[branch.link as usize..][..branch.count as usize]);
        self.order.resize((leaf as usize + 1) * self.leaf_size, NONE);
        LEAF | leaf
    }
}
