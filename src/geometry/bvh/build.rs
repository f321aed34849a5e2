//! Builds a binary tree top-down, which `collapse.rs` turns into one with eight children per node.
use super::{
    Bvh,
    bins::{Extent, Grid, Plane, cheapest_plane},
    collapse::{Branch, Collapse, Forest},
    item::Item,
};
use crate::{
    geometry::bounds::Bounds,
    progress::{Cancelled, Progress},
};

/// Maximum number of branches between the root and a leaf. If splits by the heuristic would go deeper, items are halved instead.
pub(super) const MAX_DEPTH: usize = 36;

/// A range of items below one branch.
#[derive(Clone, Copy)]
struct Part {
    start: usize,
    end: usize,
    bounds: Extent,
    /// The box of the doubled centres.
    centers: Extent,
}

impl Part {
    fn of(items: &[Item], start: usize, end: usize) -> Part {
        let mut part = Part { start, end, bounds: Extent::EMPTY, centers: Extent::EMPTY };
        for item in &items[start..end] {
            part.bounds.add(item.min, item.max);
            part.centers.add(item.center(), item.center());
        }
        part
    }

    fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Items of a branch that reports its progress when it is finished.
const REPORT: usize = 1 << 14;

struct Builder<'a, const LEAF_SIZE: usize> {
    items: Vec<Item>,
    branches: Vec<Branch>,
    progress: &'a Progress,
}

impl Bvh {
    /// Builds a tree over boxes, none of which may be empty or infinite, and returns it with the numbers of the boxes in its
    /// leaves: leaf k holds `order[k * LEAF_SIZE..][..LEAF_SIZE]`, of which the last ones may be [`NONE`].
    pub fn build<const LEAF_SIZE: usize>(boxes: impl ExactSizeIterator<Item = Bounds>) -> (Bvh, Vec<u32>) {
        Bvh::build_watched::<LEAF_SIZE>(boxes, &Progress::default()).expect("nobody cancels")
    }

    /// The same, with progress, which counts items, and cancellation.
    pub fn build_watched<const LEAF_SIZE: usize>(
        boxes: impl ExactSizeIterator<Item = Bounds>,
        progress: &Progress,
    ) -> Result<(Bvh, Vec<u32>), Cancelled> {
        let count = boxes.len();
        let mut items = Vec::with_capacity(count);
        items.extend(boxes.enumerate().map(|(number, bounds)| Item::new(number, &bounds)));
        let all = Part::of(&items, 0, count);
        let branches = Vec::with_capacity(4 * count / LEAF_SIZE + 1);
        let mut builder = Builder::<LEAF_SIZE> { items, branches, progress };
        builder.grow(all, MAX_DEPTH)?;
        progress.advance(if count <= REPORT { count as u64 } else { 0 })?;
        let [min, max] = [all.bounds.min, all.bounds.max].map(|corner| corner.truncate().to_array());
        let (nodes, order) = Collapse::of(&builder.branches, &builder.items, LEAF_SIZE);
        Ok((Bvh { nodes, bounds: Bounds { min, max } }, order))
    }
}

impl<const LEAF_SIZE: usize> Builder<'_, LEAF_SIZE> {
    /// Adds the branch for `part` and its subtree, which may have up to `levels` levels. Returns its index.
    fn grow(&mut self, part: Part, levels: usize) -> Result<u32, Cancelled> {
        let place = self.branches.len();
        let mut branch = Branch::leaf(part.bounds, part.start as u32, part.len() as u32);
        self.branches.push(branch);
        if part.len() > LEAF_SIZE {
            let parts = self.split(part, levels);
            if part.len() > REPORT {
                self.progress.check()?;
            }
            let mut sides = [0; 2];
            for (side, below) in sides.iter_mut().zip(parts) {
                *side = self.grow(below, levels - 1)?;
                if part.len() > REPORT && below.len() <= REPORT {
                    self.progress.advance(below.len() as u64)?;
                }
            }
            branch.forest = Forest::over(&part.bounds, sides, &self.branches);
            self.branches[place] = branch;
        }
        Ok(place as u32)
    }

    fn split(&mut self, part: Part, levels: usize) -> [Part; 2] {
        // However the heuristic splits, a side must fit under the levels that are left.
        let most = LEAF_SIZE.saturating_mul(1 << (levels - 1));
        if part.len() <= most {
            let grid = Grid::new(&part.centers, part.len());
            // Large parts take long. Where the build is cancelled, any plane will do.
            let is_live = || part.len() <= REPORT || !self.progress.is_cancelled();
            let boxes = self.items[part.start..part.end].iter().map_while(|item| is_live().then_some((item.min, item.max)));
            if let Some(plane) = cheapest_plane::<LEAF_SIZE>(boxes, &grid) {
                return self.partition(part, &grid, &plane);
            }
        }
        self.halve(part)
    }

    /// Moves the items left of the plane to the front.
    fn partition(&mut self, part: Part, grid: &Grid, plane: &Plane) -> [Part; 2] {
        let items = &mut self.items[..part.end];
        let (mut left, mut right) = (Extent::EMPTY, Extent::EMPTY);
        let (mut middle, mut end) = (part.start, part.end);
        while middle < end {
            let center = items[middle].center();
            if grid.bins_of(center)[plane.axis] < plane.bin {
                left.add(center, center);
                middle += 1;
            } else {
                right.add(center, center);
                end -= 1;
                items.swap(middle, end);
            }
        }
        [
            Part { start: part.start, end: middle, bounds: plane.left, centers: left },
            Part { start: middle, end: part.end, bounds: plane.right, centers: right },
        ]
    }

    /// Splits into two halves along the axis with the largest extent of centres.
    fn halve(&mut self, part: Part) -> [Part; 2] {
        let axis = (part.centers.max - part.centers.min).truncate().max_position();
        let middle = part.start + part.len() / 2;
        self.items[part.start..part.end]
            .select_nth_unstable_by(part.len() / 2, |a, b| a.center()[axis].total_cmp(&b.center()[axis]));
        [Part::of(&self.items, part.start, middle), Part::of(&self.items, middle, part.end)]
    }
}
