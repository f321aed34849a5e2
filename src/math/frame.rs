//! The local frame at a surface point.
use super::{
    lanes::{F, Lanes},
    number::Pick,
    vector::V,
};

/// An orthonormal right-handed basis (t, b, n) whose third axis is the given unit vector.
///
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3: no branch, no singular direction.
pub struct Frame<L: Lanes> {
    t: V<L>,
    b: V<L>,
    n: V<L>,
}

impl<L: Lanes> Frame<L> {
    /// A frame with z along the unit normal n.
    #[inline(always)]
    pub fn new(n: V<L>) -> Self {
        let sign = n.z.splat(1.0).copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let xy = n.x * n.y * a;
        Frame {
            t: V { x: 1.0 + sign * n.x * n.x * a, y: sign * xy, z: -(sign * n.x) },
            b: V { x: xy, y: sign + n.y * n.y * a, z: -n.y },
            n,
        }
    }

    /// A frame with z along the unit normal `n`, and x along the part of `tangent` in the surface, turned about `n` by the angle of
    /// this cosine and sine. Lanes whose tangent has no such part get the frame of [`Frame::new`].
    #[inline(always)]
    pub fn along(n: V<L>, tangent: V<L>, (cos, sin): (F<L>, F<L>)) -> Self {
        let flat = tangent - n * n.dot(tangent);
        let square = flat.length_squared();
        // False for NaN, too.
        let exists = square.above(1e-12 * 1e-12) & square.below(f32::MAX);
        let t = flat * (1.0 / square.sqrt());
        let turned = t * cos + n.cross(t) * sin;
        let t = exists.pick(turned, Frame::new(n).t);
        Frame { t, b: n.cross(t), n }
    }

    /// A local vector in world space.
    #[inline(always)]
    pub fn world_from_local(&self, v: V<L>) -> V<L> {
        self.t * v.x + (self.b * v.y + self.n * v.z)
    }

    /// A vector of world space in the frame.
    #[inline(always)]
    pub fn local_from_world(&self, v: V<L>) -> V<L> {
        V { x: self.t.dot(v), y: self.b.dot(v), z: self.n.dot(v) }
    }
}
