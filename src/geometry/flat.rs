//! Flat shapes: parallelogram, triangle and ellipse, told apart by their outline only.
//!
//! The plane is anchored like [`super::sphere`], with curvature 0: a point q on it near the scene and the unit normal n.
use glam::{DMat3, DVec3};

use super::{fraction::Fraction, shape::Outline};
use crate::math::{F, Lanes, M, V};

/// A flat shape. Its front is the side of the normal.
#[derive(Clone, Copy, Debug)]
pub struct Flat {
    pub(super) anchor: [f32; 3],
    pub(super) normal: [f32; 3],
    /// Gradients of the coordinates u and v, and their values at the anchor.
    pub(super) u: [f32; 4],
    pub(super) v: [f32; 4],
    outline: Outline,
}

impl Flat {
    /// The shape of [`super::Shape::Flat`]; anchored about where it comes nearest to `near`.
    pub fn new(outline: Outline, origin: DVec3, edges: [DVec3; 2], mirrored: bool, near: DVec3) -> Flat {
        let across = edges[0].cross(edges[1]);
        let n = if mirrored { -across } else { across }.normalize();
        let basis = DMat3::from_cols(edges[0], edges[1], n);
        let place = basis.inverse() * (near - origin);
        let least = if outline == Outline::Ellipse { -1.0 } else { 0.0 };
        let anchor = origin + edges[0] * place.x.clamp(least, 1.0) + edges[1] * place.y.clamp(least, 1.0);
        let anchor = anchor.as_vec3();
        // Covectors that are dual to the edges and the normal.
        let dual = basis.inverse().transpose();
        let at_anchor = anchor.as_dvec3() - origin;
        let row = |g: DVec3| {
            let [x, y, z] = g.as_vec3().to_array();
            [x, y, z, g.dot(at_anchor) as f32]
        };
        Flat { anchor: anchor.to_array(), normal: n.as_vec3().to_array(), u: row(dual.x_axis), v: row(dual.y_axis), outline }
    }

    /// The rows of the table: gradients of u and v with their values at the anchor, and the edges, with the outline and the area.
    pub(super) fn rows(&self, edges: [DVec3; 2]) -> [[f32; 4]; 4] {
        let area = edges[0].cross(edges[1]).length() * self.outline.area();
        let [a, b] = [edges[0].as_vec3(), edges[1].as_vec3()];
        [self.u, self.v, [a.x, a.y, a.z, self.outline as u32 as f32], [b.x, b.y, b.z, area as f32]]
    }

    /// The meeting of o + td, t > 0, as a fraction; NaN where there is none.
    #[inline(always)]
    pub(super) fn intersect<L: Lanes>(&self, o: V<L>, d: V<L>) -> Fraction<L> {
        let from_anchor = o - self.anchor;
        let nearing = -d.dot_with(self.normal);
        let height = from_anchor.dot_with(self.normal);
        let one = height.splat(1.0);
        let numerator = height * one.copysign(nearing);
        let denominator = nearing.abs();
        // The coordinates of the meeting, times the denominator.
        let u = coordinate(&self.u, from_anchor) * denominator + gradient(&self.u, d) * numerator;
        let v = coordinate(&self.v, from_anchor) * denominator + gradient(&self.v, d) * numerator;
        let zero = one.splat(0.0);
        let inside = match self.outline {
            Outline::Parallelogram => u.ge(zero) & v.ge(zero) & denominator.ge(u.max(v)),
            Outline::Triangle => u.ge(zero) & v.ge(zero) & denominator.ge(u + v),
            Outline::Ellipse => (denominator * denominator).ge(u * u + v * v),
        };
        Fraction { numerator, denominator }.only(numerator.above(0.0) & inside)
    }
}

/// Of an outline in the rows.
#[inline(always)]
pub(super) fn is_ellipse<L: Lanes>(outline: F<L>) -> M<L> {
    outline.above(Outline::Triangle as u32 as f32)
}

#[inline(always)]
fn gradient<L: Lanes>([x, y, z, _]: &[f32; 4], d: V<L>) -> F<L> {
    d.dot_with([*x, *y, *z])
}

#[inline(always)]
fn coordinate<L: Lanes>(row: &[f32; 4], from_anchor: V<L>) -> F<L> {
    gradient(row, from_anchor) + row[3]
}
