//! The cuboid, or any parallelepiped: three pairs of parallel planes, tested as one shape.
//!
//! T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986. A ray hits one of the six faces; each is a parallelogram
//! with its own primitive id: see [`super::Shape::pieces`].
use glam::{DMat3, DVec3};

use super::fraction::Fraction;
use noisefall_base::math::{Lanes, Pick, U, V};

/// The cuboid, anchored at one of its corners: its points have coordinates in [0, 1] along the edges from there.
#[derive(Clone, Copy, Debug)]
pub struct Cuboid {
    anchor: [f32; 3],
    slabs: [[f32; 3]; 3],
    /// The numbers of the three faces at the anchor.
    faces: [u32; 3],
}

impl Cuboid {
    /// origin + `edges` x with x in [0, 1]³, anchored at its corner nearest to `near`.
    pub fn new(origin: DVec3, edges: DMat3, near: DVec3) -> Cuboid {
        let place = edges.inverse() * (near - origin);
        let (mut anchor, mut outwards, mut faces) = (origin, edges, [0, 2, 4]);
        for (axis, face) in faces.iter_mut().enumerate() {
            if place[axis] > 0.5 {
                anchor += edges.col(axis);
                *outwards.col_mut(axis) = -edges.col(axis);
                *face += 1;
            }
        }
        let slabs = outwards.inverse();
        let slabs = std::array::from_fn(|axis| slabs.row(axis).as_vec3().to_array());
        Cuboid { anchor: anchor.as_vec3().to_array(), slabs, faces }
    }

    /// The nearest intersection of o + td with t > 0, and the number of its face.
    #[inline(always)]
    pub(super) fn intersect<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (Fraction<L>, U<L>) {
        // Slower than this a ray does not cross a slab in any scene; and nothing is divided by 0.
        const SLOWEST: f32 = 1e-30;
        let from_anchor = o - self.anchor;
        let (mut enter, mut leave) = (l.f(f32::NEG_INFINITY), l.f(f32::INFINITY));
        let (mut entered, mut left) = (l.u(0), l.u(0));
        for (slab, face) in self.slabs.iter().zip(self.faces) {
            let (place, speed) = (from_anchor.dot_with(*slab), d.dot_with(*slab));
            let inverse = 1.0 / speed.abs().max(l.f(SLOWEST)).copysign(speed);
            let (here, there) = (-(place * inverse), (1.0 - place) * inverse);
            let onwards = speed.ge(l.f(0.0));
            let (first, last) = (onwards.pick(here, there), onwards.pick(there, here));
            let first_face = onwards.pick(l.u(face), l.u(face ^ 1));
            let (later, sooner) = (enter.lt(first), last.lt(leave));
            enter = later.pick(first, enter);
            entered = later.pick(first_face, entered);
            leave = sooner.pick(last, leave);
            left = sooner.pick(first_face ^ 1, left);
        }
        let outside = enter.above(0.0);
        let meets = leave.ge(enter) & leave.above(0.0);
        let t = Fraction { numerator: outside.pick(enter, leave), denominator: l.f(1.0) };
        (t.only(meets), outside.pick(entered, left))
    }
}

/// A face in f64: its corner, and edges whose cross product points outwards. Images stand upright on the sides; the second edge
/// points upwards, and to −z on the top and z on the bottom.
pub(super) fn face(origin: DVec3, edges: &DMat3, number: usize) -> (DVec3, [DVec3; 2]) {
    let (axis, far) = (number / 2, number % 2 == 1);
    let [x, y, z] = [edges.x_axis, edges.y_axis, edges.z_axis];
    let corner = if far { origin + edges.col(axis) } else { origin };
    match (axis, far) {
        (0, false) => (corner, [z, y]),
        (0, true) => (corner + z, [-z, y]),
        (1, false) => (corner, [x, z]),
        (1, true) => (corner + z, [x, -z]),
        (_, false) => (corner + x, [-x, y]),
        (_, true) => (corner, [x, y]),
    }
}
