//! Curves, as ribbons.
use glam::{DVec3, Vec3};

use super::Built;
use crate::import::{
    pbrt::{import::Import, parameters::Entity},
    tube::{CurvePoint, TubeMesh, bezier, spline},
};
use noisefall_scene::scene::SceneError;

/// Pieces of each segment and sides of the tube around a curve, and where there are many points.
const DETAIL: [u32; 2] = [8, 16];
const LITTLE_DETAIL: [u32; 2] = [2, 4];
const MANY_POINTS: usize = 256;

impl Import {
    /// A curve as a tube. Cubic Bézier curves and B-splines are followed; others are straight lines.
    pub(super) fn curve(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let points: Vec<DVec3> =
            super::meshes::triples(entity, "P")?.into_iter().map(|point| Vec3::from(point).as_dvec3()).collect();
        let width = entity.float("width", 1.0)?;
        let widths = [entity.float("width0", width)?, entity.float("width1", width)?];
        let is_spline = entity.text("basis").is_some_and(|basis| basis == "bspline");
        let degree = entity.integer("degree", 3)?;
        entity.ignore(&["type", "N"]);
        let [count, sides] = if points.len() > MANY_POINTS { LITTLE_DETAIL } else { DETAIL };
        // Widths belong to places along the curve, and not to its points.
        let points: Vec<CurvePoint> = points.into_iter().map(|point| point.extend(0.0)).collect();
        let line: Vec<CurvePoint> = match (degree, is_spline) {
            (3, false) => points.array_windows().step_by(3).flat_map(|p| pieces(count, |t| bezier(p, t))).collect(),
            (3, true) => points.array_windows().flat_map(|p| pieces(count, |t| spline(p, t))).collect(),
            _ => points,
        };
        if line.len() < 2 {
            return Err(entity.error("the curve has too few points", "a segment of degree 3 has four points"));
        }
        self.remark(entity, &format!("a tube with {sides} sides"), "the curve has edges, and its ribbon is round");
        let mut tube = TubeMesh::new(sides, TubeMesh::vertices_of_tube(line.len(), sides));
        let last = (line.len() - 1) as f64;
        let with_width = |(i, point): (usize, CurvePoint)| {
            let v = i as f64 / last;
            (point.with_w(0.5 * (widths[0] + (widths[1] - widths[0]) * v)), v)
        };
        tube.add_tube(&line.into_iter().enumerate().map(with_width).collect::<Vec<_>>());
        Ok(self.mesh("curve", tube.into_model(), 1))
    }
}

/// Points of a segment, both ends included.
fn pieces(count: u32, point: impl Fn(f64) -> CurvePoint) -> Vec<CurvePoint> {
    (0..=count).map(|i| point(f64::from(i) / f64::from(count))).collect()
}
