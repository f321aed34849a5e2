//! The cone of directions towards a sphere, to sample it by solid angle.
//!
//! P. Shirley et al., "Monte Carlo Techniques for Direct Lighting Calculations" (1996), in anchored form. With the curvature k
//! and m(x), c(x) of [`super`], |m| is the distance from the centre in radii and k c = |m|² − 1, so there is no cancellation for
//! a sphere that almost touches x, or is tiny and far away.
use std::f32::consts::TAU;

use crate::{
    math::{F, Frame, Lanes, M, Pick, V},
    sampling::warp::cap,
};

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
