//! Shapes in world space, and triangles that replace them.
use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec3};

use noisefall_base::declare::{Problem, Resources};
use noisefall_scene::{
    geometry::{MeshData, Outline, Shape},
    model::Model,
    scene::description::ObjectDescription,
    shape::{ShapeBuilder, product},
};

/// Triangles along the edge of a disk, and around a cylinder.
const SECTORS: u32 = 256;
/// Bands of a sphere from pole to pole; each has twice as many quads.
const BANDS: u32 = 96;

/// The shapes of an object after its transforms.
pub fn shapes(object: &ObjectDescription, resources: &Resources) -> Result<Vec<Shape>, Problem> {
    let map = product(&object.transform)?;
    let shapes = ShapeBuilder::new(resources).build(&object.shape)?;
    Ok(if map == DAffine3::IDENTITY { shapes } else { shapes.iter().map(|shape| shape.transformed(&map)).collect() })
}

/// The triangles of a mesh in its own space.
pub fn model_of(data: &MeshData) -> Model {
    Model {
        vertices: data.vertices.clone(),
        triangles: data.triangles.clone(),
        normals: (!data.normals.is_empty()).then(|| data.normals.clone()),
        uvs: (!data.uvs.is_empty()).then(|| data.uvs.clone()),
        colours: (!data.colours.is_empty()).then(|| data.colours.clone()),
        tangents: (!data.tangents.is_empty()).then(|| data.tangents.clone()),
        ..Model::default()
    }
}

/// The mesh that stands for a shape with curves; `None` for a shape that is triangles.
pub fn fineness(shape: &Shape) -> Option<String> {
    match shape {
        Shape::Sphere { .. } | Shape::Ellipsoid { .. } => Some(format!("a mesh of {} × {BANDS} quads", 2 * BANDS)),
        Shape::Flat { outline: Outline::Ellipse, .. } | Shape::Cylinder { .. } => {
            Some(format!("a mesh with {SECTORS} edges around"))
        }
        _ => None,
    }
}

/// A direction that points up in an image, for a view along a unit vector.
pub fn upwards(forward: DVec3, up: Option<DVec3>) -> DVec3 {
    up.filter(|up| up.cross(forward).length() > 1e-9 * up.length())
        .unwrap_or_else(|| if forward.y.abs() < 0.9 { DVec3::Y } else { DVec3::X })
}

/// Triangles of a shape that is neither a mesh nor an isosurface, relative to a point near it, with its normals and coordinates.
/// `None` of those two.
pub fn triangles(shape: &Shape, origin: DVec3) -> Option<Model> {
    let mut made = Triangles { origin, model: empty() };
    for piece in shape.pieces() {
        match piece {
            Shape::Sphere { center, radius, turn } => {
                let turned = |d| turn.map_or(d, |turn| turn * d);
                made.ellipsoid(center, &|d| turned(d) * radius, &turned);
            }
            Shape::Ellipsoid { center, axes } => {
                let covector = axes.inverse().transpose();
                made.ellipsoid(center, &|d| axes * d, &|d| (covector * d).normalize());
            }
            Shape::Flat { outline, origin, edges, mirrored } => made.flat(outline, origin, edges, mirrored),
            Shape::Cylinder { base, axes, .. } => {
                let covector = axes.inverse().transpose();
                made.side(&|around, z| {
                    let (sin, cos) = (TAU * around).sin_cos();
                    let n = DVec3::new(cos, sin, 0.0);
                    (base + axes * n.with_z(z), (covector * n).normalize())
                });
            }
            Shape::Cuboid { .. } | Shape::Mesh { .. } | Shape::Isosurface { .. } => return None,
        }
    }
    Some(made.model)
}

fn empty() -> Model {
    Model { normals: Some(Vec::new()), uvs: Some(Vec::new()), ..Model::default() }
}

struct Triangles {
    origin: DVec3,
    model: Model,
}

impl Triangles {
    /// Adds a vertex. v of a model runs upwards.
    fn vertex(&mut self, p: DVec3, n: DVec3, uv: [f64; 2]) {
        self.model.vertices.push((p - self.origin).as_vec3().to_array());
        self.model.normals.get_or_insert_default().push(n.as_vec3().to_array());
        self.model.uvs.get_or_insert_default().push(uv.map(|x| x as f32));
    }

    /// Adds a triangle of the vertices from a number on, turned so that it faces its normals.
    fn triangle(&mut self, corners: [u32; 3]) {
        let Model { vertices, normals, triangles, .. } = &mut self.model;
        let [a, b, c] = corners.map(|i| DVec3::from(vertices[i as usize].map(f64::from)));
        let n: DVec3 =
            corners.iter().map(|i| DVec3::from(normals.as_ref().map_or([0.0; 3], |n| n[*i as usize]).map(f64::from))).sum();
        let [i, j, k] = corners;
        // At the poles of a sphere, quads are triangles.
        if a == b || b == c || c == a {
            return;
        }
        triangles.push(if (b - a).cross(c - a).dot(n) < 0.0 { [i, k, j] } else { corners });
    }

