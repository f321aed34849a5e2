//! Ellipsoid and the side of a cylinder: the unit sphere and the unit cylinder under an affine map, anchored like
//! [`super::sphere`].
//!
//! A point x has the local coordinates y = G (x − q) from the anchor q, which itself lies at m. For the cylinder, the third
//! components are dropped. Then c(x) = |y|² + 2 y·m vanishes on the surface, and ∇c/2 = Gᵀ(m + y).
use std::f32::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Shape, fraction::Fraction, sphere::sphere_tangents, surface_point::SurfacePoint};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// A quadric. Its front is the outside.
#[derive(Clone, Copy, Debug)]
pub struct Quadric {
    /// Rows of G, each with its component of m; then the anchor, with 1 for a cylinder, 2 for one with caps.
    rows: [[f32; 4]; 4],
}

impl Quadric {
    /// Builds an ellipsoid or the side of a cylinder, which may have caps, anchored near `near`.
    pub fn new(piece: &Shape, capped: bool, near: DVec3) -> Quadric {
        let (origin, axes, cylinder) = match piece {
            Shape::Ellipsoid { center, axes } => (*center, axes, false),
            Shape::Cylinder { base, axes, .. } => (*base, axes, true),
            _ => unreachable!("not a quadric"),
        };
        let g = axes.inverse();
        let y = g * (near - origin);
        let m = if cylinder {
            y.truncate().try_normalize().unwrap_or(DVec2::X).extend(y.z.clamp(0.0, 1.0))
        } else {
            y.try_normalize().unwrap_or(DVec3::Y)
        };
        let anchor = (origin + *axes * m).as_vec3();
        // Where the rounded anchor lies.
        let m = g * (anchor.as_dvec3() - origin);
        let row = |i: usize| {
            let [x, y, z] = g.row(i).as_vec3().to_array();
            [x, y, z, m[i] as f32]
        };
        Quadric {
            rows: [
                row(0),
                row(1),
                row(2),
                [anchor.x, anchor.y, anchor.z, f32::from(u8::from(cylinder)) + f32::from(u8::from(capped))],
            ],
        }
    }

    /// The rows that [`Local::new`] reads.
    pub(super) fn rows(&self) -> [[f32; 4]; 4] {
        self.rows
    }

    /// The nearest intersection with o + td with t > 0; NaN if there is none.
    #[inline(always)]
    pub(super) fn intersect<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> Fraction<L> {
        let [near, far] = self.splat(l).intersections(o, d);
        let first = near.numerator.above(0.0).pick(near, far);
        first.only(first.numerator.above(0.0))
    }

    /// The nearest intersection with a capped cylinder, and the number of its piece.
    #[inline(always)]
    pub(super) fn intersect_solid<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (Fraction<L>, U<L>) {
        self.splat(l).meet_solid(l, o, d)
    }

    #[inline(always)]
    fn splat<L: Lanes>(&self, l: L) -> Local<L> {
        let [a, b, c, q] = self.rows;
        Local::new([splat(l, a), splat(l, b), splat(l, c), splat(l, q)])
    }
}

/// The crossing of a ray with a quadric: distances along the ray in local units, its speed in them per metre, height and slope
/// per unit.
struct Crossing<L: Lanes> {
    ways: [F<L>; 2],
    speed: F<L>,
    z: F<L>,
    climb: F<L>,
}

/// Quadrics in lanes.
pub(super) struct Local<L: Lanes> {
    g: [V<L>; 3],
    /// Local position of the anchor.
    pub m: V<L>,
    anchor: V<L>,
    pub is_cylinder: M<L>,
    is_capped: M<L>,
    /// Weight of the third component: 0 for a cylinder.
    weight: F<L>,
}

impl<L: Lanes> Local<L> {
    #[inline(always)]
    pub fn new([a, b, c, q]: [[F<L>; 4]; 4]) -> Self {
        Local {
            g: [V { x: a[0], y: a[1], z: a[2] }, V { x: b[0], y: b[1], z: b[2] }, V { x: c[0], y: c[1], z: c[2] }],
            m: V { x: a[3], y: b[3], z: c[3] },
            anchor: V { x: q[0], y: q[1], z: q[2] },
            is_cylinder: q[3].above(0.0),
            is_capped: q[3].above(1.0),
            weight: q[3].above(0.0).pick(q[3].splat(0.0), q[3].splat(1.0)),
        }
    }

