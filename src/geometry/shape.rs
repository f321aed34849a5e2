//! Shapes as a scene describes them: in world space, in f64, placed by transforms.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::{Isosurface, MeshData, cuboid::face};
use crate::math::{One, V};

/// A shape. Every kind but the sphere is closed under affine maps, and a sphere becomes an ellipsoid.
#[derive(Clone, Debug)]
pub enum Shape {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    /// The image of the unit sphere: center + `axes` x, |x| = 1.
    Ellipsoid {
        center: DVec3,
        axes: DMat3,
    },
    /// origin + u `edges[0]` + v `edges[1]` with (u, v) inside the outline.
    Flat {
        outline: Outline,
        origin: DVec3,
        edges: [DVec3; 2],
        /// The front is the side of edges[1] × edges[0].
        mirrored: bool,
    },
    /// origin + `edges` x with x in [0, 1]³.
    Cuboid {
        origin: DVec3,
        edges: DMat3,
    },
    /// base + `axes` x with x² + y² = 1 and z in [0, 1], and the disks at its ends if it is capped.
    Cylinder {
        base: DVec3,
        axes: DMat3,
        capped: bool,
    },
    /// What `map` makes of the triangles; they may be shared with other shapes.
    Mesh {
        data: Arc<MeshData>,
        /// Least and greatest corner of the box around the data.
        bounds: ([f32; 3], [f32; 3]),
        map: DAffine3,
    },
    Isosurface {
        surface: Arc<Isosurface>,
        map: DAffine3,
    },
}

/// Where a flat shape ends, in its coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outline {
    /// u and v in [0, 1].
    Parallelogram,
    /// u and v not negative, u + v ≤ 1.
    Triangle,
    /// u² + v² ≤ 1.
    Ellipse,
}

impl Shape {
    /// A disk with this unit normal.
    pub fn disk(center: DVec3, normal: DVec3, radius: f64) -> Shape {
        let (a, b) = normal.any_orthonormal_pair();
        let edges = if a.cross(b).dot(normal) > 0.0 { [a * radius, b * radius] } else { [b * radius, a * radius] };
        Shape::Flat { outline: Outline::Ellipse, origin: center, edges, mirrored: false }
    }

    pub fn mesh(data: Arc<MeshData>) -> Shape {
        Shape::Mesh { bounds: data.bounds(), data, map: DAffine3::IDENTITY }
    }

    pub fn cylinder(base: DVec3, top: DVec3, radius: f64, capped: bool) -> Shape {
        let (a, b) = (top - base).normalize().any_orthonormal_pair();
        Shape::Cylinder { base, axes: DMat3::from_cols(a * radius, b * radius, top - base), capped }
    }

    /// The same shape after a map that is invertible. The front stays the front, whether the map mirrors or not.
    pub fn transformed(&self, map: &DAffine3) -> Shape {
        let point = |p: &DVec3| map.transform_point3(*p);
        let linear = map.matrix3;
        match self {
            Shape::Sphere { center, radius } => match similarity(&linear) {
                Some(scale) => Shape::Sphere { center: point(center), radius: radius * scale },
                None => Shape::Ellipsoid { center: point(center), axes: linear * *radius },
            },
            Shape::Ellipsoid { center, axes } => Shape::Ellipsoid { center: point(center), axes: linear * *axes },
            Shape::Flat { outline, origin, edges, mirrored } => Shape::Flat {
                outline: *outline,
                origin: point(origin),
                edges: edges.map(|edge| linear * edge),
                mirrored: *mirrored ^ (linear.determinant() < 0.0),
            },
            Shape::Cuboid { origin, edges } => Shape::Cuboid { origin: point(origin), edges: linear * *edges },
            Shape::Cylinder { base, axes, capped } => {
                Shape::Cylinder { base: point(base), axes: linear * *axes, capped: *capped }
            }
            Shape::Mesh { data, bounds, map: before } => Shape::Mesh { data: data.clone(), bounds: *bounds, map: *map * *before },
            Shape::Isosurface { surface, map: before } => Shape::Isosurface { surface: surface.clone(), map: *map * *before },
        }
    }

    /// The smooth pieces of the surface, a primitive each.
    pub fn pieces(&self) -> Vec<Shape> {
        match self {
            Shape::Cuboid { origin, edges } => {
                let mirrored = edges.determinant() < 0.0;
                let piece = |number| {
                    let (origin, edges) = face(*origin, edges, number);
                    Shape::Flat { outline: Outline::Parallelogram, origin, edges, mirrored }
                };
                (0..6).map(piece).collect()
            }
            Shape::Cylinder { base, axes, capped: true } => {
                let (x, y, z) = (axes.x_axis, axes.y_axis, axes.z_axis);
                let mirrored = axes.determinant() < 0.0;
                let cap = |origin, edges| Shape::Flat { outline: Outline::Ellipse, origin, edges, mirrored };
                let side = Shape::Cylinder { base: *base, axes: *axes, capped: false };
                vec![side, cap(*base, [x, -y]), cap(*base + z, [x, y])]
            }
            _ => vec![self.clone()],
        }
    }

    pub fn piece_count(&self) -> usize {
        match self {
            Shape::Cuboid { .. } => 6,
            Shape::Cylinder { capped: true, .. } => 3,
            _ => 1,
        }
    }

