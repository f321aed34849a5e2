//! The triangles of leaves: their corners side by side, and their numbers.
use fearless_simd::{Simd, SimdBase, f32x8};
use rayon::prelude::*;

use super::shear::{SIZE, Shear, Sheared};
use crate::geometry::bvh::NONE;

/// Number of pairs in a leaf, at most.
pub(super) const PAIRS: usize = SIZE / 2;

/// All leaves of a tree.
pub(super) enum TriangleLeaves {
    Apart(Filled<Apart>),
    Shared(Filled<Shared>),
}

/// Leaves of one kind.
pub(super) struct Filled<C> {
    pub leaves: Vec<C>,
    /// The triangles of each leaf; [`NONE`] in unused slots.
    numbers: Vec<[u32; SIZE]>,
}

/// The corners of a leaf. Those that it does not have are NaN.
pub(super) trait Leaf: Send {
    /// The corners, sheared.
    fn sheared<S: Simd>(&self, s: S, ray: &Shear) -> Sheared<S>;
}

/// The corners of [`SIZE`] triangles: by corner, then axis.
#[repr(align(32))]
pub(super) struct Apart([[[f32; SIZE]; 3]; 3]);

/// The corners of [`PAIRS`] pairs of triangles a b c and c d a, by axis. Both run the same way around, so that the processor can predict the
/// sign of a hit.
#[repr(align(64))]
pub(super) struct Shared([Row; 3]);

/// Coordinates along an axis.
#[derive(Clone, Copy)]
struct Row {
    /// All a, then all c.
    common: [f32; SIZE],
    /// All b, then all d.
    others: [f32; SIZE],
}

impl<C: Leaf> Filled<C> {
    /// Makes a leaf, and the numbers of its triangles, of each `size` items.
    pub fn new(order: &[u32], size: usize, leaf: impl Fn(&[u32]) -> (C, [u32; SIZE]) + Send + Sync) -> Filled<C> {
        let (leaves, numbers) = order.par_chunks_exact(size).map(leaf).unzip();
        Filled { leaves, numbers }
    }

    /// The triangle in slot k of leaf i, where `slot` is [`SIZE`] · i + k; [`NONE`] for [`NONE`]. Which rays hit cannot be predicted, so
    /// there is no branch.
    #[inline(always)]
    pub fn triangle(&self, slot: u32) -> u32 {
        let numbers = self.numbers.as_flattened();
        let Some(last) = numbers.len().checked_sub(1) else { return NONE };
        let number = numbers[(slot as usize).min(last)];
        if slot == NONE { NONE } else { number }
    }
}

impl Leaf for Apart {
    #[inline(always)]
    fn sheared<S: Simd>(&self, s: S, ray: &Shear) -> Sheared<S> {
        let ([x, y, z], Apart([a, b, c])) = (ray.axes, self);
        let a = [eight(s, &a[x]), eight(s, &a[y]), eight(s, &a[z])];
        let b = [eight(s, &b[x]), eight(s, &b[y]), eight(s, &b[z])];
        let c = [eight(s, &c[x]), eight(s, &c[y]), eight(s, &c[z])];
        Sheared { corners: [ray.apply(a), ray.apply(b), ray.apply(c)] }
    }
}

impl Leaf for Shared {
    #[inline(always)]
    fn sheared<S: Simd>(&self, s: S, ray: &Shear) -> Sheared<S> {
        let ([x, y, z], Shared(rows)) = (ray.axes, self);
        let (x, y, z) = (&rows[x], &rows[y], &rows[z]);
        let common = ray.apply([eight(s, &x.common), eight(s, &y.common), eight(s, &z.common)]);
        let others = ray.apply([eight(s, &x.others), eight(s, &y.others), eight(s, &z.others)]);
        let swapped = [swap(common[0]), swap(common[1]), swap(common[2])];
        Sheared { corners: [common, others, swapped] }
    }
}

#[inline(always)]
fn eight<S: Simd>(s: S, row: &[f32; SIZE]) -> f32x8<S> {
    f32x8::load_array_ref(s, row)
}

/// Swaps the halves.
#[inline(always)]
fn swap<S: Simd>(x: f32x8<S>) -> f32x8<S> {
    x.slide::<PAIRS>(x)
}

impl Apart {
    /// Stores triangles in the given places.
    pub fn new(triangles: impl Iterator<Item = (usize, [[f32; 3]; 3])>) -> Apart {
        let mut all = [[[f32::NAN; SIZE]; 3]; 3];
        for (place, corners) in triangles {
            for (corner, vertex) in corners.into_iter().enumerate() {
                for axis in 0..3 {
                    all[corner][axis][place] = vertex[axis];
                }
            }
        }
        Apart(all)
    }
}

impl Shared {
    /// Stores pairs with corners a, b, c and d in the given places.
    pub fn new(pairs: impl Iterator<Item = (usize, [[f32; 3]; 4])>) -> Shared {
        let mut rows = [Row { common: [f32::NAN; SIZE], others: [f32::NAN; SIZE] }; 3];
        for (place, [a, b, c, d]) in pairs {
            for (axis, row) in rows.iter_mut().enumerate() {
                (row.common[place], row.common[PAIRS + place]) = (a[axis], c[axis]);
                (row.others[place], row.others[PAIRS + place]) = (b[axis], d[axis]);
            }
        }
        Shared(rows)
    }
}