    /// G v.
    #[inline(always)]
    pub fn linear(&self, v: V<L>) -> V<L> {
        V { x: self.g[0].dot(v), y: self.g[1].dot(v), z: self.g[2].dot(v) }
    }

    /// The local coordinates of x relative to the anchor.
    #[inline(always)]
    pub fn local(&self, x: V<L>) -> V<L> {
        self.linear(x - self.anchor)
    }

    /// Drops the third component of cylinders.
    #[inline(always)]
    pub(super) fn across(&self, v: V<L>) -> V<L> {
        V { z: v.z * self.weight, ..v }
    }

    /// Both intersections with o + td in the order of t, NaN if there are none; t may be negative.
    #[inline(always)]
    pub fn intersections(&self, o: V<L>, d: V<L>) -> [Fraction<L>; 2] {
        let Crossing { ways, speed, z, climb } = self.crossing(o, d);
        let within = [self.is_within(z + climb * ways[0]), self.is_within(z + climb * ways[1])];
        [
            Fraction { numerator: ways[0], denominator: speed }.only(within[0]),
            Fraction { numerator: ways[1], denominator: speed }.only(within[1]),
        ]
    }

    /// Intersects a ray with the sphere, or with the infinite cylinder.
    #[inline(always)]
    fn crossing(&self, o: V<L>, d: V<L>) -> Crossing<L> {
        let (y, e) = (self.local(o), self.linear(d));
        // Along the axis of a cylinder nothing is divided by 0.
        let speed = self.across(e).length_squared().sqrt().max(e.z.splat(1e-30));
        let (from_anchor, d, m) = (self.across(y), self.across(e) * (1.0 / speed), self.across(self.m));
        // As in `super::sphere` with the curvature 1.
        let along = from_anchor.dot(d);
        let nearest = from_anchor - d * along;
        let m_d = m.dot(d);
        let c_nearest = nearest.length_squared() + nearest.dot(m) * 2.0;
        let b = along + m_d;
        let c = c_nearest + along * (b + m_d);
        let w = b.abs() + (m_d * m_d - c_nearest).sqrt();
        let (nearing, quotient) = (b.below(0.0), c / w);
        let ways = [nearing.pick(quotient, -w), nearing.pick(w, -quotient)];
        Crossing { ways, speed, z: self.m.z + y.z, climb: e.z / speed }
    }

    /// The first intersection of o + td with a capped cylinder, t > 0, and its piece: 0 is the side, 1 the base, 2 the top.
    ///
    /// Side and caps are intersected in the same frame, so that no rounding opens a gap between them.
    #[inline(always)]
    fn meet_solid(&self, l: L, o: V<L>, d: V<L>) -> (Fraction<L>, U<L>) {
        // Along the axis a ray crosses the side far away.
        const SLOWEST: f32 = 1e-30;
        let Crossing { ways: [enter_side, leave_side], speed, z, climb } = self.crossing(o, d);
        let inverse = 1.0 / climb.abs().max(l.f(SLOWEST)).copysign(climb);
        let (at_base, at_top) = (-(z * inverse), (1.0 - z) * inverse);
        let upwards = climb.ge(l.f(0.0));
        let (enter_cap, leave_cap) = (upwards.pick(at_base, at_top), upwards.pick(at_top, at_base));
        let (first_cap, last_cap) = (upwards.pick(l.u(1), l.u(2)), upwards.pick(l.u(2), l.u(1)));
        let (through_cap, out_of_cap) = (enter_side.lt(enter_cap), leave_cap.lt(leave_side));
        let enter = through_cap.pick(enter_cap, enter_side);
        let leave = out_of_cap.pick(leave_cap, leave_side);
        let outside = enter.above(0.0);
        let piece = outside.pick(through_cap.pick(first_cap, l.u(0)), out_of_cap.pick(last_cap, l.u(0)));
        let meets = leave.ge(enter) & leave.above(0.0);
        (Fraction { numerator: outside.pick(enter, leave), denominator: speed }.only(meets), piece)
    }

    /// Whether the height `z` lies between the ends of the surface.
    #[inline(always)]
    fn is_within(&self, z: F<L>) -> M<L> {
        (z.ge(z.splat(0.0)) & z.splat(1.0).ge(z)) | !self.is_cylinder
    }