    /// What the scene file calls it.
    pub fn name(&self) -> &'static str {
        match self {
            Shape::Sphere { .. } => "sphere",
            Shape::Ellipsoid { .. } => "ellipsoid",
            Shape::Flat { outline: Outline::Parallelogram, .. } => "rectangle",
            Shape::Flat { outline: Outline::Triangle, .. } => "triangle",
            Shape::Flat { outline: Outline::Ellipse, .. } => "disk",
            Shape::Cuboid { .. } => "cuboid",
            Shape::Cylinder { .. } => "cylinder",
            Shape::Mesh { .. } => "mesh",
            Shape::Isosurface { .. } => "isosurface",
        }
    }

    /// Centre and radius of a sphere around the shape.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match self {
            Shape::Sphere { center, radius } => (*center, *radius),
            Shape::Ellipsoid { center, axes } => (*center, longest(axes)),
            Shape::Flat { outline: Outline::Ellipse, origin, edges, .. } => {
                (*origin, longest(&DMat3::from_cols(edges[0], edges[1], DVec3::ZERO)))
            }
            Shape::Flat { outline, origin, edges: [a, b], .. } => {
                let center = match outline {
                    Outline::Triangle => *origin + (*a + *b) / 3.0,
                    Outline::Parallelogram | Outline::Ellipse => *origin + (*a + *b) / 2.0,
                };
                let corners = [*origin, *origin + *a, *origin + *b, *origin + *a + *b];
                let count = if *outline == Outline::Triangle { 3 } else { 4 };
                (center, corners[..count].iter().map(|corner| corner.distance(center)).fold(0.0, f64::max))
            }
            Shape::Cuboid { origin, edges } => {
                let half = |signs: [f64; 2]| (edges.x_axis + edges.y_axis * signs[0] + edges.z_axis * signs[1]).length() / 2.0;
                let diagonals = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(half);
                (*origin + *edges * DVec3::splat(0.5), diagonals.into_iter().fold(0.0, f64::max))
            }
            Shape::Cylinder { base, axes, .. } => {
                let round = longest(&DMat3::from_cols(axes.x_axis, axes.y_axis, DVec3::ZERO));
                (*base + axes.z_axis / 2.0, round + axes.z_axis.length() / 2.0)
            }
            Shape::Mesh { bounds, map, .. } => around(*bounds, map),
            Shape::Isosurface { surface, map } => around(surface.bounds(), map),
        }
    }

    /// How far a cuboid or a cylinder reaches along the axes of the world, from any of its points to another.
    pub(super) fn extent(&self) -> DVec3 {
        match self {
            Shape::Cuboid { edges, .. } => edges.x_axis.abs() + edges.y_axis.abs() + edges.z_axis.abs(),
            Shape::Cylinder { axes, .. } => (axes.x_axis.abs() + axes.y_axis.abs()) * 2.0 + axes.z_axis.abs(),
            _ => DVec3::splat(2.0 * self.bounding_sphere().1),
        }
    }

    /// Whether a point lies inside; nothing lies inside a surface that is open.
    pub fn contains(&self, p: DVec3) -> bool {
        match self {
            Shape::Sphere { center, radius } => p.distance(*center) < *radius,
            Shape::Ellipsoid { center, axes } => (axes.inverse() * (p - *center)).length() < 1.0,
            Shape::Flat { .. } => false,
            Shape::Cuboid { origin, edges } => {
                let x = edges.inverse() * (p - *origin);
                x.min_element() > 0.0 && x.max_element() < 1.0
            }
            Shape::Cylinder { base, axes, capped } => {
                let x = axes.inverse() * (p - *base);
                *capped && x.truncate().length() < 1.0 && (0.0..1.0).contains(&x.z)
            }
            Shape::Mesh { data, bounds, map } => {
                let (center, radius) = around(*bounds, map);
                p.distance(center) <= radius && data.contains(map.inverse().transform_point3(p))
            }
            Shape::Isosurface { surface, map } => {
                let local = map.inverse().transform_point3(p).as_vec3().to_array();
                let (min, max) = surface.bounds();
                let boxed = (0..3).all(|axis| (min[axis]..=max[axis]).contains(&local[axis]));
                boxed && surface.value(One, V::splat(One, local)).0 < 0.0
            }
        }
    }
}

impl Outline {
    /// Area in the coordinates of the shape.
    pub fn area(self) -> f64 {
        match self {
            Outline::Parallelogram => 1.0,
            Outline::Triangle => 0.5,
            Outline::Ellipse => std::f64::consts::PI,
        }
    }
}

/// The sphere around what a map makes of a box.
fn around((min, max): ([f32; 3], [f32; 3]), map: &DAffine3) -> (DVec3, f64) {
    let [min, max] = [min, max].map(|corner| Vec3::from(corner).as_dvec3());
    let half = map.matrix3 * DMat3::from_diagonal((max - min) / 2.0);
    let corner = |signs: [f64; 2]| (half.x_axis + half.y_axis * signs[0] + half.z_axis * signs[1]).length();
    let reach = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(corner).into_iter().fold(0.0, f64::max);
    (map.transform_point3((min + max) / 2.0), reach)
}

/// The factor by which the map scales all lengths alike, if it does.
fn similarity(linear: &DMat3) -> Option<f64> {
    let gram = linear.transpose() * *linear;
    let square = (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
    let rest = gram - DMat3::from_diagonal(DVec3::splat(square));
    let largest = [rest.x_axis, rest.y_axis, rest.z_axis].map(|axis| axis.abs().max_element()).into_iter().fold(0.0, f64::max);
    (largest <= 1e-9 * square).then(|| square.sqrt())
}

/// The longest of the images of unit vectors: the largest singular value, by power iteration; never too small.
fn longest(axes: &DMat3) -> f64 {
    let gram = axes.transpose() * *axes;
    let trace = gram.x_axis.x + gram.y_axis.y + gram.z_axis.z;
    let mut x = DVec3::new(0.6, 0.7, 0.4);
    for _ in 0..60 {
        x = (gram * x).try_normalize().unwrap_or(x);
    }
    // The iteration comes from below.
    (x.dot(gram * x) * (1.0 + 1e-6)).min(trace).sqrt()
}
