//! Shapes as scenes describe them.
//!
//! A kind is one file and one line of the catalogue below. Its file holds the description, with its parameters, and makes the
//! [`geometry::Shape`](crate::geometry::Shape)s that the renderer knows.
mod bounds;
pub mod cuboid;
pub mod cylinder;
pub mod disk;
mod fit;
pub mod isosurface;
pub mod mesh;
mod placement;
mod point_map;
pub mod rectangle;
pub mod sphere;
pub mod sphere_field;
mod transform;
pub mod triangle;

use std::collections::HashMap;

pub use self::{
    bounds::Bounds,
    fit::Fit,
    mesh::Mesh,
    placement::Placement,
    point_map::{Changes, PointMap, tidied},
    sphere::Sphere,
    transform::{Rotation, Transform, motion, product},
};
use crate::geometry::Shape;
use noisefall_base::declare::{Parameter, Path, Problem, Range, Resources, catalogue};

catalogue! {
    /// A shape as a scene describes it.
    pub enum ShapeKind: Build, "shape" {
        sphere::Sphere,
        sphere_field::SphereField,
        cuboid::Cuboid,
        cylinder::Cylinder,
        disk::Disk,
        rectangle::Rectangle,
        triangle::Triangle,
        mesh::Mesh,
        isosurface::Isosurface,
    }
}

/// A kind of shape: from its description to what the renderer knows.
pub trait Build {
    /// The shape, or the many.
    fn shapes(&self, builder: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem>;

    /// The shape, moved and scaled to its place in a scene: a closed shape touches the surface, a flat one lies just above it.
    /// `None` if only transforms can do that; the shape is then about as large as the cube from −1 to 1.
    fn placed(&self, _placement: &Placement) -> Option<ShapeKind> {
        None
    }

    /// The parameters after a transform of all points. `None` if the shape needs a list of transforms for that.
    fn transformed(&self, _by: &PointMap) -> Option<Changes> {
        None
    }

    /// The parameters that give it the place and the size of another shape. `None` if only transforms can do that; the shape is then
    /// about as large as the cube from −1 to 1.
    fn fitted(&self, _fit: &Fit) -> Option<Changes> {
        None
    }

    /// Whether it can be built at once: without files, and without many shapes or triangles.
    fn is_quick(&self) -> bool {
        true
    }
}

/// Context for building shapes. A mesh that several objects share is read or made once.
pub struct ShapeBuilder<'a> {
    resources: &'a Resources,
    /// How many meshes had the same lists so far: each is a mesh of its own.
    lists: HashMap<u128, usize>,
}

impl<'a> ShapeBuilder<'a> {
    /// A builder that reads files and keeps meshes in these resources.
    pub fn new(resources: &'a Resources) -> Self {
        ShapeBuilder { resources, lists: HashMap::new() }
    }

    /// The shapes of a description.
    pub fn build(&mut self, kind: &ShapeKind) -> Result<Vec<Shape>, Problem> {
        kind.kind().shapes(self).map_err(|problem| problem.within(&Path::of(kind.name())))
    }
}

/// The sine of the angle between edges below which a shape is taken as degenerate.
const FLATTEST: f64 = 1e-9;

fn are_parallel([a, b]: [glam::DVec3; 2]) -> bool {
    a.cross(b).length() <= FLATTEST * a.length() * b.length()
}

const CENTER: Parameter =
    Parameter::new("center", "Centre.").symbol("c").unit("m").required().aliases("centre position origin pos location");
const RADIUS: Parameter = Parameter::new("radius", "Radius.").symbol("r").unit("m").required().aliases("r size");

/// Metres.
const RADII: Range = Range::LENGTH;
