//! Splits a set of boxes by the surface area heuristic over bins.
//!
//! The cost of a split is area(left)·leaves(left) + area(right)·leaves(right): the probability that a ray through the parent hits
//! a part, times the work there (D. MacDonald and S. Booth, "Heuristics for ray tracing using space subdivision", 1990).
//! Candidates are planes between bins of box centres (I. Wald, "On fast construction of SAH-based bounding volume hierarchies",
//! 2007).
use glam::Vec4;

use super::item::Item;
use noisefall_base::progress::Progress;

/// Maximum number of bins along an axis.
const BINS: usize = 32;
/// Minimum number of bins along an axis.
const FEWEST: usize = 16;
/// Number of items per bin, up to [`BINS`] bins.
const ITEMS_PER_BIN: usize = 4;

/// A box for computations of four floats at a time; `w` is unused.
#[derive(Clone, Copy)]
pub(super) struct Aabb {
    pub min: Vec4,
    pub max: Vec4,
}

impl Aabb {
    pub const EMPTY: Aabb = Aabb { min: Vec4::INFINITY, max: Vec4::NEG_INFINITY };

    #[inline(always)]
    pub fn add(&mut self, min: Vec4, max: Vec4) {
        self.min = self.min.min(min);
        self.max = self.max.max(max);
    }

    /// Half the area of the six faces.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let size = self.max - self.min;
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

#[derive(Clone, Copy)]
struct Bin {
    extent: Aabb,
    count: u32,
}

impl Bin {
    const EMPTY: Bin = Bin { extent: Aabb::EMPTY, count: 0 };

    #[inline(always)]
    fn add(&mut self, other: &Bin) {
        self.extent.add(other.extent.min, other.extent.max);
        self.count += other.count;
    }

    /// Area times leaves.
    #[inline(always)]
    fn cost<const LEAF_SIZE: usize>(&self) -> f32 {
        self.extent.half_area() * self.count.div_ceil(LEAF_SIZE as u32) as i32 as f32
    }
}

/// Maps centres to bins along the three axes.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    base: Vec4,
    scale: Vec4,
    bins: usize,
}

impl Grid {
    /// Bins for `count` items with centres (doubled) in `centers`.
    pub fn new(centers: &Aabb, count: usize) -> Grid {
        let bins = (count / ITEMS_PER_BIN).clamp(FEWEST, BINS);
        let size = centers.max - centers.min;
        // An axis along which all centres agree, or nearly overflow, has scale 0: all in one bin, which is no split.
        let scale = size.map(|size| if size > 1e-30 && size < 1e30 { bins as f32 * 0.9999 / size } else { 0.0 });
        Grid { base: centers.min, scale, bins }
    }

    /// The bin of a doubled centre along each axis.
    #[inline(always)]
    pub fn bins_of(&self, center: Vec4) -> [usize; 4] {
        // Adding 2²³ rounds to an integer that stands in the last bits.
        const ROUNDER: f32 = 8_388_608.0;
        let place = (center - self.base) * self.scale - 0.5 + ROUNDER;
        let bin = |place: f32| place.to_bits() as usize & (BINS - 1);
        let [x, y, z, w] = place.max(Vec4::splat(ROUNDER)).to_array();
        [bin(x), bin(y), bin(z), bin(w)]
    }
}

/// The bins of some boxes, by axis.
struct Bins([[Bin; BINS]; 3]);

impl Bins {
    /// Number of items that are binned in a row.
    const IN_A_ROW: usize = 1 << 15;

    const EMPTY: Bins = Bins([[Bin::EMPTY; BINS]; 3]);

    /// Adds items, many of them on all threads. The result does not depend on their order. If the build is cancelled, some are left
    /// out.
    fn fill(&mut self, items: &[Item], grid: &Grid, progress: &Progress) {
        if items.len() > Bins::IN_A_ROW && !progress.is_cancelled() {
            let (left, right) = items.split_at(items.len() / 2);
            let mut others = Bins::EMPTY;
            rayon::join(|| self.fill(left, grid, progress), || others.fill(right, grid, progress));
            self.add(&others);
            return;
        }
        for item in items.iter().take(Bins::IN_A_ROW) {
            for (bins, at) in self.0.iter_mut().zip(grid.bins_of(item.center())) {
                bins[at].add(&Bin { extent: Aabb { min: item.min, max: item.max }, count: 1 });
            }
        }
    }

    fn add(&mut self, other: &Bins) {
        let bins = self.0.as_flattened_mut().iter_mut().zip(other.0.as_flattened());
        bins.for_each(|(bin, other)| bin.add(other));
    }
}

/// A plane between bins.
pub(super) struct Plane {
    pub axis: usize,
    /// The first bin of the right part.
    pub bin: usize,
    pub left: Aabb,
    pub right: Aabb,
}

/// The plane of lowest cost; `None` if all centres fall into one bin along every axis.
pub(super) fn cheapest_plane<const LEAF_SIZE: usize>(items: &[Item], grid: &Grid, progress: &Progress) -> Option<Plane> {
    let mut bins = Bins::EMPTY;
    bins.fill(items, grid, progress);
    let Bins(bins) = bins;
    let (mut lowest, mut best) = (f32::INFINITY, None);
    for (axis, bins) in bins.iter().enumerate() {
        let mut right_costs = [f32::INFINITY; BINS];
        let mut right = Bin::EMPTY;
        for bin in (1..grid.bins).rev() {
            right.add(&bins[bin]);
            if right.count > 0 {
                right_costs[bin] = right.cost::<LEAF_SIZE>();
            }
        }
        let mut left = Bin::EMPTY;
        for bin in 1..grid.bins {
            left.add(&bins[bin - 1]);
            let cost = left.cost::<LEAF_SIZE>() + right_costs[bin];
            if left.count > 0 && cost < lowest {
                (lowest, best) = (cost, Some((axis, bin)));
            }
        }
    }
    let (axis, bin) = best?;
    let join = |bins: &[Bin]| {
        let mut all = Bin::EMPTY;
        bins.iter().for_each(|bin| all.add(bin));
        all.extent
    };
    Some(Plane { axis, bin, left: join(&bins[axis][..bin]), right: join(&bins[axis][bin..grid.bins]) })
}
