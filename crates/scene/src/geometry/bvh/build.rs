//! Builds a binary tree top-down, which `collapse.rs` turns into one with eight children per node.
//!
//! Both sides of a large branch grow at the same time. The tree is the same for any number of threads, because a split depends on the
//! items of its branch alone.
use std::{
    cmp::Ordering,
    sync::atomic::{AtomicU64, Ordering::Relaxed},
};

use rayon::prelude::*;

use super::{
    Bvh,
    bins::{Aabb, Grid, Plane, cheapest_plane},
    collapse::{Branch, Collapse, Costs},
    item::Item,
};
use crate::geometry::bounds::Bounds;
use noisefall_base::progress::{Cancelled, Progress};

/// Maximum number of branches between the root and a leaf. If splits by the heuristic would go deeper, items are halved instead.
pub(super) const MAX_DEPTH: usize = 36;

/// Items of a branch that reports its progress when it is finished.
const REPORT: usize = 1 << 14;

/// Items of a branch whose sides grow at the same time, at least.
const LARGE: usize = 1 << 15;
/// All items, divided by this, are another lower bound. Smaller sides would be copied more often.
const LARGE_SHARE: usize = 16;

/// A range of items below one branch.
#[derive(Clone, Copy)]
struct Part {
    start: usize,
    end: usize,
    bounds: Aabb,
    /// The box of the doubled centres.
    centers: Aabb,
    /// Whether items with the same content were removed.
    is_distinct: bool,
}

impl Part {
    /// The part of items that start at `start`.
    fn of(items: &[Item], start: usize) -> Part {
        let (mut bounds, mut centers) = (Aabb::EMPTY, Aabb::EMPTY);
        for item in items {
            bounds.add(item.min, item.max);
            centers.add(item.center(), item.center());
        }
        Part { start, end: start + items.len(), bounds, centers, is_distinct: false }
    }

    fn len(&self) -> usize {
        self.end - self.start
    }

    /// Whether all items have the same centre, so that no plane divides them.
    fn is_heap(&self) -> bool {
        self.centers.min.truncate() == self.centers.max.truncate()
    }
}

/// Compares the contents of two items by their numbers.
type Compare<'a> = dyn Fn(u32, u32) -> Ordering + Sync + 'a;

struct Builder<'a, const LEAF_SIZE: usize> {
    contents: Option<&'a Compare<'a>>,
    /// Items of a branch whose sides grow at the same time.
    large: usize,
    progress: &'a Progress,
    /// Progress to report for all `count` items, and the progress reported so far.
    work: u64,
    count: usize,
    reported: AtomicU64,
}

impl Bvh {
    /// Builds a tree over boxes, none of which may be empty or infinite, and returns it with the numbers of the boxes in its
    /// leaves: leaf k holds `order[k * LEAF_SIZE..][..LEAF_SIZE]`, of which the last ones may be [`NONE`](super::NONE).
    pub fn build<const LEAF_SIZE: usize>(boxes: impl Iterator<Item = Bounds>) -> (Bvh, Vec<u32>) {
        let boxes: Vec<Bounds> = boxes.collect();
        Bvh::build_watched::<LEAF_SIZE>(boxes.len(), |number| boxes[number], None, (&Progress::default(), 0))
            .expect("nobody cancels")
    }

    /// Builds a tree over `count` boxes on all threads, with cancellation and progress, which reports `work` in all. Of items in
    /// one place with the same `contents`, only the first is in the tree, so that a ray does not test them all.
    pub fn build_watched<const LEAF_SIZE: usize>(
        count: usize,
        bounds: impl Fn(usize) -> Bounds + Sync,
        contents: Option<&Compare>,
        (progress, work): (&Progress, u64),
    ) -> Result<(Bvh, Vec<u32>), Cancelled> {
        let mut items: Vec<Item> = (0..count).into_par_iter().map(|number| Item::new(number, &bounds(number))).collect();
        let all = Part::of(&items, 0);
        let builder = Builder::<LEAF_SIZE> {
            contents,
            large: LARGE.max(count / LARGE_SHARE),
            progress,
            work,
            count,
            reported: AtomicU64::new(0),
        };
        let mut branches = Vec::with_capacity(most_branches::<LEAF_SIZE>(count));
        if count > 0 {
            builder.grow(&mut items, all, MAX_DEPTH, &mut branches)?;
        }
        progress.advance(work - builder.reported.into_inner())?;
        let [min, max] = [all.bounds.min, all.bounds.max].map(|corner| corner.truncate().to_array());
        // The boxes of the items are not needed any more, and take most of the memory.
        let numbers: Vec<u32> = items.par_iter().map(Item::number).collect();
        drop(items);
        let (nodes, order) = Collapse::of(&branches, &numbers, LEAF_SIZE);
        Ok((Bvh { nodes, bounds: Bounds { min, max } }, order))
    }
}

