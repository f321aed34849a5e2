//! The sphere, in *anchored* form: a point q on it near the scene, the outward unit normal n there, and the curvature k = 1/R.
//!
//! Let m(x) = n + k(x − q), the normal at points of the sphere, and c(x) = k|x − q|² + 2(x − q)·n, about twice the distance from
//! the sphere. A ray o + td hits the sphere where k t² + 2 b t + c(o) = 0 with b = m(o)·d. Neither the centre nor R² appears, so
//! nothing large is subtracted: a wall of radius 10⁶ is as exact as a plane, and k = 0 is one. The discriminant is taken at the
//! point of the ray nearest the anchor, so that a ball of radius 10⁻⁶ seen from far away is exact too. (The second is the idea of
//! E. Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7, moved to the
//! anchor.)
mod cone;
mod coordinates;
#[cfg(test)]
mod tests;

pub use self::cone::Cone;
use glam::DVec3;

pub use self::coordinates::{sphere_tangents, sphere_uv};

use super::{fraction::Fraction, surface_point::SurfacePoint};
use noisefall_base::math::{F, Lanes, Pick, V};

/// An anchored sphere. Its front is the outside.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    anchor: [f32; 3],
    normal: [f32; 3],
    curvature: f32,
}

impl Sphere {
    /// Anchors the sphere at its point nearest to `near`, which should lie in the middle of the scene.
    pub fn new(center: DVec3, radius: f64, near: DVec3) -> Sphere {
        let n = (near - center).try_normalize().unwrap_or(DVec3::Y).as_vec3();
        // The rounded normal is taken as the exact one, so that anchor, normal and radius describe one sphere.
        let anchor = center + n.as_dvec3().normalize() * radius;
        Sphere { anchor: anchor.as_vec3().to_array(), normal: n.to_array(), curvature: (1.0 / radius) as f32 }
    }

    /// The nearest intersection with o + td, d of unit length, with t > 0, as a fraction; NaN if there is none. `None` if no lane
    /// has one.
    #[inline(always)]
    pub(super) fn intersect<L: Lanes>(&self, o: V<L>, d: V<L>) -> Option<Fraction<L>> {
        let from_anchor = o - self.anchor;
        let along = from_anchor.dot(d);
        let nearest = from_anchor - d * along;
        let n_d = d.dot_with(self.normal);
        let c_nearest = nearest.length_squared() * self.curvature + nearest.dot_with(self.normal) * 2.0;
        let discriminant = n_d * n_d - c_nearest * self.curvature;
        let b = along * self.curvature + n_d;
        let c = c_nearest + along * (b + n_d);

        // With w = |b| + √discriminant the roots are w/k and c/w in size, without cancellation. c < 0 is inside, b < 0 is
        // towards the anchor's side: from outside the first intersection is c/w if the ray comes nearer, else there is none; from
        // inside it is the one root that lies ahead. On the surface, c = 0, a ray either leaves or meets the far side.
        let nearing = b.below(0.0);
        let meets = (nearing | c.below(0.0)) & discriminant.ge(c.splat(0.0));
        if !meets.any() {
            return None;
        }
        let w = b.abs() + discriminant.sqrt();
        let far_side = nearing & !c.above(0.0);
        let numerator = far_side.pick(w, c.abs());
        let denominator = far_side.pick(w.splat(self.curvature), w);
        Some(Fraction { numerator: meets.pick(numerator, w.splat(f32::NAN)), denominator })
    }

    /// The cone of directions from `x` to this sphere.
    #[inline(always)]
    pub fn seen_from<L: Lanes>(&self, l: L, x: V<L>) -> Cone<L> {
        let [[qx, qy, qz, k], [nx, ny, nz, _]] = self.rows();
        Cone::of_sphere([l.f(qx), l.f(qy), l.f(qz), l.f(k)], [l.f(nx), l.f(ny), l.f(nz), l.f(0.0)], x)
    }

    /// The rows of the table that [`surface_point`] reads.
    pub(super) fn rows(&self) -> [[f32; 4]; 2] {
        let ([qx, qy, qz], [nx, ny, nz]) = (self.anchor, self.normal);
        [[qx, qy, qz, self.curvature], [nx, ny, nz, 0.0]]
    }
}

/// The point of the sphere with these rows that is nearest to `p`, which is off the surface only by rounding.
#[inline(always)]
pub(super) fn surface_point<L: Lanes>(
    [qx, qy, qz, curvature]: [F<L>; 4],
    [nx, ny, nz, _]: [F<L>; 4],
    p: V<L>,
) -> SurfacePoint<L> {
    // The sign of c as `intersect` evaluates it decides on which side of its own sphere a ray starts. The sum of its
    // roundings, each at most u = ε/2, gives |δc| ≤ u (24 k F² + 34 F) with F = |x − q|; on the sphere k F² ≤ 2 F, and F is at
    // most √3 times its largest component, so that half of it is below 36 ε max|xᵢ − qᵢ|. The rest is the rounding of x itself.
    const ROUNDINGS_OF_C: f32 = 36.0 * f32::EPSILON;
    const ROUNDINGS_OF_X: f32 = 4.0 * f32::EPSILON;
    let anchor = V { x: qx, y: qy, z: qz };
    let normal = V { x: nx, y: ny, z: nz };
    let from_anchor = p - anchor;
    let c = from_anchor.length_squared() * curvature + from_anchor.dot(normal) * 2.0;
    let m = normal + from_anchor * curvature;
    let length = m.length_squared().sqrt();
    let n_geometric = m * (1.0 / length);
    let p = p - n_geometric * (c / (length + 1.0));
    let error = from_anchor.max_abs() * ROUNDINGS_OF_C + p.max_abs() * ROUNDINGS_OF_X;
    SurfacePoint { p, n_geometric, error }
}
