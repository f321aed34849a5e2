//! Surface coordinates of an isosurface, and directions towards an emitting one.
use super::Isosurface;
use crate::geometry::{
    Cone, Coordinates, DirectionSample,
    sphere::{sphere_tangents, sphere_uv},
};
use noisefall_base::math::{F, Lanes, Pick, V};

impl Isosurface {
    /// Longitude and latitude around the middle of the box, like those of a sphere, and their tangents along the surface. They
    /// are continuous except at the half-plane from the middle towards +x and at the vertical axis through the middle.
    #[inline(always)]
    pub fn coordinates<L: Lanes>(&self, l: L, p: V<L>) -> (Coordinates<L>, [V<L>; 2]) {
        // Where the surface is seen from the middle along itself, its directions are not followed further than this.
        const STEEPEST: f32 = 0.05;
        let from_middle = p - self.middle;
        let distance = from_middle.length_squared().sqrt();
        let r = from_middle * (1.0 / distance);
        let (u, v) = sphere_uv(r);
        let n = self.surface_point(l, p).n_geometric;
        let (along_u, along_v) = sphere_tangents(r, distance);
        let across = r.dot(n);
        let across = across.abs().max(l.f(STEEPEST)).copysign(across);
        (Coordinates { u, v }, [along_u - r * (along_u.dot(n) / across), along_v - r * (along_v.dot(n) / across)])
    }

    /// The cone of directions from `x` to the sphere around the box.
    #[inline(always)]
    fn cone<L: Lanes>(&self, l: L, x: V<L>) -> Cone<L> {
        let half = [0, 1, 2].map(|axis| 0.5 * (self.max[axis] - self.min[axis]));
        let radius = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
        // Anchored at its top.
        let [mx, my, mz] = self.middle;
        let (zero, one) = (l.f(0.0), l.f(1.0));
        Cone::of_sphere([l.f(mx), l.f(my + radius), l.f(mz), l.f(1.0 / radius)], [zero, one, zero, zero], x)
    }

    /// Samples a direction towards the sphere around the box. Only the ray can tell whether it hits the surface.
    #[inline(always)]
    pub fn toward<L: Lanes>(&self, l: L, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let cone = self.cone(l, x);
        let wi = cone.sample(u);
        let t = self.intersect(l, x, wi, l.f(f32::INFINITY));
        let met = t.above(0.0);
        let point = self.surface_point(l, x + wi * met.pick(t, l.f(0.0)));
        DirectionSample { wi, pdf: met.pick(cone.pdf(), l.f(0.0)), front: point.n_geometric.dot(wi).below(0.0) }
    }

    /// The pdf of [`Isosurface::toward`] per solid angle.
    #[inline(always)]
    pub fn pdf_toward<L: Lanes>(&self, l: L, x: V<L>) -> F<L> {
        self.cone(l, x).pdf()
    }

    /// f at a point.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, l: L, p: V<L>) -> F<L> {
        super::surface::value(l, &self.expression.tape, p)
    }
}
