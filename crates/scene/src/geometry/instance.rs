//! Shapes in local space: meshes, isosurfaces and all that move.
use std::sync::Arc;

use fearless_simd::Simd;
use fearless_simd_macros::simd;
use glam::DAffine3;

use super::{
    Coordinates, DirectionSample, MISS, PrimitiveRef, SurfacePoint,
    bounding_sphere::BoundingSphere,
    bvh::{Search, Stacks},
    isosurface::Isosurface,
    lists::Lists,
    mesh::Mesh,
    motion::Motion,
    shape::Shape,
    step::TransformStep,
    tables::Tables,
    transform::{LaneTransform, StaticTransform},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// A shape with its transform to world space.
pub(super) struct Instance {
    /// Its first primitive.
    pub first: u32,
    pub body: Body,
    still: DAffine3,
    at_rest: StaticTransform,
    motion: Vec<TransformStep>,
    /// Local space is world space.
    is_world: bool,
    /// Bounding sphere over its whole motion.
    bounding_sphere: BoundingSphere,
}

pub(super) enum Body {
    Mesh(Arc<Mesh>),
    Isosurface(Arc<Isosurface>),
    Shape(Box<Tables>, Box<Lists>),
}

/// The intersection of a ray with an instance: distance in world space, position in the body, triangle.
pub(super) struct Intersection<L: Lanes> {
    /// NaN or infinite if there is none.
    pub t: F<L>,
    pub piece: U<L>,
    pub element: U<L>,
}

impl Instance {
    /// Places a body. `shape` is the whole shape in world space at time 0.
    pub fn new(first: u32, body: Body, still: DAffine3, motion: &Motion, shape: &Shape) -> Instance {
        let is_world = motion.0.is_empty() && still == DAffine3::IDENTITY;
        let (center, radius) = shape.swept_sphere(motion);
        let (at_rest, bounding_sphere) = (StaticTransform::new(&still), BoundingSphere::new(center, radius));
        Instance { first, body, still, at_rest, motion: motion.0.clone(), is_world, bounding_sphere }
    }

    /// The lanes whose ray may hit it.
    #[inline(always)]
    pub fn near<L: Lanes>(&self, live: M<L>, o: V<L>, d: V<L>) -> M<L> {
        live & self.bounding_sphere.near(o, d)
    }

    /// The map to world space at time 0.
    pub fn still(&self) -> &DAffine3 {
        &self.still
    }

    #[inline(always)]
    pub(super) fn transform<L: Lanes>(&self, l: L, time: F<L>) -> LaneTransform<L> {
        LaneTransform::new(l, &self.at_rest, &self.motion, time)
    }

    /// The first intersection with o + td, d of unit length, and t > 0. Lanes with a limit of 0 cost almost nothing.
    #[simd]
    pub fn closest<L: Lanes, const COUNTS: bool>(
        &self,
        l: L,
        stacks: &mut Stacks<COUNTS>,
        ray: (V<L>, V<L>),
        time: F<L>,
        search: Search<L>,
    ) -> Intersection<L> {
        self.meet(l, l.token(), stacks, ray, time, search)
    }

    /// The first intersection, where a mesh is tested with the instructions of `s`, for any lanes.
    #[inline(always)]
    pub fn meet<L: Lanes, S: Simd, const COUNTS: bool>(
        &self,
        l: L,
        s: S,
        stacks: &mut Stacks<COUNTS>,
        (o, d): (V<L>, V<L>),
        time: F<L>,
        search: Search<L>,
    ) -> Intersection<L> {
        if self.is_world {
            return self.meet_in_body(l, s, stacks, (o, d), search);
        }
        let transform = self.transform(l, time);
        let local = transform.vector_to_local(d);
        let speed = local.length_squared().sqrt();
        let ray = (transform.point_to_local(o), local * (1.0 / speed));
        let search = Search { limit: search.limit * speed, enough: search.enough * speed };
        let found = self.meet_in_body(l, s, stacks, ray, search);
        Intersection { t: found.t / speed, ..found }
    }

    #[inline(always)]
    fn meet_in_body<L: Lanes, S: Simd, const COUNTS: bool>(
        &self,
        l: L,
        s: S,
        stacks: &mut Stacks<COUNTS>,
        (o, d): (V<L>, V<L>),
        search: Search<L>,
    ) -> Intersection<L> {
        let zero = l.u(0);
        match &self.body {
            Body::Mesh(mesh) => {
                let (t, element) = mesh.closest_by(s, l, stacks, (o, d), search);
                let none = element.is(MISS);
                Intersection { t: none.pick(l.f(f32::INFINITY), t), piece: zero, element: none.pick(zero, element) }
            }
            Body::Isosurface(surface) => Intersection { t: surface.intersect(l, o, d, search.limit), piece: zero, element: zero },
            Body::Shape(_, list) => {
                let (t, piece) = list.closest(l, o, d);
                Intersection { t, piece, element: zero }
            }
        }
    }

    /// The surface at a point `p` in world space.
    #[simd]
    pub fn surface_point<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, p: V<L>) -> SurfacePoint<L> {
        if self.is_world {
            return self.local_point(l, place, p);
        }
        let transform = self.transform(l, place.time);
        let there = transform.point_to_local(p);
        let local = self.local_point(l, place, there);
        let normal = transform.normal_to_world(local.n_geometric);
        let stretch = 1.0 / normal.length_squared().sqrt();
        let n_geometric = normal * stretch;
        // The point moves along the normal as it does there, so that the inverse of the transform is not needed exactly.
        let height = (there - local.p).dot(local.n_geometric);
        SurfacePoint {
            p: p - n_geometric * (height * stretch),
            n_geometric,
            error: (local.error + transform.rounding(p)) * stretch + p.max_abs() * (4.0 * f32::EPSILON),
        }
    }

    #[inline(always)]
    fn local_point<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, p: V<L>) -> SurfacePoint<L> {
        match &self.body {
            Body::Mesh(mesh) => {
                let point = mesh.surface_point(l, place.element, p);
                SurfacePoint { p: point.p, n_geometric: point.n_geometric, error: point.error }
            }
            Body::Isosurface(surface) => surface.surface_point(l, p),
            Body::Shape(tables, _) => tables.surface_point(l, self.piece(place), p),
        }
    }

    /// Surface coordinates of a point, and the directions of their gradients.
    #[simd]
    pub fn coordinates<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> (Coordinates<L>, [V<L>; 2]) {
        let transform = self.transform(l, place.time);
        let p = transform.point_to_local(point.p);
        let (coordinates, [u, v]) = match &self.body {
            Body::Mesh(mesh) => mesh.coordinates(l, place.element, p),
            Body::Isosurface(surface) => surface.coordinates(l, p),
            Body::Shape(tables, _) => {
                let local = tables.surface_point(l, self.piece(place), p);
                let (u, v) = tables.tangents(l, self.piece(place), &local);
                (tables.coordinates(l, self.piece(place), &local), [u, v])
            }
        };
        (coordinates, [transform.vector_to_world(u), transform.vector_to_world(v)])
    }

    /// The given tangents of a mesh; see [`Shapes::axes`](super::Shapes::axes). The mask is false where there are none.
    #[simd]
    pub fn given_axes<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> ([V<L>; 2], M<L>) {
        match &self.body {
            Body::Mesh(mesh) if mesh.has_tangents() => {
                let transform = self.transform(l, place.time);
                let ([t, b], are_given) = mesh.given_axes(l, place.element, transform.point_to_local(point.p));
                ([transform.vector_to_world(t), transform.vector_to_world(b)], are_given)
            }
            _ => ([point.n_geometric; 2], l.first(0)),
        }
    }

    /// The interpolated normal of a smooth mesh, unit; elsewhere the geometric one.
    #[simd]
    pub fn smooth_normal<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> V<L> {
        match &self.body {
            Body::Mesh(mesh) if mesh.is_smooth() => {
                let transform = self.transform(l, place.time);
                let normal = mesh.smooth_normal(l, place.element, transform.point_to_local(point.p));
                transform.normal_to_world(normal).normalized()
            }
            _ => point.n_geometric,
        }
    }

    /// The interpolated colour and opacity of a mesh's vertices; 1 elsewhere.
    #[simd]
    pub fn vertex_colour<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> [F<L>; 4] {
        match &self.body {
            Body::Mesh(mesh) => {
                let transform = self.transform(l, place.time);
                mesh.vertex_colour(l, place.element, transform.point_to_local(point.p))
            }
            _ => [l.f(1.0); 4],
        }
    }

    /// A direction from `x` towards a primitive; see [`super::Shapes::toward`].
    #[simd]
    pub fn toward<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let transform = self.transform(l, place.time);
        let there = transform.point_to_local(x);
        let local = match &self.body {
            Body::Mesh(mesh) => mesh.toward(l, place.element, there, u),
            Body::Isosurface(surface) => surface.toward(l, there, u),
            Body::Shape(tables, _) => tables.toward(l, self.piece(place), there, u),
        };
        let wi = transform.vector_to_world(local.wi).normalized();
        DirectionSample { wi, pdf: local.pdf * stretch(&transform, wi), front: local.front }
    }

    /// The pdf of [`Instance::toward`] per solid angle.
    #[simd]
    pub fn pdf_toward<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, x: V<L>, wi: V<L>) -> F<L> {
        let transform = self.transform(l, place.time);
        let (x, local) = (transform.point_to_local(x), transform.vector_to_local(wi).normalized());
        let pdf = match &self.body {
            Body::Mesh(mesh) => mesh.pdf_toward(l, place.element, x, local),
            Body::Isosurface(surface) => surface.pdf_toward(l, x),
            Body::Shape(tables, _) => tables.pdf_toward(l, self.piece(place), x, local),
        };
        pdf * stretch(&transform, wi)
    }

    /// A point of a primitive; see [`super::Shapes::sample_area`].
    #[simd]
    pub fn sample_area<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, u: (F<L>, F<L>)) -> V<L> {
        let local = match &self.body {
            Body::Mesh(mesh) => mesh.sample_area(l, place.element, u),
            // Light that leaves an isosurface is not sampled.
            Body::Isosurface(_) => V::splat(l, [0.0; 3]),
            Body::Shape(tables, _) => tables.sample_area(l, self.piece(place), u),
        };
        self.transform(l, place.time).point_to_world(local)
    }

    /// The pdf of [`Instance::sample_area`] per area. A map of the axes A turns an area with the unit normal n into |det A|/|Aᵀ n| of it.
    #[simd]
    pub fn area_pdf<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> F<L> {
        let transform = self.transform(l, place.time);
        let local = match &self.body {
            Body::Mesh(mesh) => mesh.area_pdf(l, place.element),
            Body::Isosurface(_) => l.f(0.0),
            Body::Shape(tables, _) => tables.area_pdf(l, self.piece(place), transform.point_to_local(point.p)),
        };
        let [a, b, c] = transform.axes;
        let n = point.n_geometric;
        let along = V { x: a.dot(n), y: b.dot(n), z: c.dot(n) };
        local * along.length_squared().sqrt() / a.dot(b.cross(c)).abs()
    }

    #[inline(always)]
    pub(super) fn piece<L: Lanes>(&self, place: &PrimitiveRef<L>) -> U<L> {
        place.primitive + self.first.wrapping_neg()
    }
}

/// The factor from a pdf per solid angle in local space to one in world space: |det G| / |G ω|³, where G is the map to local
/// space.
#[inline(always)]
fn stretch<L: Lanes>(transform: &LaneTransform<L>, wi: V<L>) -> F<L> {
    let square = transform.vector_to_local(wi).length_squared();
    transform.rows[0].dot(transform.rows[1].cross(transform.rows[2])).abs() / (square * square.sqrt())
}
