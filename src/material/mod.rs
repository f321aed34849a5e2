//! Materials: how a surface reflects.
//!
//! | kind | file | what it is |
//! |---|---|---|
//! | lambertian | `lambertian.rs` | ideal diffuse reflection, from both sides |
pub mod lambertian;

pub use lambertian::BsdfSample;

/// What a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Reflectances in [0, 1] of red, green and blue. Zero is black: paths end there.
    Lambertian { albedo: [f32; 3] },
}
