//! Sampling of directions from a point towards a primitive, for light samples, with pdfs per solid angle.
//!
//! Spheres and ellipsoids are sampled by the cone that they subtend, large rectangles by solid angle, other flat shapes and
//! cylinders by area. An affine map A transforms a pdf p' over directions to p(ω) = p' |det A| / |A ω|³.
use std::f32::consts::TAU;

use super::{
    direction_sample::DirectionSample,
    flat::{is_ellipse, is_rectangle},
    pass_distance::is_far,
    quadric::Local,
    rectangle::SphericalRectangle,
    shape::Outline,
    sphere::Cone,
    tables::{AtFlat, SPHERE, Tables, coordinate},
};
use crate::sampling::warp::{disk, triangle};
use noisefall_base::math::{F, Lanes, M, Pick, U, V, trig::sin_cos_turns};

impl Tables {
    /// The cone of directions from `x` to the given primitives; only for spheres.
    #[inline(always)]
    fn cone<L: Lanes>(&self, l: L, primitive: U<L>, x: V<L>) -> Cone<L> {
        Cone::of_sphere(l.rows(&self.anchors, primitive), l.rows(&self.normals, primitive), x)
    }

    /// Samples a direction from `x` towards the given primitives, with the point `u` of the unit square.
    #[inline(always)]
    pub fn toward<L: Lanes>(&self, l: L, primitive: U<L>, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let tag = self.tag(l, primitive);
        let mut toward = DirectionSample { wi: x, pdf: l.f(0.0), front: l.first(0) };
        if (tag & 3).is(SPHERE).any() {
            let cone = self.cone(l, primitive, x);
            toward = DirectionSample { wi: cone.sample(u), pdf: cone.pdf(), front: cone.outside };
        }
        if let Some(AtFlat { here, rows, from_anchor }) = self.flat(l, tag, primitive, x) {
            toward = here.pick(SeenFlat::new(here, rows, from_anchor, l.rows(&self.normals, primitive)).toward(l, u), toward);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            toward = here.pick(toward_quadric(l, &quadric, x, u), toward);
        }
        toward
    }

    /// The pdf of [`Tables::toward`] per solid angle at the unit direction `wi`, in which the given primitives lie.
    #[inline(always)]
    pub fn pdf_toward<L: Lanes>(&self, l: L, primitive: U<L>, x: V<L>, wi: V<L>) -> F<L> {
        let tag = self.tag(l, primitive);
        let mut pdf = if (tag & 3).is(SPHERE).any() { self.cone(l, primitive, x).pdf() } else { l.f(0.0) };
        if let Some(AtFlat { here, rows, from_anchor }) = self.flat(l, tag, primitive, x) {
            pdf = here.pick(SeenFlat::new(here, rows, from_anchor, l.rows(&self.normals, primitive)).pdf(l, wi), pdf);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            let (mut of_cylinder, _) = cylinder_pdf(l, &quadric, x, wi);
            let lost = here & quadric.is_cylinder & !of_cylinder.above(0.0) & is_far(quadric.across(quadric.place(x)));
            if lost.any() {
                of_cylinder = lost.pick(axis_pdf(l, &quadric, x, wi), of_cylinder);
            }
            let of_ellipsoid = seen_from(l, &quadric, x).pdf() * stretch(&quadric, wi);
            pdf = here.pick(quadric.is_cylinder.pick(of_cylinder, of_ellipsoid), pdf);
        }
        pdf
    }
}

/// Flat shapes, seen from points.
struct SeenFlat<L: Lanes> {
    rows: [[F<L>; 4]; 4],
    from_anchor: V<L>,
    n: V<L>,
    /// Height of the point over the plane.
    height: F<L>,
    /// Rectangles that are sampled by solid angle, if there are any.
    spherical: Option<(M<L>, SphericalRectangle<L>)>,
}

