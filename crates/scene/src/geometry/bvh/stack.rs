//! The boxes that wait on the way of a ray.
use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFrom, SimdMask, f32x8, mask32x8, u8x32, u32x8};

use super::{Visits, WIDTH, build::MAX_DEPTH};

/// The most boxes that wait.
const SIZE: usize = 256;
/// The bits of a key that have the place of the box in its node.
const PLACE: u32 = WIDTH as u32 - 1;

/// Boxes that are still to be visited, the nearest of a node last. It can be reused for the next ray. It counts visits only if it
/// `COUNTS`, which takes 2 % of the time.
pub struct Stack<const COUNTS: bool = false> {
    pub visits: Visits,
    /// See [`Entered`].
    keys: [u32; SIZE + WIDTH],
    /// The node of each box.
    nodes: [u32; SIZE + WIDTH],
    len: usize,
}

/// The boxes of a node that a ray enters. The key of a box has the bits of its distance, which sort like their values, with the last three
/// replaced by its place in the node.
pub(super) struct Entered<S: Simd> {
    keys: u32x8<S>,
    boxes: mask32x8<S>,
}

impl<S: Simd> Entered<S> {
    #[inline(always)]
    pub fn new(s: S, near: f32x8<S>, boxes: mask32x8<S>) -> Self {
        let places = u32x8::simd_from(s, [0, 1, 2, 3, 4, 5, 6, 7]);
        Entered { keys: (near.bitcast::<u32x8<S>>() & !PLACE) | places, boxes }
    }

    /// The place of the nearest box.
    #[inline(always)]
    pub fn nearest(&self, s: S) -> Option<usize> {
        let nearest = self.boxes.select(self.keys, u32x8::splat(s, u32::MAX)).reduce_min();
        (nearest != u32::MAX).then_some((nearest & PLACE) as usize)
    }
}

impl<const COUNTS: bool> Stack<COUNTS> {
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// Pushes all boxes of a node but the nearest. There is no branch on their number, which no processor could predict.
    #[inline(always)]
    pub(super) fn push_others<S: Simd>(&mut self, s: S, node: u32, entered: &Entered<S>) {
        const { assert!(MAX_DEPTH * (WIDTH - 1) < SIZE) };
        let keys = descending(s, entered.boxes.select(entered.keys, u32x8::splat(s, 0)));
        // Indexes modulo the size need no bounds check. The depth of the tree is bounded, so they never wrap.
        let at = self.len % SIZE;
        keys.store_slice(&mut self.keys[at..at + WIDTH]);
        u32x8::splat(s, node).store_slice(&mut self.nodes[at..at + WIDTH]);
        self.len += entered.boxes.to_bitmask().count_ones() as usize - 1;
    }

    /// Pops the node and place of the topmost box that begins at `t_max` or before.
    #[inline(always)]
    pub(super) fn pop(&mut self, t_max: f32) -> Option<(u32, usize)> {
        while self.len > 0 {
            self.len -= 1;
            let key = self.keys[self.len % SIZE];
            if key & !PLACE <= t_max.to_bits() {
                return Some((self.nodes[self.len % SIZE], (key & PLACE) as usize));
            }
        }
        None
    }
}

impl<const COUNTS: bool> Default for Stack<COUNTS> {
    #[inline(always)]
    fn default() -> Self {
        Stack { visits: Visits::default(), keys: [0; SIZE + WIDTH], nodes: [0; SIZE + WIDTH], len: 0 }
    }
}

/// The numbers sorted, the largest first, by a bitonic network (K. E. Batcher, "Sorting networks and their applications", 1968).
#[inline(always)]
fn descending<S: Simd>(s: S, x: u32x8<S>) -> u32x8<S> {
    // Blocks of four numbers with neighbours swapped, and reversed.
    let pairs = u8x32::simd_from(s, const { bytes([1, 0, 3, 2]) });
    let backwards = u8x32::simd_from(s, const { bytes([3, 2, 1, 0]) });
    let x = compare(s, x, x.swizzle_dyn_within_blocks(pairs), 0b1010_1010);
    let x = compare(s, x, x.swizzle_dyn_within_blocks(backwards), 0b1100_1100);
    let x = compare(s, x, x.swizzle_dyn_within_blocks(pairs), 0b1010_1010);
    let x = compare(s, x, x.slide::<4>(x).swizzle_dyn_within_blocks(backwards), 0b1111_0000);
    let x = compare(s, x, x.slide_within_blocks::<2>(x), 0b1100_1100);
    compare(s, x, x.swizzle_dyn_within_blocks(pairs), 0b1010_1010)
}

/// The smaller of each number and its partner in the lanes that are `last`, else the larger.
#[inline(always)]
fn compare<S: Simd>(s: S, x: u32x8<S>, partners: u32x8<S>, last: u64) -> u32x8<S> {
    mask32x8::from_bitmask(s, last).select(x.min(partners), x.max(partners))
}

/// Indices of bytes that move whole numbers within blocks of four: each place gets the number at `places`.
const fn bytes(places: [u8; 4]) -> [u8; 32] {
    let mut bytes = [0; 32];
    let mut at = 0;
    while at < 32 {
        bytes[at] = places[at / 4 % 4] * 4 + at as u8 % 4;
        at += 1;
    }
    bytes
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
    use rand::{Rng, SeedableRng, rngs::SmallRng};

    use super::*;

    fn sort<S: Simd>(s: S, x: [u32; 8]) -> [u32; 8] {
        descending(s, u32x8::simd_from(s, x)).into()
    }

    /// By the 0-1 principle, a network that sorts all zeros and ones sorts everything (Knuth, "The Art of Computer Programming", volume 3,
    /// section 5.3.4).
    #[test]
    fn the_network_sorts() {
        let mut rng = SmallRng::seed_from_u64(3);
        let bits = (0..256u32).map(|bits| std::array::from_fn(|lane| bits >> lane & 1));
        for x in bits.chain((0..1000).map(|_| std::array::from_fn(|_| rng.random()))).collect::<Vec<[u32; 8]>>() {
            let mut exact = x;
            exact.sort_unstable_by(|a, b| b.cmp(a));
            assert_eq!(dispatch!(Level::new(), s => sort(s, x)), exact);
            assert_eq!(sort(fearless_simd::Fallback::new(), x), exact);
        }
    }
}
