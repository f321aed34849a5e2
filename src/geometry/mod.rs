//! Shapes: where a ray first meets one, and the point, normal and coordinates there.
//!
//! A smooth piece of surface has a number, its *primitive id*; what it is made of and whether it emits is looked up by that
//! number elsewhere.
//!
//! | kind | file | pieces | front |
//! |---|---|---|---|
//! | sphere | `sphere.rs` | 1 | outside |
//! | ellipsoid, a stretched sphere | `quadric.rs` | 1 | outside |
//! | rectangle, triangle, disk | `flat.rs` | 1 | where the normal points |
//! | cuboid | `cuboid.rs` | 6 | outside |
//! | cylinder | `quadric.rs` | 1, with caps 3 | outside |
//! | mesh | `mesh/` | 1, its triangles are *elements* | counter-clockwise |
//! | isosurface | `isosurface/` | 1 | where the function is positive |
//!
//! A ray runs through the few and large shapes of `lists.rs`, past clusters of spheres that none of its register comes near
//! (`clusters.rs`), and down a tree over the many (`objects.rs`); what it met is looked up
//! in `tables.rs`. Meshes, isosurfaces and what moves have a space of their own (`placed.rs`). All together are [`Shapes`].
mod around;
mod bounds;
mod bvh;
mod clusters;
mod cuboid;
mod extent;
mod flat;
mod fraction;
mod isosurface;
mod lists;
pub mod mesh;
mod motion;
mod objects;
pub mod oracle;
mod placed;
mod pose;
mod quadric;
mod rectangle;
mod shape;
mod shapes;
mod sphere;
mod sphere_field;
mod surface_point;
mod tables;
#[cfg(test)]
mod tests;
mod toward;
mod turns;

use self::sphere::{sphere_tangents, sphere_uv};
pub use self::{
    isosurface::{Expression, Isosurface, ParseError},
    mesh::MeshData,
    motion::{Motion, Step},
    shape::{Outline, Shape},
    shapes::{Nearest, Shapes},
    sphere::{Cone, Sphere},
    sphere_field::sphere_field,
    surface_point::{Coordinates, Place, SurfacePoint},
    toward::Toward,
    turns::Turns,
};

/// The primitive id of a ray that meets nothing.
pub const MISS: u32 = u32::MAX;
