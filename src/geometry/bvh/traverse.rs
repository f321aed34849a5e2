//! Traversal of the tree, near boxes first.
use fearless_simd::Simd;

use super::{Bvh, LEAF, Node, Slabs, WIDTH, build::MAX_DEPTH};
use crate::math::{F, Lanes};

/// Which hits are looked for.
#[derive(Clone, Copy)]
pub struct Search<L: Lanes> {
    /// Hits before this distance.
    pub limit: F<L>,
    /// A hit before this distance ends the search, for rays that only ask whether something is in their way; 0 to find the nearest.
    pub enough: F<L>,
}

impl<L: Lanes> Search<L> {
    /// The nearest hit before a distance.
    #[inline(always)]
    pub fn nearest(l: L, limit: F<L>) -> Self {
        Search { limit, enough: l.f(0.0) }
    }
}

/// The contents of leaves. This is a trait because a closure would be compiled without the instructions of `S`.
pub trait Leaves<S: Simd> {
    /// Tests the contents of leaf `leaf` against the ray, keeps the nearest hit, and returns the distance at which the search
    /// ends: `t_max` or less. Implementations should be `#[inline(always)]`.
    fn meet(&mut self, s: S, leaf: u32, t_max: f32) -> f32;

    /// Any words of the leaf, one from each cache line. Reading them early acts as a prefetch, which safe code lacks: memory
    /// responds while nearer boxes are tested.
    fn touch(&self, leaf: u32) -> u32;
}

/// The most boxes that wait.
const SIZE: usize = 256;

/// Work on the way of rays through trees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Visits {
    /// Nodes, each a test of eight boxes.
    pub nodes: u64,
    /// Leaves, each a test of up to eight triangles or of an object.
    pub leaves: u64,
}

/// Boxes that are still to be visited, the nearest of a node last. It can be reused for the next ray. It counts visits only if it
/// `COUNTS`, which takes 2 % of the time.
pub struct Stack<const COUNTS: bool = false> {
    pub visits: Visits,
    /// Distance (the bits of positive f32 sort like their values) in the upper half, reference to the child in the lower half.
    entries: [u64; SIZE],
    len: usize,
}

impl<const COUNTS: bool> Stack<COUNTS> {
    /// Indexes modulo the size, which needs no bounds check. The depth of the tree is bounded, so the index never wraps.
    #[inline(always)]
    fn at(&mut self, place: usize) -> &mut u64 {
        const { assert!(MAX_DEPTH * (WIDTH - 1) < SIZE) };
        &mut self.entries[place % SIZE]
    }

    /// Inserts an entry above the farther ones from `base` upwards.
    #[inline(always)]
    fn insert(&mut self, base: usize, entry: u64) {
        let mut place = self.len;
        while place > base && *self.at(place - 1) < entry {
            *self.at(place) = *self.at(place - 1);
            place -= 1;
        }
        *self.at(place) = entry;
        self.len += 1;
    }

    /// Pops the topmost reference whose distance is at most `t_max`.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<u32> {
        while self.len > 0 {
            self.len -= 1;
            let entry = *self.at(self.len);
            if (entry >> 32) as u32 <= t_max.to_bits() {
                return Some(entry as u32);
            }
        }
        None
    }
}

impl<const COUNTS: bool> Default for Stack<COUNTS> {
    #[inline(always)]
    fn default() -> Self {
        Stack { visits: Visits::default(), entries: [0; SIZE], len: 0 }
    }
}

/// The entry of the lowest set bit in `met`.
#[inline(always)]
fn entry(near: &[f32; WIDTH], node: &Node, met: u32) -> u64 {
    let place = met.trailing_zeros() as usize % WIDTH;
    u64::from(near[place].to_bits()) << 32 | u64::from(node.children[place])
}

/// Passes to `leaves` every leaf whose box the ray of lane `lane` hits before the distance that `leaves` returned last, initially
/// `t_max` > 0. Returns that distance. A hit before `enough` ends the search.
#[inline(always)]
pub fn traverse<S: Simd, const COUNTS: bool>(
    s: S,
    bvh: &Bvh,
    stack: &mut Stack<COUNTS>,
    (slabs, lane): (&Slabs, usize),
    (mut t_max, enough): (f32, f32),
    leaves: &mut impl Leaves<S>,
) -> f32 {
    stack.len = 0;
    if bvh.nodes.is_empty() {
        return t_max;
    }
    let slabs = slabs.splat(s, lane);
    let mut current = 0;
    let mut touched = 0u32;
    loop {
        if current & LEAF != 0 {
            stack.visits.leaves += u64::from(COUNTS);
            let t = leaves.meet(s, current & !LEAF, t_max);
            if t < t_max && t < enough {
                return t;
            }
            t_max = t;
        } else {
            stack.visits.nodes += u64::from(COUNTS);
            let node = &bvh.nodes[current as usize];
            let (near, mut met) = slabs.meet(s, node, t_max);
            if met != 0 {
                let base = stack.len;
                let mut nearest = entry(&near, node, met);
                met &= met - 1;
                while met != 0 {
                    let other = entry(&near, node, met);
                    met &= met - 1;
                    touched |= match other as u32 {
                        child if child & LEAF != 0 => leaves.touch(child & !LEAF),
                        child => bvh.nodes[child as usize].touch(),
                    };
                    stack.insert(base, nearest.max(other));
                    nearest = nearest.min(other);
                }
                current = nearest as u32;
                continue;
            }
        }
        let Some(next) = stack.pop(t_max) else {
            std::hint::black_box(touched);
            return t_max;
        };
        current = next;
    }
}
