//! The cone of directions towards a sphere, to sample it by solid angle.
//!
//! P. Shirley et al., "Monte Carlo Techniques for Direct Lighting Calculations" (1996), in anchored form. With the curvature k
//! and m(x), c(x) of [`super`], |m| is the distance from the centre in radii and k c = |m|² − 1, so there is no cancellation for
//! a sphere that almost touches x, or is tiny and far away.
use std::f32::consts::TAU;

use crate::sampling::warp::cap;
use noisefall_base::math::{F, Frame, Lanes, M, Pick, V};

/// The directions from a point to a sphere: a cone from outside, all directions from inside.
pub struct Cone<L: Lanes> {
    /// Unit direction to the centre.
    pub axis: V<L>,
    /// One less the cosine of the half angle; 2 from inside.
    pub one_less_cos: F<L>,
    /// Square of the sine of the half angle; 1 from inside.
    pub sin_squared: F<L>,
    /// Lanes whose point is outside the sphere, and so sees its front.
    pub outside: M<L>,
}

impl<L: Lanes> Cone<L> {
    /// Builds the cone from the two rows of a sphere.
    #[inline(always)]
    pub(in crate::geometry) fn of_sphere([qx, qy, qz, k]: [F<L>; 4], [nx, ny, nz, _]: [F<L>; 4], x: V<L>) -> Cone<L> {
        // The square of the smallest distance from the centre, in radii, from which the direction to it is computed.
        const CENTRAL: f32 = 1e-20;
        let from_anchor = x - V { x: qx, y: qy, z: qz };
        let normal = V { x: nx, y: ny, z: nz };
        let m = normal + from_anchor * k;
        let distance_squared = m.length_squared();
        let c = from_anchor.length_squared() * k + from_anchor.dot(normal) * 2.0;
        let outside = c.above(0.0);
        let to_center = m * (-1.0 / distance_squared.sqrt());
        let up = V { x: k.splat(0.0), y: k.splat(0.0), z: k.splat(1.0) };
        let axis = distance_squared.above(CENTRAL).pick(to_center, up);
        let sin_squared = outside.pick((1.0 / distance_squared).min(k.splat(1.0)), k.splat(1.0));
        let cos = (k * c / distance_squared).max(k.splat(0.0)).sqrt();
        let one_less_cos = outside.pick(sin_squared / (1.0 + cos), k.splat(2.0));
        Cone { axis, one_less_cos, sin_squared, outside }
    }

    /// The constant pdf of directions in the cone, per solid angle.
    #[inline(always)]
    pub fn pdf(&self) -> F<L> {
        1.0 / (self.one_less_cos * TAU)
    }

    /// Samples a unit direction in the cone.
    #[inline(always)]
    pub fn sample(&self, u: (F<L>, F<L>)) -> V<L> {
        Frame::new(self.axis).world_from_local(cap(self.one_less_cos, u))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    fn v([x, y, z]: [f32; 3]) -> V<One> {
        V { x: F(x), y: F(y), z: F(z) }
    }

    /// The cone of the sphere of radius 2 around (1, 2, 3).
    fn cone(x: [f32; 3]) -> Cone<One> {
        Cone::of_sphere([1.0, 2.0, 5.0, 0.5].map(F), [0.0, 0.0, 1.0, 0.0].map(F), v(x))
    }

    #[test]
    fn a_sphere_is_seen_in_the_cone_of_its_tangents() {
        // The distance is 4: sin of the half angle is 1/2.
        let outside = cone([1.0, 2.0, -1.0]);
        let one_less_cos = 1.0 - 0.75f32.sqrt();
        assert!(outside.outside.0 && (outside.sin_squared.0 - 0.25).abs() < 1e-6);
        assert!((outside.one_less_cos.0 - one_less_cos).abs() < 1e-6 && outside.axis.lane(0) == [0.0, 0.0, 1.0]);
        assert!((outside.pdf().0 * TAU * one_less_cos - 1.0).abs() < 1e-5);
        // From inside all directions are sampled.
        let inside = cone([1.0, 2.0, 4.0]);
        assert!(!inside.outside.0 && inside.axis.lane(0) == [0.0, 0.0, -1.0]);
        assert_eq!((inside.one_less_cos.0, inside.sin_squared.0, inside.pdf().0), (2.0, 1.0, 1.0 / (2.0 * TAU)));
        assert_eq!(cone([1.0, 2.0, 3.0]).axis.lane(0), [0.0, 0.0, 1.0], "at the centre any axis does");
    }

    /// Rounding may leave a point outside whose distance is less than the radius.
    #[test]
    fn a_cone_never_opens_beyond_a_half_space() {
        let normal = 1.0 - f32::EPSILON / 2.0;
        let touching = Cone::<One>::of_sphere([0.0, 0.0, 0.0, 1.0].map(F), [0.0, 0.0, normal, 0.0].map(F), v([0.0, 0.0, 1e-12]));
        assert!(touching.outside.0);
        assert!(touching.sin_squared.0 == 1.0 && (0.9999..=1.0).contains(&touching.one_less_cos.0));
    }

    #[test]
    fn samples_fill_the_cone() {
        for x in [[1.0, 2.0, -1.0], [4.0, 0.0, 3.5], [1.0, 2.5, 3.0]] {
            let cone = cone(x);
            let (mut least, mut most) = (2.0f32, 0.0f32);
            for i in 0..1024 {
                let [u, v] = [i % 32, i / 32].map(|i| F((i as f32 + 0.5) / 32.0));
                let d = cone.sample((u, v));
                assert!((d.length_squared().0 - 1.0).abs() < 1e-5);
                let below = 1.0 - d.dot(cone.axis).0;
                (least, most) = (least.min(below), most.max(below));
            }
            let height = cone.one_less_cos.0;
            assert!(most <= height + 1e-5 && most > 0.9 * height && least < 0.01 * height, "{x:?}: {least} {most} {height}");
        }
    }
}
