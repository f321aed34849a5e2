//! Coordinates of an isosurface, and directions towards one that emits.
use super::Isosurface;
use crate::{
    geometry::{Cone, Coordinates, Toward, sphere_tangents, sphere_uv},
    math::{F, Lanes, Pick, V},
};

impl Isosurface {
    /// Longitude and latitude seen from the middle of the box, as those of a sphere, and the directions along the surface in
    /// which they grow. Continuous but for the half-plane from the middle towards +x and the vertical through it.
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

    /// The cone of the sphere around the box, seen from `x`.
    #[inline(always)]
    fn cone<L: Lanes>(&self, l: L, x: V<L>) -> Cone<L> {
        let half = [0, 1, 2].map(|axis| 0.5 * (self.max[axis] - self.min[axis]));
        let radius = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
        // Anchored at its top.
        let [mx, my, mz] = self.middle;
        let (zero, one) = (l.f(0.0), l.f(1.0));
        Cone::of_sphere([l.f(mx), l.f(my + radius), l.f(mz), l.f(1.0 / radius)], [zero, one, zero, zero], x)
    }

    /// A direction into the sphere around the box. What of the surface is met there, if any, only the ray can tell.
    #[inline(always)]
    pub fn toward<L: Lanes>(&self, l: L, x: V<L>, u: (F<L>, F<L>)) -> Toward<L> {
        let cone = self.cone(l, x);
        let wi = cone.sample(u);
        let t = self.intersect(l, x, wi, l.f(f32::INFINITY));
        let met = t.above(0.0);
        let point = self.surface_point(l, x + wi * met.pick(t, l.f(0.0)));
        Toward { wi, pdf: met.pick(cone.pdf(), l.f(0.0)), front: point.n_geometric.dot(wi).below(0.0) }
    }

    /// The density of [`Isosurface::toward`].
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
