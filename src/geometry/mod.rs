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
mod cuboid;
mod flat;
mod fraction;
mod quadric;
mod shape;
mod shapes;
mod sphere;
mod surface_point;
#[cfg(test)]
mod tests;
mod toward;

pub use self::{
    shape::{Outline, Shape},
    shapes::Shapes,
    sphere::{Cone, Sphere},
    surface_point::{Coordinates, SurfacePoint},
    toward::Toward,
};

/// The primitive id of a ray that meets nothing.
pub const MISS: u32 = u32::MAX;
