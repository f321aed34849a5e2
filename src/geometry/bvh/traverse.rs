//! Descending through the tree, near boxes first.
use fearless_simd::Simd;

use super::{Bvh, LEAF, Node, Slabs, WIDTH, build::MAX_DEPTH};

/// What leaves hold. A trait rather than a closure, which would be compiled without the instructions of `S`.
pub trait Leaves<S: Simd> {
    /// Tests what leaf `leaf` holds against the ray, keeps what is nearest, and returns the distance before which to go on
    /// looking: `t_max` or less. To be `#[inline(always)]`.
    fn meet(&mut self, s: S, leaf: u32, t_max: f32) -> f32;

    /// Any words of the leaf, one of each cache line: reading them early lets them come from memory while nearer boxes are
    /// looked at, as a prefetch would, which safe code has not.
    fn touch(&self, leaf: u32) -> u32;
}

/// Boxes that are still to be looked at, the nearest of a node last. May be used again for the next ray.
pub struct Stack {
    /// Distance (bits of a positive f32, which are in the order of the numbers) above the reference to the child.
    entries: [u64; Stack::SIZE],
    len: usize,
}

impl Stack {
    const SIZE: usize = 256;

    /// An index that cannot be out of range: the depth of the tree is bounded, and so is `len`.
    #[inline(always)]
    fn at(&mut self, place: usize) -> &mut u64 {
        const { assert!(MAX_DEPTH * (WIDTH - 1) < Stack::SIZE) };
        &mut self.entries[place % Stack::SIZE]
    }

    /// Puts an entry above those at `base` and higher that are farther.
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

    /// The topmost reference with a distance not beyond `t_max`.
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

impl Default for Stack {
    #[inline(always)]
    fn default() -> Stack {
        Stack { entries: [0; Stack::SIZE], len: 0 }
    }
}

/// The entry of the lowest place in `met`.
#[inline(always)]
fn entry(near: &[f32; WIDTH], node: &Node, met: u32) -> u64 {
    let place = met.trailing_zeros() as usize % WIDTH;
    u64::from(near[place].to_bits()) << 32 | u64::from(node.children[place])
}

/// Shows `leaves` every leaf whose box the ray of lane `lane` meets before the distance that `leaves` returned last, at first
/// `t_max` > 0. Returns that distance.
#[inline(always)]
pub fn traverse<S: Simd>(
    s: S,
    bvh: &Bvh,
    stack: &mut Stack,
    (slabs, lane): (&Slabs, usize),
    mut t_max: f32,
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
            t_max = leaves.meet(s, current & !LEAF, t_max);
        } else {
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
