//! Shapes: the first hit of a ray, and the point, normal and surface coordinates there.
//!
//! Each smooth piece of surface has a number, its *primitive id*. Its material and emission are looked up by that number
//! elsewhere.
//!
//! | type | file | pieces | front |
//! |---|---|---|---|
//! | sphere | `sphere/` | 1 | outside |
//! | ellipsoid, a stretched sphere | `quadric.rs` | 1 | outside |
//! | rectangle, triangle, disk | `flat.rs` | 1 | side of the normal |
//! | cuboid | `cuboid.rs` | 6 | outside |
//! | cylinder | `quadric.rs` | 1, with caps 3 | outside |
//! | mesh | `mesh/` | 1, its triangles are *elements* | counter-clockwise |
//! | isosurface | `isosurface/` | 1 | where the function is positive |
//!
//! A ray tests the few and large shapes of `lists.rs` one by one, skips clusters of spheres that no ray of its register comes
//! near (`clusters.rs`), and descends a tree over the others (`objects.rs`). The surface that it hits is looked up in
//! `tables.rs`. Meshes, isosurfaces and moving shapes have a local space (`instance.rs`). [`Shapes`] holds all of them. The compile of
//! a changed scene compares shapes bit for bit (`identity.rs`) and reuses the trees of meshes (`mesh_trees.rs`).
mod area_sample;
mod borders;
mod bounding_sphere;
mod bounds;
mod bvh;
mod clusters;
mod cuboid;
mod direction_sample;
mod extent;
mod flat;
mod fraction;
mod holds;
mod identity;
mod instance;
mod isosurface;
mod least_width;
mod lists;
pub mod mesh;
mod mesh_trees;
mod motion;
mod nearest;
mod object;
mod objects;
pub mod oracle;
mod pass_distance;
mod quadric;
mod rectangle;
mod shape;
mod shapes;
mod sphere;
mod sphere_field;
mod step;
mod surface_point;
mod tables;
#[cfg(test)]
mod tests;
mod toward;
mod transform;
mod turns;

pub use self::{
    bounds::Bounds,
    bvh::Visits,
    direction_sample::DirectionSample,
    identity::same_point,
    isosurface::{Expression, Isosurface, ParseError},
    mesh::MeshData,
    motion::Motion,
    nearest::Nearest,
    shape::{Outline, Shape},
    shapes::Shapes,
    sphere::{Cone, Sphere},
    sphere_field::sphere_field,
    step::TransformStep,
    surface_point::{Coordinates, PrimitiveRef, SurfacePoint},
    turns::Turns,
};

/// The primitive id of a ray that hits nothing.
pub const MISS: u32 = u32::MAX;
