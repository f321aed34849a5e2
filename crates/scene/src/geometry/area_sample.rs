//! Sampling of points on primitives, for light that leaves them, with pdfs per area.
//!
//! Spheres, flat shapes and triangles are sampled uniformly over their area. Ellipsoids and cylinders are sampled uniformly in their
//! local coordinates y = G (x − q): an affine map turns the pdf p' over the unit sphere or cylinder into p' |det G| / |Gᵀ y|.
use std::f32::consts::TAU;

use super::{
    tables::{AtFlat, SPHERE, Tables},
    toward::uniform_on_flat,
};
use crate::sampling::warp::cap;
use noisefall_base::math::{F, Lanes, Pick, U, V, trig::sin_cos_turns};

impl Tables {
    /// Samples a point of the given primitives with the point `u` of the unit square.
    #[inline(always)]
    pub fn sample_area<L: Lanes>(&self, l: L, primitive: U<L>, u: (F<L>, F<L>)) -> V<L> {
        let [x, y, z, curvature] = l.rows(&self.anchors, primitive);
        let [nx, ny, nz, tag] = l.rows(&self.normals, primitive);
        let (anchor, tag) = (V { x, y, z }, tag.bits());
        let mut p = anchor;
        let spheres = (tag & 3).is(SPHERE);
        if spheres.any() {
            let from_anchor = cap(l.f(2.0), u) - V { x: nx, y: ny, z: nz };
            p = spheres.pick(anchor + from_anchor * (1.0 / curvature), p);
        }
        if let Some(AtFlat { here, rows, .. }) = self.flat(l, tag, primitive, anchor) {
            p = here.pick(anchor + uniform_on_flat(&rows, u), p);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            let (sin, cos) = sin_cos_turns(u.0);
            let place = quadric.is_cylinder.pick(V { x: cos, y: sin, z: u.1 }, cap(l.f(2.0), u));
            p = here.pick(quadric.world(place), p);
        }
        p
    }

    /// The pdf of [`Tables::sample_area`] per area at the points `p` of the given primitives.
    #[inline(always)]
    pub fn area_pdf<L: Lanes>(&self, l: L, primitive: U<L>, p: V<L>) -> F<L> {
        let curvature = l.rows(&self.anchors, primitive)[3];
        let tag = self.tag(l, primitive);
        let mut pdf = curvature * curvature * (0.5 / TAU);
        if let Some(AtFlat { here, rows, .. }) = self.flat(l, tag, primitive, p) {
            pdf = here.pick(1.0 / rows[3][3], pdf);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            // A rounded point may lie beside a tiny shape.
            let place = quadric.across(quadric.place(p));
            let steepness = (quadric.gradient(place).length_squared() / place.length_squared()).sqrt();
            let of_unit_shape = quadric.is_cylinder.pick(l.f(1.0 / TAU), l.f(0.5 / TAU));
            pdf = here.pick(of_unit_shape * quadric.determinant() / steepness, pdf);
        }
        pdf
    }
}
