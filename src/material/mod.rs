//! Materials: how a surface reflects.
//!
//! | type | file | description |
//! |---|---|---|
//! | lambertian | `lambertian.rs` | ideal diffuse reflection |
//! | mirror | `mirror.rs` | smooth metal or a mirror of constant reflectance: a delta lobe |
//! | conductor | `conductor.rs` | rough metal: GGX reflection, with energy compensation |
//! | dielectric | `dielectric.rs` | smooth interface: delta lobes of reflection and refraction |
//! | rough dielectric | `rough_dielectric.rs` | microfacets that reflect and refract, with energy compensation |
//! | plastic | `plastic.rs` | diffuse base under a clear coat, smooth (delta lobe) or rough (GGX) |
//!
//! All reflect from both sides. Roughness is the width α of the GGX distribution (`ggx.rs`). The tables for energy compensation
//! are in `albedo.rs` for reflection and in `missing_energy.rs` for interfaces.
mod albedo;
mod albedo_table;
mod bsdf;
mod conductor;
mod dielectric;
mod dielectric_albedo;
pub mod fresnel;
pub mod ggx;
mod grazing;
mod lambertian;
mod materials;
mod mirror;
mod missing_energy;
mod plastic;
mod rough_dielectric;
#[cfg(test)]
mod tests;

pub use self::{
    bsdf::{Bsdf, BsdfSample, ChosenLobe, Lobes},
    conductor::Conductor,
    dielectric::Dielectric,
    lambertian::Lambertian,
    materials::{BsdfKind, Local, Materials},
    mirror::Mirror,
    plastic::Plastic,
    rough_dielectric::RoughDielectric,
};

/// A material. `alpha` is the width of the GGX distribution, the square of perceptual roughness, in [0, 1]; below [`ggx::SMOOTH`]
/// the surface is smooth. If it is textured, it is the maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Reflectances in [0, 1] of red, green and blue.
    Lambertian {
        albedo: [f32; 3],
    },
    Mirror {
        reflectance: [f32; 3],
    },
    /// Refractive indices of the side against the normal and of the side of the normal.
    Dielectric {
        ior: f32,
        ior_outside: f32,
        alpha: f32,
        /// Whether the roughness is textured.
        varies: bool,
        compensated: bool,
    },
    /// `compensated`: with multiple scattering between microfacets.
    Conductor {
        fresnel: Reflectance,
        alpha: f32,
        compensated: bool,
    },
    /// `albedo` is that of the base without its coat; the index of the coat is at least 1.
    Plastic {
        albedo: [f32; 3],
        ior: f32,
        alpha: f32,
    },
}

/// Reflectance of a metal, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance {
    /// The same at every angle.
    Constant([f32; 3]),
    /// Schlick's approximation from the reflectance at normal incidence.
    Schlick([f32; 3]),
    /// Fresnel's equations with the complex index η + ik relative to the outside.
    Index { eta: [f32; 3], k: [f32; 3] },
}

impl Material {
    /// Whether it scatters light even if its colour is black: coats and the rise of Fresnel reflectance towards grazing angles do
    /// not depend on the colour.
    pub fn scatters_where_black(&self) -> bool {
        match self {
            Material::Lambertian { .. } | Material::Mirror { .. } => false,
            Material::Conductor { fresnel, .. } => !matches!(fresnel, Reflectance::Constant(_)),
            Material::Dielectric { .. } | Material::Plastic { .. } => true,
        }
    }

    /// Name of the type in the scene file.
    pub fn name(&self) -> &'static str {
        match self {
            Material::Lambertian { .. } => "lambertian",
            Material::Mirror { .. } => "mirror",
            Material::Dielectric { .. } => "dielectric",
            Material::Conductor { .. } => "conductor",
            Material::Plastic { .. } => "plastic",
        }
    }
}
