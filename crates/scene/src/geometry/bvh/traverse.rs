//! Traversal of the tree, near boxes first.
//!
//! Most of the time is spent waiting for memory, and for the test of a node, whose result says where to go next. So two rays take turns: one
//! is tested while the other one waits.
use std::marker::PhantomData;

use fearless_simd::Simd;

use super::{
    Bvh, LEAF, Slabs,
    slabs::WideSlabs,
    stack::{Entered, Stack},
};
use noisefall_base::math::{F, Lanes, M, MAX_LANES};

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
    /// Tests the contents of leaf `leaf` against the ray of a lane, keeps the nearest hit, and returns the distance at which the search
    /// ends: `t_max` or less. Implementations should be `#[inline(always)]`.
    fn meet(&mut self, s: S, lane: usize, leaf: u32, t_max: f32) -> f32;
}

/// Room for the boxes of two rays.
pub type Stacks<const COUNTS: bool = false> = [Stack<COUNTS>; 2];

/// The searches of all lanes.
pub struct Searches<L: Lanes> {
    /// Where the search of each lane ends.
    pub t_max: [f32; MAX_LANES],
    enough: [f32; MAX_LANES],
    /// Lanes whose search has not begun, as bits.
    rest: u64,
    lanes: PhantomData<L>,
}

impl<L: Lanes> Searches<L> {
    /// Searches in the lanes of `live`.
    #[inline(always)]
    pub fn new(live: M<L>, search: Search<L>) -> Self {
        Searches { t_max: search.limit.to_array(), enough: search.enough.to_array(), rest: live.bits(), lanes: PhantomData }
    }

    /// The next lane. It is a constant if there is only one, so that rays of single lanes stay in registers.
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let (rest, lane) = (self.rest, self.rest.trailing_zeros() as usize % L::N);
        self.rest &= rest.wrapping_sub(1);
        (rest != 0).then_some(lane)
    }
}

/// A traversal: the tree, its rays, and stacks of boxes that wait for two of them.
struct Descent<'a, L: Lanes, C, const COUNTS: bool> {
    bvh: &'a Bvh,
    slabs: &'a Slabs,
    searches: &'a mut Searches<L>,
    stacks: &'a mut Stacks<COUNTS>,
    leaves: &'a mut C,
}

/// One ray on its way.
struct Walk<S: Simd> {
    slabs: WideSlabs<S>,
    lane: usize,
    /// The index of its stack.
    stack: usize,
    /// The box to visit next.
    current: u32,
    t_max: f32,
    enough: f32,
}

impl<L: Lanes, C, const COUNTS: bool> Descent<'_, L, C, COUNTS> {
    /// The next ray at the root, if there is one.
    #[inline(always)]
    fn next<S: Simd>(&mut self, s: S, stack: usize) -> Option<Walk<S>> {
        let lane = self.searches.next()?;
        self.stacks[stack].clear();
        let Searches { t_max, enough, .. } = &self.searches;
        Some(Walk { slabs: self.slabs.splat(s, lane), lane, stack, current: 0, t_max: t_max[lane], enough: enough[lane] })
    }
}

impl<S: Simd> Walk<S> {
    /// Visits a box. Returns whether the ray goes on.
    #[inline(always)]
    fn step<L: Lanes, const COUNTS: bool>(&mut self, s: S, descent: &mut Descent<L, impl Leaves<S>, COUNTS>) -> bool {
        let (nodes, stack) = (&descent.bvh.nodes, &mut descent.stacks[self.stack]);
        if self.current & LEAF != 0 {
            stack.visits.leaves += u64::from(COUNTS);
            let t = descent.leaves.meet(s, self.lane, self.current & !LEAF, self.t_max);
            let ends = t < self.t_max && t < self.enough;
            self.t_max = t;
            if ends {
                return false;
            }
        } else {
            stack.visits.nodes += u64::from(COUNTS);
            let node = &nodes[self.current as usize];
            let (near, boxes) = self.slabs.meet(s, node, self.t_max);
            let entered = Entered::new(s, near, boxes);
            if let Some(nearest) = entered.nearest(s) {
                stack.push_others(s, self.current, &entered);
                self.current = node.children[nearest];
                return true;
            }
        }
        let Some((node, place)) = stack.pop(self.t_max) else { return false };
        self.current = nodes[node as usize].children[place];
        true
    }

    /// Visits a box, and goes on with the next ray where this one ends. Where there is none, finishes the other one and returns false.
    #[inline(always)]
    fn turn<L: Lanes, const COUNTS: bool>(
        &mut self,
        s: S,
        descent: &mut Descent<L, impl Leaves<S>, COUNTS>,
        other: &mut Self,
    ) -> bool {
        if self.step(s, descent) {
            return true;
        }
        descent.searches.t_max[self.lane] = self.t_max;
        let Some(next) = descent.next(s, self.stack) else {
            other.finish(s, descent);
            return false;
        };
        *self = next;
        true
    }

    #[inline(always)]
    fn finish<L: Lanes, const COUNTS: bool>(&mut self, s: S, descent: &mut Descent<L, impl Leaves<S>, COUNTS>) {
        while self.step(s, descent) {}
        descent.searches.t_max[self.lane] = self.t_max;
    }
}

/// Passes to `leaves` every leaf whose box a ray hits before the distance that `leaves` returned last for this ray, and stores that distance
/// in `searches`.
#[inline(always)]
pub fn traverse<S: Simd, L: Lanes, const COUNTS: bool>(
    s: S,
    bvh: &Bvh,
    stacks: &mut Stacks<COUNTS>,
    (slabs, searches): (&Slabs, &mut Searches<L>),
    leaves: &mut impl Leaves<S>,
) {
    if bvh.nodes.is_empty() {
        return;
    }
    let mut descent = Descent { bvh, slabs, searches, stacks, leaves };
    let Some(mut one) = descent.next(s, 0) else { return };
    let Some(mut two) = descent.next(s, 1) else { return one.finish(s, &mut descent) };
    while one.turn(s, &mut descent, &mut two) && two.turn(s, &mut descent, &mut one) {}
}
