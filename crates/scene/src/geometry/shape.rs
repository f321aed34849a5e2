//! Shapes of scene descriptions: in world space, in f64, after their transforms.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::{Isosurface, MeshData, bounds::Bounds, cuboid::face};
use noisefall_base::math::{One, V};

/// A shape. Every type except the sphere is closed under affine maps, and a sphere becomes an ellipsoid.
#[derive(Clone, Debug)]
pub enum Shape {
    /// All points at one distance from a centre.
    Sphere {
        /// Centre, metres.
        center: DVec3,
        /// Radius, metres.
        radius: f64,
        /// The orthogonal map of its surface coordinates, which are those about the y axis of the world otherwise.
        turn: Option<DMat3>,
    },
    /// The image of the unit sphere: center + `axes` x, |x| = 1.
    Ellipsoid {
        /// Centre, metres.
        center: DVec3,
        /// The half axes, as columns.
        axes: DMat3,
    },
    /// origin + u `edges[0]` + v `edges[1]` with (u, v) inside the outline.
    Flat {
        /// Which part of the plane belongs to the shape.
        outline: Outline,
        /// The point with u = v = 0, metres.
        origin: DVec3,
        /// The vectors along u and v.
        edges: [DVec3; 2],
        /// The front is the side of `edges[1] × edges[0]`.
        mirrored: bool,
    },
    /// origin + `edges` x with x in [0, 1]³.
    Cuboid {
        /// One corner, metres.
        origin: DVec3,
        /// The edges from there, as columns.
        edges: DMat3,
    },
    /// base + `axes` x with x² + y² = 1 and z in [0, 1], and the disks at its ends if it is capped.
    Cylinder {
        /// Centre of one end, metres.
        base: DVec3,
        /// Two radii and the axis, as columns.
        axes: DMat3,
        /// Whether disks close the ends.
        capped: bool,
    },
    /// The image of the triangles under `map`. They may be shared with other shapes.
    Mesh {
        /// The triangles.
        data: Arc<MeshData>,
        /// [Around](MeshData::boxes) the data.
        boxes: Arc<[Bounds]>,
        /// From the space of the data to the world.
        map: DAffine3,
    },
    /// The image of an isosurface under `map`.
    Isosurface {
        /// The formula and its box.
        surface: Arc<Isosurface>,
        /// From the space of the formula to the world.
        map: DAffine3,
    },
}

/// The outline of a flat shape, in its coordinates.
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
    /// A sphere with its surface coordinates about the y axis.
    pub fn sphere(center: DVec3, radius: f64) -> Shape {
        Shape::Sphere { center, radius, turn: None }
    }

    /// A disk with this unit normal.
    pub fn disk(center: DVec3, normal: DVec3, radius: f64) -> Shape {
        let (a, b) = normal.any_orthonormal_pair();
        let edges = if a.cross(b).dot(normal) > 0.0 { [a * radius, b * radius] } else { [b * radius, a * radius] };
        Shape::Flat { outline: Outline::Ellipse, origin: center, edges, mirrored: false }
    }

    /// A mesh in its own space.
    pub fn mesh(data: Arc<MeshData>) -> Shape {
        Shape::Mesh { boxes: data.boxes().into(), data, map: DAffine3::IDENTITY }
    }

    /// A cylinder between two points.
    pub fn cylinder(base: DVec3, top: DVec3, radius: f64, capped: bool) -> Shape {
        let (a, b) = (top - base).normalize().any_orthonormal_pair();
        Shape::Cylinder { base, axes: DMat3::from_cols(a * radius, b * radius, top - base), capped }
    }

    /// The image of the shape under an invertible map. The front stays the front, even if the map mirrors.
    pub fn transformed(&self, map: &DAffine3) -> Shape {
        let point = |p: &DVec3| map.transform_point3(*p);
        let linear = map.matrix3;
        match self {
            Shape::Sphere { center, radius, turn } => match similarity(&linear) {
                Some(scale) => {
                    Shape::Sphere { center: point(center), radius: radius * scale, turn: turned(*turn, &linear, scale) }
                }
                None => Shape::Ellipsoid { center: point(center), axes: turn.map_or(linear, |turn| linear * turn) * *radius },
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
            Shape::Mesh { data, boxes, map: before } => {
                Shape::Mesh { data: data.clone(), boxes: boxes.clone(), map: *map * *before }
            }
            Shape::Isosurface { surface, map: before } => Shape::Isosurface { surface: surface.clone(), map: *map * *before },
        }
    }

    /// The smooth pieces of the surface, one primitive each.
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

    /// Number of [pieces](Shape::pieces).
    pub fn piece_count(&self) -> usize {
        match self {
            Shape::Cuboid { .. } => 6,
            Shape::Cylinder { capped: true, .. } => 3,
            _ => 1,
        }
    }

    /// Name in the scene file.
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

    /// Whether a point lies inside; always false for an open surface.
    pub fn contains(&self, p: DVec3) -> bool {
        match self {
            Shape::Sphere { center, radius, .. } => p.distance(*center) < *radius,
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
            Shape::Mesh { data, map, .. } => {
                let (center, radius) = self.bounding_sphere();
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

/// The turn of a sphere after a similarity with this scale factor. Spheres that are not rotated have none.
fn turned(turn: Option<DMat3>, linear: &DMat3, scale: f64) -> Option<DMat3> {
    let diagonal = DVec3::new(linear.x_axis.x, linear.y_axis.y, linear.z_axis.z);
    let only_scales = *linear == DMat3::from_diagonal(diagonal) && diagonal.min_element() > 0.0;
    if only_scales { turn } else { Some(*linear * (1.0 / scale) * turn.unwrap_or(DMat3::IDENTITY)) }
}

/// The scale factor of a similarity; `None` for other maps.
fn similarity(linear: &DMat3) -> Option<f64> {
    let gram = linear.transpose() * *linear;
    let square = (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
    let rest = gram - DMat3::from_diagonal(DVec3::splat(square));
    let largest = [rest.x_axis, rest.y_axis, rest.z_axis].map(|axis| axis.abs().max_element()).into_iter().fold(0.0, f64::max);
    (largest <= 1e-9 * square).then(|| square.sqrt())
}
