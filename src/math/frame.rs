//! The local frame at a surface point.
use super::{lanes::Lanes, vector::V};

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
