//! Distances along rays to where they pass a primitive that they were sampled towards, also where rounding makes them miss it: see
//! [`super::Shapes::pass_distance`].
use fearless_simd_macros::simd;

use super::{
    Isosurface, PrimitiveRef,
    instance::{Body, Instance},
    mesh::Mesh,
    tables::{AtFlat, SPHERE, Tables},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// From this number of radii on, the thickness of a round shape does not count beside its distance. Rays miss less than 10⁻⁵ of a nearer one
/// by rounding.
const FAR: f32 = 64.0;

impl Tables {
    #[inline(always)]
    pub(super) fn pass_distance<L: Lanes>(&self, l: L, primitive: U<L>, o: V<L>, d: V<L>) -> F<L> {
        let tag = self.tag(l, primitive);
        let mut t = l.f(f32::NAN);
        let spheres = (tag & 3).is(SPHERE);
        let [nx, ny, nz, _] = l.rows(&self.normals, primitive);
        let normal = V { x: nx, y: ny, z: nz };
        if spheres.any() {
            let [x, y, z, curvature] = l.rows(&self.anchors, primitive);
            let from_middle = normal + (o - V { x, y, z }) * curvature;
            t = spheres.pick(to_front(from_middle, d * curvature), t);
        }
        if let Some(AtFlat { here, from_anchor, .. }) = self.flat(l, tag, primitive, o) {
            t = here.pick(from_anchor.dot(normal) / -d.dot(normal), t);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            t = here.pick(to_front(quadric.across(quadric.place(o)), quadric.across(quadric.linear(d))), t);
        }
        t
    }
}

impl Instance {
    /// An affine map does not change distances in units of the direction, so that of local space may have any length.
    #[simd]
    pub(super) fn pass_distance<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, o: V<L>, d: V<L>) -> F<L> {
        let transform = self.transform(l, place.time);
        let (o, d) = (transform.point_to_local(o), transform.vector_to_local(d));
        match &self.body {
            Body::Mesh(mesh) => mesh.pass_distance(l, place.element, o, d),
            Body::Isosurface(surface) => surface.pass_distance(l),
            Body::Shape(tables, _) => tables.pass_distance(l, self.piece(place), o, d),
        }
    }
}

impl Mesh {
    #[inline(always)]
    fn pass_distance<L: Lanes>(&self, l: L, triangle: U<L>, o: V<L>, d: V<L>) -> F<L> {
        let [a, b, c] = self.positions(l, triangle);
        let doubled = (b - a).cross(c - a);
        (o - a).dot(doubled) / -d.dot(doubled)
    }
}

impl Isosurface {
    /// Only directions are sampled towards an isosurface, and no points: those that miss it are meant to.
    #[inline(always)]
    fn pass_distance<L: Lanes>(&self, l: L) -> F<L> {
        l.f(f32::NAN)
    }
}

/// The parameter of the point of o + td that lies a radius before the one nearest to the middle of a round shape; `o` is relative to the
/// middle, both in radii.
#[inline(always)]
fn to_front<L: Lanes>(o: V<L>, d: V<L>) -> F<L> {
    let square = d.length_squared();
    let t = -(o.dot(d) / square + 1.0 / square.sqrt());
    is_far(o).pick(t, t.splat(f32::NAN))
}

/// Whether a point relative to the middle of a round shape, in radii, is far from it.
#[inline(always)]
pub(super) fn is_far<L: Lanes>(from_middle: V<L>) -> M<L> {
    from_middle.length_squared().above(FAR * FAR)
}
