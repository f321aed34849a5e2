//! Curves with a thickness, as meshes with smooth normals.
use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use noisefall_scene::model::Model;

/// A point of a curve: x, y, z and the radius of the tube around it, m.
pub type CurvePoint = DVec4;

/// A uniform cubic B-spline (de Boor 1972, with equal distances of knots) at t in 0..1 between the middle two of four points.
pub fn spline(p: &[CurvePoint; 4], t: f64) -> CurvePoint {
    let (s, t2, t3) = (1.0 - t, t * t, t * t * t);
    let weights = [s * s * s, 3.0 * t3 - 6.0 * t2 + 4.0, 3.0 * (t + t2 - t3) + 1.0, t3];
    p.iter().zip(weights).map(|(p, weight)| *p * (weight / 6.0)).sum()
}

/// A cubic Bézier curve at t in 0..1, by the polynomials of Bernstein.
pub fn bezier(p: &[CurvePoint; 4], t: f64) -> CurvePoint {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    p.iter().zip(weights).map(|(p, weight)| *p * weight).sum()
}

/// A mesh of tubes and balls. u runs around them from 0 to 1; v is given.
pub struct TubeMesh {
    model: Model,
    /// Quads of each ring.
    sides: u32,
}

impl TubeMesh {
    /// An empty mesh, with room for so many vertices.
    pub fn new(sides: u32, vertices: usize) -> TubeMesh {
        let model = Model {
            vertices: Vec::with_capacity(vertices),
            triangles: Vec::with_capacity(2 * vertices),
            normals: Some(Vec::with_capacity(vertices)),
            uvs: Some(Vec::with_capacity(vertices)),
            ..Model::default()
        };
        TubeMesh { model, sides }
    }

    /// Number of vertices of a tube around so many points.
    pub fn vertices_of_tube(points: usize, sides: u32) -> usize {
        points.saturating_mul(sides as usize + 1)
    }

    /// Number of vertices of a ball.
    pub fn vertices_of_ball(sides: u32) -> usize {
        TubeMesh::vertices_of_tube(rings_of_ball(sides) as usize, sides)
    }

    /// Adds a tube around points with their v, open at both ends.
    pub fn add_tube(&mut self, line: &[(CurvePoint, f64)]) {
        let mut side = DVec3::ZERO;
        for (i, &(point, v)) in line.iter().enumerate() {
            let step = line[(i + 1).min(line.len() - 1)].0 - line[i.saturating_sub(1)].0;
            let along = step.xyz().try_normalize().unwrap_or(DVec3::Z);
            // The frame follows the curve without twisting.
            side = (side - along * side.dot(along)).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
            let other = along.cross(side);
            // Where the tube gets thinner, its surface leans forward.
            let lean = DVec2::new(step.xyz().length(), -step.w).try_normalize().unwrap_or(DVec2::X);
            self.add_ring(v, |sin, cos| {
                let outward = side * cos + other * sin;
                [point.xyz() + outward * point.w, outward * lean.x + along * lean.y]
            });
        }
        self.join_rings(line.len() as u32);
    }

    /// Adds a ball.
    pub fn add_ball(&mut self, ball: CurvePoint, v: f64) {
        let rings = rings_of_ball(self.sides);
        for ring in 0..rings {
            let (from_pole, height) = (PI * (1.0 - f64::from(ring) / f64::from(rings - 1))).sin_cos();
            self.add_ring(v, |sin, cos| {
                let outward = DVec3::new(from_pole * cos, from_pole * sin, height);
                [ball.xyz() + outward * ball.w, outward]
            });
        }
        self.join_rings(rings);
    }

    /// The mesh.
    pub fn into_model(self) -> Model {
        self.model
    }

