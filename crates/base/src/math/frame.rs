//! The local frame at a surface point.
use super::{
    lanes::{F, Lanes},
    number::Pick,
    vector::V,
};

/// An orthonormal right-handed basis (t, b, n) whose third axis is the given unit vector.
///
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3: no branch, no singular direction.
#[derive(Clone, Copy)]
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
        let exists = (tangent.length_squared() * 1e-10).lt(square) & square.below(f32::MAX);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::One;

    fn dot(a: V<One>, b: [f32; 3]) -> f32 {
        a.dot_with(b).0
    }

    #[test]
    fn the_frame_follows_the_tangent_and_its_turn() {
        let n = V::splat(One, [0.0, 0.6, 0.8]);
        let tangent = V::splat(One, [3.0, 1.2, 1.6]);
        for turns in [0.0f32, 0.1, 0.25, 0.7] {
            let (sin, cos) = (turns * std::f32::consts::TAU).sin_cos();
            let frame = Frame::along(n, tangent, (F(cos), F(sin)));
            // The tangent's part in the surface is x; n × x is (0, 0.8, −0.6).
            let expected = [cos, 0.8 * sin, -0.6 * sin];
            assert!((dot(frame.t, expected) - 1.0).abs() < 1e-6, "{turns}: {:?}", frame.t.lane(0));
            let b = n.cross(frame.t);
            assert!((b.dot(frame.b).0 - 1.0).abs() < 1e-6 && frame.t.dot(n).0.abs() < 1e-6);
        }
    }

    #[test]
    fn without_a_tangent_the_frame_is_the_usual_one() {
        let n = V::splat(One, [0.48, 0.6, 0.64]);
        for tangent in [[0.0; 3], [0.48, 0.6, 0.64], [f32::NAN, 0.0, 0.0], [f32::INFINITY, 0.0, 0.0]] {
            let frame = Frame::along(n, V::splat(One, tangent), (F(0.0), F(1.0)));
            let usual = Frame::new(n);
            assert_eq!(frame.t.lane(0), usual.t.lane(0), "{tangent:?}");
            assert!((frame.b.dot(usual.b).0 - 1.0).abs() < 1e-6);
        }
    }
}