impl<L: Lanes> SeenFlat<L> {
    #[inline(always)]
    fn new(here: M<L>, rows: [[F<L>; 4]; 4], from_anchor: V<L>, [nx, ny, nz, _]: [F<L>; 4]) -> Self {
        let n = V { x: nx, y: ny, z: nz };
        let height = from_anchor.dot(n);
        let [to_u, to_v, a, b] = rows;
        let edges = [V { x: a[0], y: a[1], z: a[2] }, V { x: b[0], y: b[1], z: b[2] }];
        let place = [coordinate(to_u, from_anchor), coordinate(to_v, from_anchor)];
        let spherical = SphericalRectangle::of_near(here & is_rectangle(a[3]), edges, place, height);
        SeenFlat { rows, from_anchor, n, height, spherical }
    }

    #[inline(always)]
    fn toward(&self, l: L, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let mut way = self.uniform_over_area(u);
        if let Some((large, rectangle)) = &self.spherical {
            way = large.pick(rectangle.sample(u) - self.n * self.height, way);
        }
        let wi = way.normalized();
        DirectionSample { wi, pdf: self.pdf(l, wi), front: self.height.above(0.0) }
    }

    /// One over the solid angle, or uniform over the area: t²/(A |cos θ|).
    #[inline(always)]
    fn pdf(&self, l: L, wi: V<L>) -> F<L> {
        let cos = wi.dot(self.n).abs();
        let t = self.height / cos;
        let area = self.rows[3][3];
        let mut pdf = t * t / (area * cos);
        if let Some((large, rectangle)) = &self.spherical {
            pdf = large.pick(rectangle.pdf(), pdf);
        }
        let exists = self.height.abs().above(0.0) & cos.above(0.0);
        exists.pick(pdf, l.f(0.0))
    }

    /// The vector to a uniformly sampled point of the area.
    #[inline(always)]
    fn uniform_over_area(&self, u: (F<L>, F<L>)) -> V<L> {
        uniform_on_flat(&self.rows, u) - self.from_anchor
    }
}

/// The vector from the anchor of flat shapes with these rows to a uniformly sampled point of the area.
#[inline(always)]
pub(super) fn uniform_on_flat<L: Lanes>([to_u, to_v, a, b]: &[[F<L>; 4]; 4], u: (F<L>, F<L>)) -> V<L> {
    let outline = a[3];
    let (mut s, mut t) = u;
    let is_ellipse = is_ellipse(outline);
    if is_ellipse.any() {
        let (disk_u, disk_v, _) = disk(u);
        (s, t) = (is_ellipse.pick(disk_u, s), is_ellipse.pick(disk_v, t));
    }
    let is_triangle = outline.above(Outline::Parallelogram as u32 as f32) & !is_ellipse;
    if is_triangle.any() {
        let (triangle_u, triangle_v) = triangle(u);
        (s, t) = (is_triangle.pick(triangle_u, s), is_triangle.pick(triangle_v, t));
    }
    let (s, t) = (s - to_u[3], t - to_v[3]);
    V { x: a[0], y: a[1], z: a[2] } * s + V { x: b[0], y: b[1], z: b[2] } * t
}

#[inline(always)]
fn toward_quadric<L: Lanes>(l: L, quadric: &Local<L>, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
    let [a, b, c] = quadric.axes();
    let cone = seen_from(l, quadric, x);
    let (sin, cos) = sin_cos_turns(u.0);
    let side = V { x: cos, y: sin, z: u.1 };
    let way = quadric.is_cylinder.pick(side - quadric.place(x), cone.sample(u));
    let world = a * way.x + (b * way.y + c * way.z);
    let wi = world.normalized();
    let (mut of_cylinder, mut front) = cylinder_pdf(l, quadric, x, wi);
    let is_far = is_far(quadric.across(quadric.place(x)));
    if is_far.any() {
        let (pdf, enters) = sampled_cylinder_pdf(l, quadric, side, way, world.length_squared().sqrt());
        of_cylinder = is_far.pick(pdf, of_cylinder);
        front = (is_far & enters) | (!is_far & front);
    }
    let of_ellipsoid = cone.pdf() * stretch(quadric, wi);
    DirectionSample {
        wi,
        pdf: quadric.is_cylinder.pick(of_cylinder, of_ellipsoid),
        front: (quadric.is_cylinder & front) | (!quadric.is_cylinder & cone.outside),
    }
}

