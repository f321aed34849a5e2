//! Directions towards triangles of an emitting mesh, uniform over their area.
use super::Mesh;
use crate::{geometry::DirectionSample, sampling::warp::triangle as warp};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

impl Mesh {
    /// See [`crate::geometry::Shapes::toward`].
    #[inline(always)]
    pub fn toward<L: Lanes>(&self, l: L, triangle: U<L>, x: V<L>, u: (F<L>, F<L>)) -> DirectionSample<L> {
        let [a, b, c] = self.positions(l, triangle);
        let (s, t) = warp(u);
        let wi = (a + ((b - a) * s + (c - a) * t) - x).normalized();
        let (pdf, front) = self.density(l, triangle, x, wi);
        DirectionSample { wi, pdf, front }
    }

    /// The pdf of [`Mesh::toward`] per solid angle.
    #[inline(always)]
    pub fn pdf_toward<L: Lanes>(&self, l: L, triangle: U<L>, x: V<L>, wi: V<L>) -> F<L> {
        self.density(l, triangle, x, wi).0
    }

    /// A point of triangles, uniform over their area.
    #[inline(always)]
    pub fn sample_area<L: Lanes>(&self, l: L, triangle: U<L>, u: (F<L>, F<L>)) -> V<L> {
        let [a, b, c] = self.positions(l, triangle);
        let (s, t) = warp(u);
        a + ((b - a) * s + (c - a) * t)
    }

    /// The pdf of [`Mesh::sample_area`] per area.
    #[inline(always)]
    pub fn area_pdf<L: Lanes>(&self, l: L, triangle: U<L>) -> F<L> {
        let [a, b, c] = self.positions(l, triangle);
        2.0 / (b - a).cross(c - a).length_squared().sqrt()
    }

    /// The pdf t²/(A |cos θ|) with 2A n = (b − a) × (c − a), and whether the front is visible.
    #[inline(always)]
    fn density<L: Lanes>(&self, l: L, triangle: U<L>, x: V<L>, wi: V<L>) -> (F<L>, M<L>) {
        let [a, b, c] = self.positions(l, triangle);
        let doubled = (b - a).cross(c - a);
        let height = (x - a).dot(doubled);
        let nearing = wi.dot(doubled).abs();
        let t = height / nearing;
        let exists = height.abs().above(0.0) & nearing.above(0.0);
        (exists.pick(2.0 * t * t / nearing, l.f(0.0)), height.above(0.0))
    }
}