    /// The position of x on the unit sphere or the unit cylinder, in local coordinates.
    #[inline(always)]
    pub fn place(&self, x: V<L>) -> V<L> {
        self.m + self.local(x)
    }

    /// The point in world space at a position on the unit sphere or the unit cylinder.
    #[inline(always)]
    pub fn world(&self, place: V<L>) -> V<L> {
        let [a, b, c] = self.axes();
        let way = place - self.m;
        self.anchor + (a * way.x + (b * way.y + c * way.z))
    }

    /// Gᵀ times the position, without the height of cylinders: along the outward normal.
    #[inline(always)]
    pub fn gradient(&self, place: V<L>) -> V<L> {
        self.g[0] * place.x + (self.g[1] * place.y + self.g[2] * (place.z * self.weight))
    }

    /// Columns of G⁻¹: ∂x/∂y.
    #[inline(always)]
    pub fn axes(&self) -> [V<L>; 3] {
        let [a, b, c] = self.g;
        let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
        let scale = 1.0 / a.dot(bc);
        [bc * scale, ca * scale, ab * scale]
    }

    /// (∂x/∂u, ∂x/∂v) at a position, for the coordinates of [`super::Shapes::coordinates`].
    #[inline(always)]
    pub fn tangents(&self, place: V<L>) -> (V<L>, V<L>) {
        let zero = place.x.splat(0.0);
        let (around, down) = sphere_tangents(place, zero.splat(1.0));
        let around = self.is_cylinder.pick(V { x: -place.y, y: place.x, z: zero } * TAU, around);
        let down = self.is_cylinder.pick(V { x: zero, y: zero, z: zero.splat(-1.0) }, down);
        let [a, b, c] = self.axes();
        (a * around.x + (b * around.y + c * around.z), a * down.x + (b * down.y + c * down.z))
    }

    /// |det G|.
    #[inline(always)]
    pub fn determinant(&self) -> F<L> {
        self.g[0].dot(self.g[1].cross(self.g[2])).abs()
    }

    /// The point of the surface nearest to `p`, which is off the surface only by rounding.
    #[inline(always)]
    pub fn surface_point(&self, p: V<L>) -> SurfacePoint<L> {
        // Half of the rounding of c as `intersections` evaluates it is, as for a sphere, at most 36 ε max|yᵢ|, and each yᵢ has
        // one of 2.5 ε Σⱼ |Gᵢⱼ (x − q)ⱼ| itself. The steepness |∇c|/2 turns that into a distance.
        const ROUNDINGS: f32 = 40.0 * f32::EPSILON;
        const ROUNDINGS_OF_X: f32 = 4.0 * f32::EPSILON;
        let x = p - self.anchor;
        let y = self.across(self.linear(x));
        let gradient = self.gradient(self.m + y);
        let steepness = gradient.length_squared().sqrt();
        let n_geometric = gradient * (1.0 / steepness);
        let c = y.length_squared() + y.dot(self.across(self.m)) * 2.0;
        let p = p - n_geometric * (c * 0.5 / steepness);
        let sizes = absolute_dot(self.g[0], x) + absolute_dot(self.g[1], x) + absolute_dot(self.g[2], x) * self.weight;
        let error = sizes * ROUNDINGS / steepness + p.max_abs() * ROUNDINGS_OF_X;
        SurfacePoint { p: self.is_capped.pick(self.between_caps(p, error), p), n_geometric, error }
    }

    /// Moves a point of the side between the caps, far enough to stay there despite rounding.
    #[inline(always)]
    fn between_caps(&self, p: V<L>, error: F<L>) -> V<L> {
        let z = self.place(p).z;
        let margin = self.g[2].length_squared().sqrt() * error * 2.0;
        p + self.axes()[2] * (z.max(margin).min(1.0 - margin) - z)
    }
}

#[inline(always)]
fn splat<L: Lanes>(l: L, [x, y, z, w]: [f32; 4]) -> [F<L>; 4] {
    [l.f(x), l.f(y), l.f(z), l.f(w)]
}

/// Σ |aᵢ bᵢ|.
#[inline(always)]
fn absolute_dot<L: Lanes>(a: V<L>, b: V<L>) -> F<L> {
    (a.x * b.x).abs() + ((a.y * b.y).abs() + (a.z * b.z).abs())
}