/// The cone of directions to the unit sphere, in local space.
#[inline(always)]
fn seen_from<L: Lanes>(l: L, quadric: &Local<L>, x: V<L>) -> Cone<L> {
    let (zero, one) = (l.f(0.0), l.f(1.0));
    Cone::of_sphere([zero, zero, zero, one], [quadric.m.x, quadric.m.y, quadric.m.z, zero], quadric.local(x))
}

/// |det G| / |G ω|³.
#[inline(always)]
fn stretch<L: Lanes>(quadric: &Local<L>, wi: V<L>) -> F<L> {
    let square = quadric.linear(wi).length_squared();
    quadric.determinant() / (square * square.sqrt())
}

/// [`cylinder_pdf`] for the sampled point `side` in local coordinates, `distance` metres away in the local direction `way`, and whether the
/// front is hit first. The rounded direction would not tell where it meets a cylinder that is tiny in the view.
#[inline(always)]
fn sampled_cylinder_pdf<L: Lanes>(l: L, quadric: &Local<L>, side: V<L>, way: V<L>, distance: F<L>) -> (F<L>, M<L>) {
    // A line leaves a circle at the angle at which it enters it.
    let nearing = side.x * way.x + side.y * way.y;
    let to_other = -2.0 * nearing / (way.x * way.x + way.y * way.y).max(l.f(1e-30));
    let other_height = side.z + way.z * to_other;
    let other_distance = distance * (1.0 + to_other);
    let has_other = other_distance.above(0.0) & other_height.ge(l.f(0.0)) & l.f(1.0).ge(other_height);
    let squares = distance * distance + has_other.pick(other_distance * other_distance, l.f(0.0));
    let density = squares * distance * quadric.determinant() / nearing.abs().max(l.f(1e-20)) * (1.0 / TAU);
    let enters = nearing.below(0.0);
    (density, enters | has_other)
}

/// The pdf of points that are uniform in angle and height: t²/(2π |∂x/∂φ × ∂x/∂z · ω|), summed over both intersections with the
/// direction, because either may have been sampled; and whether the front is hit first.
#[inline(always)]
fn cylinder_pdf<L: Lanes>(l: L, quadric: &Local<L>, x: V<L>, wi: V<L>) -> (F<L>, M<L>) {
    let [near, far] = quadric.intersections(x, wi);
    let (of_near, met_near, front_near) = density_of_place(l, quadric, x, wi, near.value());
    let (of_far, _, front_far) = density_of_place(l, quadric, x, wi, far.value());
    (of_near + of_far, (met_near & front_near) | (!met_near & front_far))
}

/// [`cylinder_pdf`] of a direction that a point of a far cylinder gave, but that misses it by rounding: as if it met the axis.
#[inline(always)]
fn axis_pdf<L: Lanes>(l: L, quadric: &Local<L>, x: V<L>, wi: V<L>) -> F<L> {
    let (place, way) = (quadric.place(x), quadric.linear(wi));
    let (from_axis, across) = (quadric.across(place), quadric.across(way));
    let square = across.length_squared();
    let t = -from_axis.dot(across) / square;
    let height = place.z + way.z * t;
    let meets = t.above(0.0) & height.ge(l.f(0.0)) & l.f(1.0).ge(height);
    meets.pick(2.0 * t * t * quadric.determinant() / square.sqrt() * (1.0 / TAU), l.f(0.0))
}

/// For the intersection at distance `t`: its pdf, whether it exists, and whether its front is visible.
#[inline(always)]
fn density_of_place<L: Lanes>(l: L, quadric: &Local<L>, x: V<L>, wi: V<L>, t: F<L>) -> (F<L>, M<L>, M<L>) {
    let nearing = quadric.gradient(quadric.place(x + wi * t)).dot(wi);
    let met = t.above(0.0);
    // Infinite only at the very edge that is seen.
    let density = t * t * quadric.determinant() / nearing.abs().max(l.f(1e-20)) * (1.0 / TAU);
    (met.pick(density, l.f(0.0)), met, nearing.below(0.0))
}
