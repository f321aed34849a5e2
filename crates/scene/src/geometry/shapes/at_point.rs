//! Properties of surfaces at points in several lanes, each on a shape of its own.
use super::Shapes;
use crate::geometry::{Coordinates, DirectionSample, PrimitiveRef, SurfacePoint, instance::Instance, tables::INSTANCE};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

impl Shapes {
    /// The surface at a point `p` of the given places, none of which may be a [`crate::geometry::MISS`].
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, p: V<L>) -> SurfacePoint<L> {
        let mut point = self.tables.surface_point(l, place.primitive, p);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            point = here.pick(instance.surface_point(l, &rest.within(here, place), p), point);
        }
        point
    }

    /// Surface coordinates of a point.
    #[inline(always)]
    pub fn coordinates<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> Coordinates<L> {
        let mut coordinates = self.tables.coordinates(l, place.primitive, point);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            let (found, _) = instance.coordinates(l, &rest.within(here, place), point);
            coordinates = Coordinates { u: here.pick(found.u, coordinates.u), v: here.pick(found.v, coordinates.v) };
        }
        coordinates
    }

    /// (∂p/∂u, ∂p/∂v) at a point, in metres; neither is zero.
    #[inline(always)]
    pub fn tangents<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> (V<L>, V<L>) {
        let (mut along_u, mut along_v) = self.tables.tangents(l, place.primitive, point);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            let (_, [u, v]) = instance.coordinates(l, &rest.within(here, place), point);
            (along_u, along_v) = (here.pick(u, along_u), here.pick(v, along_v));
        }
        (along_u, along_v)
    }

    /// The directions along which red and green of a normal map tilt the normal on the front, of any length: the tangents of a mesh that
    /// has some, else ∂p/∂u and −∂p/∂v, which are `derivatives`.
    #[inline(always)]
    pub fn axes<L: Lanes>(
        &self,
        l: L,
        place: &PrimitiveRef<L>,
        point: &SurfacePoint<L>,
        (along_u, along_v): (V<L>, V<L>),
    ) -> [V<L>; 2] {
        let mut axes = [along_u, -along_v];
        if !self.have_tangents {
            return axes;
        }
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            let ([t, b], are_given) = instance.given_axes(l, &rest.within(here, place), point);
            axes = [(here & are_given).pick(t, axes[0]), (here & are_given).pick(b, axes[1])];
        }
        axes
    }

    /// The shading normal of a smooth mesh, otherwise the geometric normal.
    #[inline(always)]
    pub fn smooth_normal<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> V<L> {
        let mut normal = point.n_geometric;
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            normal = here.pick(instance.smooth_normal(l, &rest.within(here, place), point), normal);
        }
        normal
    }

    /// The interpolated colour and opacity of a mesh's vertices, from 0 to 1; 1 on other shapes.
    #[inline(always)]
    pub fn vertex_colour<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> [F<L>; 4] {
        let mut colour = [l.f(1.0); 4];
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            let found = instance.vertex_colour(l, &rest.within(here, place), point);
            for (value, found) in colour.iter_mut().zip(found) {
                *value = here.pick(found, *value);
            }
        }
        colour
    }

    /// Samples a direction from `x` towards the given primitives, with the point `u` of the unit square.
    #[inline(always)]
    pub fn toward<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let mut toward = self.tables.toward(l, place.primitive, x, u);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            toward = here.pick(instance.toward(l, &rest.within(here, place), x, u), toward);
        }
        toward
    }

    /// The pdf of [`Shapes::toward`] per solid angle at the unit direction `wi`, in which the given primitives lie.
    #[inline(always)]
    pub fn pdf_toward<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, x: V<L>, wi: V<L>) -> F<L> {
        let mut pdf = self.tables.pdf_toward(l, place.primitive, x, wi);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            pdf = here.pick(instance.pdf_toward(l, &rest.within(here, place), x, wi), pdf);
        }
        pdf
    }

    /// Distance along o + td to where it passes the given primitives: to the plane of flat ones and triangles, to the front of round ones
    /// that are many radii away, otherwise NaN.
    #[inline(always)]
    pub fn pass_distance<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, o: V<L>, d: V<L>) -> F<L> {
        let mut t = self.tables.pass_distance(l, place.primitive, o, d);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            t = here.pick(instance.pass_distance(l, &rest.within(here, place), o, d), t);
        }
        t
    }

    /// Samples a point of the given primitives, with the point `u` of the unit square. It is off the surface by rounding.
    #[inline(always)]
    pub fn sample_area<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, u: (F<L>, F<L>)) -> V<L> {
        let mut p = self.tables.sample_area(l, place.primitive, u);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            p = here.pick(instance.sample_area(l, &rest.within(here, place), u), p);
        }
        p
    }

    /// The pdf of [`Shapes::sample_area`] per area at points of the given primitives; 0 on isosurfaces.
    #[inline(always)]
    pub fn area_pdf<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>, point: &SurfacePoint<L>) -> F<L> {
        let mut pdf = self.tables.area_pdf(l, place.primitive, point.p);
        let mut rest = self.at_instance(l, place);
        while let Some((here, instance)) = rest.next(self) {
            pdf = here.pick(instance.area_pdf(l, &rest.within(here, place), point), pdf);
        }
        pdf
    }

    #[inline(always)]
    fn at_instance<L: Lanes>(&self, l: L, place: &PrimitiveRef<L>) -> AtInstance<L> {
        if self.instances.is_empty() {
            return AtInstance { l, index: l.u(0), rest: l.first(0) };
        }
        let tag = self.tables.tag(l, place.primitive);
        AtInstance { l, index: tag >> 2, rest: (tag & 3).is(INSTANCE) }
    }
}

/// Iterates over instances, with the lanes at each.
struct AtInstance<L: Lanes> {
    l: L,
    index: U<L>,
    rest: M<L>,
}

impl<L: Lanes> AtInstance<L> {
    /// The next shape, and the lanes at it.
    #[inline(always)]
    fn next<'a>(&mut self, shapes: &'a Shapes) -> Option<(M<L>, &'a Instance)> {
        if !self.rest.any() {
            return None;
        }
        let index = self.index.to_array()[self.rest.bits().trailing_zeros() as usize];
        let here = self.rest & self.index.is(index);
        self.rest = self.rest & !here;
        Some((here, &shapes.instances[index as usize]))
    }

    /// The places of these lanes; the others get the first primitive and element of the same shape.
    #[inline(always)]
    fn within(&self, here: M<L>, place: &PrimitiveRef<L>) -> PrimitiveRef<L> {
        let primitive = place.primitive.to_array()[here.bits().trailing_zeros() as usize];
        PrimitiveRef {
            primitive: here.pick(place.primitive, self.l.u(primitive)),
            element: here.pick(place.element, self.l.u(0)),
            time: place.time,
        }
    }
}
