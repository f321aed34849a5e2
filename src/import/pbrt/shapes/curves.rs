//! Curves, as ribbons.
use glam::{DVec3, Vec3};

use super::Built;
use crate::{
    import::pbrt::{import::Import, parameters::Entity},
    model::Model,
    scene::SceneError,
};

/// Pieces of each segment, and where there are many of them.
const PIECES: u32 = 8;
const FEW_PIECES: u32 = 2;
const MANY_POINTS: usize = 256;
/// Sides of the tube around a curve.
const SIDES: u32 = 4;

impl Import {
    /// A curve as a tube with four sides. Cubic Bézier curves and B-splines are followed; others are straight lines.
    pub(super) fn curve(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let points: Vec<DVec3> =
            super::meshes::triples(entity, "P")?.into_iter().map(|point| Vec3::from(point).as_dvec3()).collect();
        let width = entity.float("width", 1.0)?;
        let widths = [entity.float("width0", width)?, entity.float("width1", width)?];
        let is_spline = entity.text("basis").is_some_and(|basis| basis == "bspline");
        let degree = entity.integer("degree", 3)?;
        entity.ignore(&["type", "N"]);
        let count = if points.len() > MANY_POINTS { FEW_PIECES } else { PIECES };
        let line: Vec<DVec3> = match (degree, is_spline) {
            (3, false) => points.windows(4).step_by(3).flat_map(|p| pieces(count, |t| bezier(p, t))).collect(),
            (3, true) => points.windows(4).flat_map(|p| pieces(count, |t| spline(p, t))).collect(),
            _ => points,
        };
        if line.len() < 2 {
            return Err(entity.error("the curve has too few points", "a segment of degree 3 has four points"));
        }
        self.remark(entity, "a tube with four sides", "the curve has edges, and its ribbon is round");
        Ok(self.mesh("curve", tube(&line, widths), 1))
    }
}

/// Points of a segment, both ends included.
fn pieces(count: u32, point: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    (0..=count).map(|i| point(f64::from(i) / f64::from(count))).collect()
}

fn bezier(p: &[DVec3], t: f64) -> DVec3 {
    let s = 1.0 - t;
    p[0] * s * s * s + p[1] * 3.0 * s * s * t + p[2] * 3.0 * s * t * t + p[3] * t * t * t
}

/// A uniform cubic B-spline.
fn spline(p: &[DVec3], t: f64) -> DVec3 {
    let (s, t2, t3) = (1.0 - t, t * t, t * t * t);
    let weights = [s * s * s, 3.0 * t3 - 6.0 * t2 + 4.0, 3.0 * (t + t2 - t3) + 1.0, t3];
    p.iter().zip(weights).map(|(p, w)| *p * (w / 6.0)).sum()
}

fn tube(line: &[DVec3], widths: [f64; 2]) -> Model {
    let mut model = Model::default();
    let mut side = DVec3::ZERO;
    for (i, point) in line.iter().enumerate() {
        let along = (line[(i + 1).min(line.len() - 1)] - line[i.saturating_sub(1)]).try_normalize().unwrap_or(DVec3::Z);
        // The frame follows the curve without twisting.
        side = (side - along * side.dot(along)).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
        let other = along.cross(side);
        let radius = 0.5 * (widths[0] + (widths[1] - widths[0]) * i as f64 / (line.len() - 1) as f64);
        for corner in 0..SIDES {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(corner) / f64::from(SIDES)).sin_cos();
            model.vertices.push((*point + (side * cos + other * sin) * radius).as_vec3().to_array());
        }
    }
    for ring in 0..line.len() as u32 - 1 {
        for corner in 0..SIDES {
            let [a, b] = [corner, (corner + 1) % SIDES].map(|corner| ring * SIDES + corner);
            model.triangles.extend([[a, b, b + SIDES], [a, b + SIDES, a + SIDES]]);
        }
    }
    model
}
