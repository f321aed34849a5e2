//! Slab test of a ray against eight boxes at once, in which rounding never loses a hit.
//!
//! The test must not lose hits that the tests in the leaves *report*, including their rounding. Let o be the origin and d the
//! direction of the ray, z the axis of d's largest component, and u = ε/2. For a point of the scene, let a be its distance from o
//! along axis i, and b that along z:
//! * the triangle test (`mesh/shear.rs`) is exact for vertices with an error of u (2|a| + 4|b|) along i and u |b| along z;
//! * the distance it returns is rounded by u, which along i is u |a|;
//! * a slab test rounds a difference, a reciprocal and a product: 3 u |a|.
//!
//! Let A and B be the largest |a| and |b| in the box around all items. Boxes widened by 7 u (A + B) on each side therefore
//! contain all hits, with a margin for products of roundings. They are widened once per ray, by shifting the origin in opposite
//! directions for near and far planes (S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2013), which
//! costs nothing per box; rounding the shifted origin adds u |oᵢ|. For the slab test alone a factor of 1 + 2γ₃ on the far side
//! would suffice (T. Ize, "Robust BVH Ray Traversal", JCGT 2013), but it would lose hits that exist only by the rounding of
//! vertices, and meshes would no longer be watertight.
//!
//! A component of d below 2⁻²⁶ of the largest is clamped to it, keeping its sign. Over the length of the scene this shifts the
//! ray by less than u B/4, and no infinity or NaN can occur.
use fearless_simd::{Simd, SimdBase, f32x8, mask32x8};

use super::Node;
use crate::geometry::bounds::Bounds;
use noisefall_base::math::{F, Lanes, MAX_LANES, V};

/// The rays o + td of several lanes, prepared for the test of boxes; by axis, then lane.
pub struct Slabs {
    near_origin: [[f32; MAX_LANES]; 3],
    far_origin: [[f32; MAX_LANES]; 3],
    /// 1/d.
    inverse: [[f32; MAX_LANES]; 3],
}

impl Slabs {
    /// Prepares rays for boxes inside `bounds`. d need not be of unit length, but neither it nor its square may be 0 or infinite.
    #[inline(always)]
    pub fn new<L: Lanes>(l: L, o: V<L>, d: V<L>, bounds: &Bounds) -> Slabs {
        const ETA: f32 = 3.5 * f32::EPSILON;
        const SMALLEST: f32 = f32::EPSILON / 8.0;
        let (min, max) = (V::splat(l, bounds.min), V::splat(l, bounds.max));
        let reach = V { x: (max.x - o.x).max(o.x - min.x), y: (max.y - o.y).max(o.y - min.y), z: (max.z - o.z).max(o.z - min.z) };
        // Along the axis of d's largest component and beyond.
        let farthest = reach.max_component();
        let smallest = d.max_abs() * SMALLEST;
        let mut slabs =
            Slabs { near_origin: [[0.0; MAX_LANES]; 3], far_origin: [[0.0; MAX_LANES]; 3], inverse: [[0.0; MAX_LANES]; 3] };
        let axes: [[F<L>; 3]; 3] = [[o.x, d.x, reach.x], [o.y, d.y, reach.y], [o.z, d.z, reach.z]];
        for (axis, [o, d, reach]) in axes.into_iter().enumerate() {
            let eta = ((reach + farthest) * ETA + o.abs() * f32::EPSILON).copysign(d);
            let inverse = 1.0 / d.abs().max(smallest).copysign(d);
            (o + eta).store(&mut slabs.near_origin[axis]);
            (o - eta).store(&mut slabs.far_origin[axis]);
            inverse.store(&mut slabs.inverse[axis]);
        }
        slabs
    }

    /// One ray in registers.
    #[inline(always)]
    pub(super) fn splat<S: Simd>(&self, s: S, lane: usize) -> WideSlabs<S> {
        let sign = [self.inverse[0][lane], self.inverse[1][lane], self.inverse[2][lane]];
        WideSlabs {
            near_origin: splat(s, &self.near_origin, lane),
            far_origin: splat(s, &self.far_origin, lane),
            inverse: splat(s, &self.inverse, lane),
            negative: [
                usize::from(sign[0].is_sign_negative()),
                usize::from(sign[1].is_sign_negative()),
                usize::from(sign[2].is_sign_negative()),
            ],
        }
    }
}

#[inline(always)]
fn splat<S: Simd>(s: S, x: &[[f32; MAX_LANES]; 3], lane: usize) -> [f32x8<S>; 3] {
    [f32x8::splat(s, x[0][lane]), f32x8::splat(s, x[1][lane]), f32x8::splat(s, x[2][lane])]
}

/// One ray, prepared for the test of boxes, in registers.
pub(super) struct WideSlabs<S: Simd> {
    near_origin: [f32x8<S>; 3],
    far_origin: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    /// By axis, 1 if d is negative and the near planes are the maxima.
    negative: [usize; 3],
}

impl<S: Simd> WideSlabs<S> {
    /// Distances greater than 0 at which the ray enters the node's boxes, and the boxes that it hits before `t_max`.
    #[inline(always)]
    pub fn meet(&self, s: S, node: &Node, t_max: f32) -> (f32x8<S>, mask32x8<S>) {
        // The least positive number: 0 has two signs, and which one comes first would be up to the processor.
        const START: f32 = f32::from_bits(1);
        let (near_x, far_x) = self.axis::<0>(s, node);
        let (near_y, far_y) = self.axis::<1>(s, node);
        let (near_z, far_z) = self.axis::<2>(s, node);
        let near = near_x.max(near_y).max(near_z.max(f32x8::splat(s, START)));
        let far = far_x.min(far_y).min(far_z.min(f32x8::splat(s, t_max)));
        (near, near.simd_le(far))
    }

    #[inline(always)]
    fn axis<const AXIS: usize>(&self, s: S, node: &Node) -> (f32x8<S>, f32x8<S>) {
        let planes = &node.bounds[AXIS];
        let near = f32x8::load_array_ref(s, &planes[self.negative[AXIS] & 1]);
        let far = f32x8::load_array_ref(s, &planes[(self.negative[AXIS] & 1) ^ 1]);
        ((near - self.near_origin[AXIS]) * self.inverse[AXIS], (far - self.far_origin[AXIS]) * self.inverse[AXIS])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    /// 7 u (A + B) with u = ε/2, A the farthest that the scene is from the origin along the axis, B that along any, and the rounding of
    /// the moved origin.
    #[test]
    fn boxes_are_widened_by_the_possible_rounding_along_each_axis() {
        let bounds = Bounds { min: [-3.0, 1.0, -50.0], max: [5.0, 40.0, 7.0] };
        let (o, d) = ([2.0f32, -6.0, 9.0], [0.3f32, -0.6, 0.2]);
        let slabs = Slabs::new(One, V::splat(One, o), V::splat(One, d), &bounds);
        let reach = [5.0f32, 46.0, 59.0];
        for axis in 0..3 {
            let wider = (3.5 * (reach[axis] + 59.0) + o[axis].abs()) * f32::EPSILON * d[axis].signum();
            let off = [slabs.near_origin[axis][0] - (o[axis] + wider), slabs.far_origin[axis][0] - (o[axis] - wider)];
            assert!(off.iter().all(|off| off.abs() <= f32::EPSILON * o[axis].abs()), "{axis}: {off:?} of {wider}");
            assert_eq!(slabs.inverse[axis][0], 1.0 / d[axis]);
        }
    }
}