    /// Adds a ring of vertices, the first one twice. `vertex` returns position and normal for the sine and cosine of an angle.
    fn add_ring(&mut self, v: f64, vertex: impl Fn(f64, f64) -> [DVec3; 2]) {
        for corner in 0..=self.sides {
            let turn = f64::from(corner) / f64::from(self.sides);
            let (sin, cos) = (TAU * turn).sin_cos();
            let [at, normal] = vertex(sin, cos).map(|vector| vector.as_vec3().to_array());
            self.model.vertices.push(at);
            self.model.normals.get_or_insert_default().push(normal);
            self.model.uvs.get_or_insert_default().push([turn as f32, v as f32]);
        }
    }

    /// Joins the last rings by quads.
    fn join_rings(&mut self, rings: u32) {
        let around = self.sides + 1;
        let first = self.model.vertices.len() as u32 - rings * around;
        for ring in 0..rings.saturating_sub(1) {
            for corner in 0..self.sides {
                let a = first + ring * around + corner;
                self.model.triangles.extend([[a, a + 1, a + 1 + around], [a, a + 1 + around, a + around]]);
            }
        }
    }
}

fn rings_of_ball(sides: u32) -> u32 {
    (sides / 2 + 1).max(3)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// Checks that the front of each triangle is the side of its normals, and that normals have unit length.
    fn check(model: &Model) {
        let normals = model.normals.as_ref().expect("it is smooth");
        assert!(normals.iter().all(|normal| (Vec3::from(*normal).length() - 1.0).abs() < 1e-6));
        for triangle in &model.triangles {
            let [a, b, c] = triangle.map(|i| Vec3::from(model.vertices[i as usize]));
            let normal: Vec3 = triangle.iter().map(|i| Vec3::from(normals[*i as usize])).sum();
            assert!((b - a).cross(c - a).dot(normal) >= 0.0);
        }
    }

    #[test]
    fn a_cone_has_the_normals_of_its_surface() {
        let mut mesh = TubeMesh::new(8, 18);
        mesh.add_tube(&[(CurvePoint::new(0.0, 0.0, 0.0, 2.0), 0.0), (CurvePoint::new(3.0, 0.0, 0.0, 1.0), 1.0)]);
        let model = mesh.into_model();
        check(&model);
        assert_eq!((model.vertices.len(), model.triangles.len()), (18, 16));
        for (at, normal) in model.vertices.iter().zip(model.normals.as_ref().expect("it is smooth")) {
            let (at, normal) = (Vec3::from(*at), Vec3::from(*normal));
            let apex = Vec3::new(6.0, 0.0, 0.0);
            assert!(normal.dot(apex - at).abs() < 1e-5, "the surface runs to the apex");
            assert!((at.with_x(0.0).length() - (2.0 - at.x / 3.0)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_ball_is_round_and_closed() {
        let mut mesh = TubeMesh::new(32, TubeMesh::vertices_of_ball(32));
        mesh.add_ball(CurvePoint::new(1.0, 2.0, 3.0, 0.5), 0.25);
        let model = mesh.into_model();
        check(&model);
        assert_eq!(model.vertices.len(), TubeMesh::vertices_of_ball(32));
        let volume: f32 = model
            .triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|i| Vec3::from(model.vertices[i as usize]) - Vec3::new(1.0, 2.0, 3.0));
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        let exact = 4.0 / 3.0 * std::f32::consts::PI * 0.125;
        assert!((volume / exact - 1.0).abs() < 0.02, "{volume} of {exact}");
    }

    #[test]
    fn splines_pass_through_their_ends() {
        let p = [0.0, 1.0, 3.0, 2.0].map(|x| CurvePoint::new(x, 0.0, 0.0, 0.1 + x));
        assert_eq!([0.0, 1.0].map(|t| bezier(&p, t).x), [0.0, 2.0]);
        assert!((spline(&p, 0.0).x - (0.0 + 4.0 + 3.0) / 6.0).abs() < 1e-12);
        assert!((spline(&p, 1.0).x - (1.0 + 12.0 + 2.0) / 6.0).abs() < 1e-12);
        assert!((spline(&p, 0.5).w - 0.1 - spline(&p, 0.5).x).abs() < 1e-12, "the radius follows the same curve");
    }
}
