//! Flat shapes: parallelogram, triangle and ellipse, which differ only in their outline.
//!
//! The plane is anchored like [`super::sphere`], with curvature 0: a point q on it near the scene and the unit normal n.
use glam::{DMat3, DVec3, Vec3};

use super::{SurfacePoint, fraction::Fraction, shape::Outline};
use noisefall_base::math::{F, Lanes, M, Pick, V};

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
    /// Builds the shape of [`super::Shape::Flat`], anchored at about its point nearest to `near`.
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
    /// The outline is −1 for a rectangle with a large solid angle from `near`, a point in the middle of the scene.
    pub(super) fn rows(&self, edges: [DVec3; 2], near: DVec3) -> [[f32; 4]; 4] {
        let area = edges[0].cross(edges[1]).length() * self.outline.area();
        let [a, b] = [edges[0].as_vec3(), edges[1].as_vec3()];
        let orthogonal = edges[0].dot(edges[1]).abs() < 1e-7 * edges[0].length() * edges[1].length();
        // Of a smaller one few points are near enough for its solid angle to be worth its cost.
        let large = area > 0.5 * Vec3::from(self.anchor).as_dvec3().distance_squared(near);
        let rectangle = large && orthogonal && self.outline == Outline::Parallelogram;
        let outline = if rectangle { -1.0 } else { self.outline as u32 as f32 };
        [self.u, self.v, [a.x, a.y, a.z, outline], [b.x, b.y, b.z, area as f32]]
    }

    /// Upper bounds of the error of the height over this piece, and of its coordinates u and v, where a ray hits its closed
    /// shape. They are sums of products with vectors within the shape, whose extent along the world axes is `extent`.
    pub(super) fn roundings(&self, extent: DVec3) -> [f32; 4] {
        const ROUNDINGS: f64 = 4.0 * f32::EPSILON as f64;
        let of = |g: [f32; 3]| (Vec3::from(g).as_dvec3().abs().dot(extent) * ROUNDINGS) as f32;
        let [[ux, uy, uz, _], [vx, vy, vz, _]] = [self.u, self.v];
        [of(self.normal), of([ux, uy, uz]), of([vx, vy, vz]), 0.0]
    }

    /// The intersection with o + td, t > 0, as a fraction; NaN if there is none.
    #[inline(always)]
    pub(super) fn intersect<L: Lanes>(&self, o: V<L>, d: V<L>) -> Fraction<L> {
        let from_anchor = o - self.anchor;
        let nearing = -d.dot_with(self.normal);
        let height = from_anchor.dot_with(self.normal);
        let one = height.splat(1.0);
        let numerator = height * one.copysign(nearing);
        let denominator = nearing.abs();
        // The coordinates of the intersection, times the denominator.
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

/// Tests an outline as stored in the rows.
#[inline(always)]
pub(super) fn is_rectangle<L: Lanes>(outline: F<L>) -> M<L> {
    outline.below(0.0)
}

/// Tests an outline as stored in the rows.
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

/// Moves a point of a piece of a closed shape inside the outline, far enough to stay on the inner side of the adjacent pieces,
/// whose rounding differs: see [`Flat::roundings`] for the row of bounds.
#[inline(always)]
pub(super) fn within_outline<L: Lanes>(
    rows: &[[F<L>; 4]; 4],
    [of_height, of_u, of_v, _]: [F<L>; 4],
    from_anchor: V<L>,
    point: &SurfacePoint<L>,
) -> SurfacePoint<L> {
    let [to_u, to_v, a, b] = rows;
    let (grad_u, grad_v) = (V { x: to_u[0], y: to_u[1], z: to_u[2] }, V { x: to_v[0], y: to_v[1], z: to_v[2] });
    let (u, v) = (grad_u.dot(from_anchor) + to_u[3], grad_v.dot(from_anchor) + to_v[3]);
    let error = point.error + of_height;
    let margin_u = (grad_u.length_squared().sqrt() * error + of_u) * 2.0;
    let margin_v = (grad_v.length_squared().sqrt() * error + of_v) * 2.0;
    let in_square = (u.max(margin_u).min(1.0 - margin_u), v.max(margin_v).min(1.0 - margin_v));
    let is_triangle = a[3].above(Outline::Parallelogram as u32 as f32) & !is_ellipse(a[3]);
    let in_triangle = ((1.0 - margin_u - margin_v) / (in_square.0 + in_square.1)).min(u.splat(1.0));
    let beside = is_triangle.pick(in_triangle, u.splat(1.0));
    let radius = (u * u + v * v).sqrt();
    let shrink = ((1.0 - margin_u.max(margin_v)) / radius).min(u.splat(1.0));
    let round = is_ellipse(a[3]);
    let (to_u, to_v) = (round.pick(u * shrink, in_square.0 * beside), round.pick(v * shrink, in_square.1 * beside));
    let way = V { x: a[0], y: a[1], z: a[2] } * (to_u - u) + V { x: b[0], y: b[1], z: b[2] } * (to_v - v);
    SurfacePoint { p: point.p + way, n_geometric: point.n_geometric, error }
}