    fn count(&self) -> u32 {
        self.model.vertices.len() as u32
    }

    fn flat(&mut self, outline: Outline, origin: DVec3, edges: [DVec3; 2], mirrored: bool) {
        let n = edges[0].cross(edges[1]).normalize() * if mirrored { -1.0 } else { 1.0 };
        let first = self.count();
        let at = |u: f64, v: f64| origin + edges[0] * u + edges[1] * v;
        match outline {
            Outline::Parallelogram => {
                [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].into_iter().for_each(|[u, v]| self.vertex(at(u, v), n, [u, v]));
                [[0, 1, 2], [0, 2, 3]].into_iter().for_each(|corners| self.triangle(corners.map(|i| first + i)));
            }
            Outline::Triangle => {
                [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].into_iter().for_each(|[u, v]| self.vertex(at(u, v), n, [u, v]));
                self.triangle([0, 1, 2].map(|i| first + i));
            }
            Outline::Ellipse => {
                self.vertex(origin, n, [0.5; 2]);
                for sector in 0..SECTORS {
                    let (sin, cos) = (TAU * f64::from(sector) / f64::from(SECTORS)).sin_cos();
                    self.vertex(at(cos, sin), n, [(cos + 1.0) / 2.0, (sin + 1.0) / 2.0]);
                }
                (0..SECTORS).for_each(|i| self.triangle([first, first + 1 + i, first + 1 + (i + 1) % SECTORS]));
            }
        }
    }

    /// A grid of quads: `columns` around and `rows` up. The last column repeats the first with u = 1.
    fn grid(&mut self, [columns, rows]: [u32; 2], at: &dyn Fn(f64, f64) -> (DVec3, DVec3)) {
        let first = self.count();
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
                let (p, n) = at(if column == columns { 0.0 } else { u }, v);
                self.vertex(p, n, [u, v]);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * (columns + 1) + column;
                let d = a + columns + 1;
                [[a, a + 1, d + 1], [a, d + 1, d]].into_iter().for_each(|corners| self.triangle(corners));
            }
        }
    }

    fn side(&mut self, at: &dyn Fn(f64, f64) -> (DVec3, DVec3)) {
        self.grid([SECTORS, 1], at);
    }

    /// A sphere with the coordinates of ours: u from +x towards −z, v upwards from −y.
    fn ellipsoid(&mut self, center: DVec3, point: &dyn Fn(DVec3) -> DVec3, normal: &dyn Fn(DVec3) -> DVec3) {
        self.grid([2 * BANDS, BANDS], &|u, v| {
            let ((sin_phi, cos_phi), cos) = ((TAU * u).sin_cos(), (PI * v).cos());
            let sin = if v == 1.0 { 0.0 } else { (PI * v).sin() };
            let d = DVec3::new(sin * cos_phi, -cos, -sin * sin_phi);
            (center + point(d), normal(d))
        });
    }
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, Vec3};

    use super::*;

    #[test]
    fn triangles_face_outwards_and_enclose_the_volume() {
        let shapes = [
            (Shape::sphere(DVec3::new(5.0, 1.0, 2.0), 2.0), 4.0 / 3.0 * PI * 8.0),
            (
                Shape::Ellipsoid { center: DVec3::ONE, axes: DMat3::from_diagonal(DVec3::new(1.0, -2.0, 3.0)) },
                4.0 / 3.0 * PI * 6.0,
            ),
            (Shape::cylinder(DVec3::ZERO, DVec3::new(0.0, 3.0, 0.0), 0.5, true), 0.75 * PI),
            (Shape::Cuboid { origin: DVec3::ZERO, edges: DMat3::from_diagonal(DVec3::new(1.0, 2.0, -3.0)) }, 6.0),
        ];
        for (shape, expected) in shapes {
            let model = triangles(&shape, DVec3::ONE).expect("it has triangles");
            let corner = |i: u32| Vec3::from(model.vertices[i as usize]).as_dvec3();
            let volume: f64 = model.triangles.iter().map(|[a, b, c]| corner(*a).dot(corner(*b).cross(corner(*c))) / 6.0).sum();
            assert!((volume / expected - 1.0).abs() < 2e-3, "{}: {volume} instead of {expected}", shape.name());
            let lengths = model.normals.iter().flatten().map(|n| Vec3::from(*n).length());
            assert!(lengths.into_iter().all(|length| (length - 1.0).abs() < 1e-6));
        }
    }
}