impl<const LEAF_SIZE: usize> Builder<'_, LEAF_SIZE> {
    /// Appends the branch for `part`, whose items are `items`, and its subtree, which may have up to `levels` levels. Returns the costs
    /// of its forests.
    fn grow(&self, items: &mut [Item], part: Part, levels: usize, branches: &mut Vec<Branch>) -> Result<Costs, Cancelled> {
        let part = if part.len() > LEAF_SIZE && part.is_heap() { self.without_copies(items, part) } else { part };
        let items = &mut items[..part.len()];
        let (leaf, costs) = Branch::leaf(&part.bounds, part.start, part.len());
        let place = branches.len();
        branches.push(leaf);
        if part.len() <= LEAF_SIZE {
            return Ok(costs);
        }
        let parts = self.split(items, part, levels);
        if part.len() > REPORT {
            self.progress.check()?;
        }
        let [left, right] = parts;
        let (left_items, right_items) = items.split_at_mut(left.len());
        let of_right;
        let costs = if part.len() > self.large {
            let mut others = Vec::with_capacity(most_branches::<LEAF_SIZE>(right.len()));
            let sides = rayon::join(
                || self.grow(left_items, left, levels - 1, branches),
                || self.grow(right_items, right, levels - 1, &mut others),
            );
            of_right = branches.len() - place;
            branches.append(&mut others);
            [sides.0?, sides.1?]
        } else {
            let left_costs = self.grow(left_items, left, levels - 1, branches)?;
            of_right = branches.len() - place;
            [left_costs, self.grow(right_items, right, levels - 1, branches)?]
        };
        if part.len() > REPORT {
            let finished = parts.iter().map(Part::len).filter(|count| *count <= REPORT);
            self.report(finished.sum())?;
        }
        let (branch, costs) = Branch::over(&part.bounds, of_right, &costs);
        branches[place] = branch;
        Ok(costs)
    }

    /// Reports the work on finished items.
    fn report(&self, items: usize) -> Result<(), Cancelled> {
        let work = items as u64 * self.work / self.count as u64;
        self.reported.fetch_add(work, Relaxed);
        self.progress.advance(work)
    }

    /// Moves the first of all items with the same content to the front, in the order of their contents. The others are left out.
    fn without_copies(&self, items: &mut [Item], part: Part) -> Part {
        let Some(contents) = self.contents.filter(|_| !part.is_distinct) else { return part };
        let compare = |a: &Item, b: &Item| contents(a.number(), b.number()).then(a.number().cmp(&b.number()));
        items.par_sort_unstable_by(compare);
        let mut kept = 0;
        for at in 1..items.len() {
            if contents(items[kept].number(), items[at].number()).is_ne() {
                kept += 1;
                items.swap(kept, at);
            }
        }
        Part { end: part.start + kept + 1, is_distinct: true, ..part }
    }

    fn split(&self, items: &mut [Item], part: Part, levels: usize) -> [Part; 2] {
        // However the heuristic splits, a side must fit under the levels that are left.
        let most = LEAF_SIZE.saturating_mul(1 << (levels - 1));
        if part.len() <= most {
            let grid = Grid::new(&part.centers, part.len());
            // Where the build is cancelled, any plane will do.
            if let Some(plane) = cheapest_plane::<LEAF_SIZE>(items, &grid, self.progress) {
                return partition(items, part, &grid, &plane);
            }
        }
        halve(items, part)
    }
}

/// The most branches over so many items, if leaves are half full on average. What is not used takes no memory.
fn most_branches<const LEAF_SIZE: usize>(count: usize) -> usize {
    4 * count / LEAF_SIZE + 1
}

/// Moves the items left of the plane to the front.
fn partition(items: &mut [Item], part: Part, grid: &Grid, plane: &Plane) -> [Part; 2] {
    let (mut left, mut right) = (Aabb::EMPTY, Aabb::EMPTY);
    let (mut middle, mut end) = (0, items.len());
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
    let middle = part.start + middle;
    [
        Part { end: middle, bounds: plane.left, centers: left, ..part },
        Part { start: middle, bounds: plane.right, centers: right, ..part },
    ]
}

/// Splits into two halves along the axis with the largest extent of centres.
fn halve(items: &mut [Item], part: Part) -> [Part; 2] {
    let axis = (part.centers.max - part.centers.min).truncate().max_position();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| a.center()[axis].total_cmp(&b.center()[axis]));
    let (left, right) = items.split_at(middle);
    let [left, right] = [Part::of(left, part.start), Part::of(right, part.start + middle)];
    [left, right].map(|half| Part { is_distinct: part.is_distinct, ..half })
}
