//! Materials: how a surface scatters light.
//!
//! A kind is one file and one line of the catalogue below. The line names the description, which stands in the file with its parameters,
//! and the stages of the kernel that shade it. A stage is compiled once per SIMD level, with nothing in it that its kind does not need.
//!
//! Roughness is the width α of the distribution of microfacets (`microfacets.rs`: `ggx.rs` or `beckmann.rs`);
//! the tables that account for all light are in `albedo.rs` for reflection and in `missing_energy.rs` for interfaces.
mod albedo;
mod albedo_table;
mod anisotropic_conductor;
mod anisotropic_interface;
mod anisotropic_loss;
mod anisotropy;
pub mod beckmann;
pub mod blend;
mod bsdf;
mod compiled;
pub mod conductor;
mod conductor_bsdf;
mod conductor_fresnel;
pub mod dielectric;
mod dielectric_albedo;
pub mod diffuse_transmission;
pub mod disney;
mod either_facets;
pub mod fresnel;
pub mod ggx;
mod grazing;
pub mod lambertian;
mod lookup;
mod materials;
pub mod microfacets;
pub mod mirror;
mod missing_energy;
pub mod null;
pub mod plastic;
pub mod principled;
mod refraction;
pub mod rough_dielectric;
pub mod rough_plastic;
mod roughness;
mod shade;
mod tables;
#[cfg(test)]
mod tests;
pub mod thin_dielectric;
mod tinted_dielectric;

pub use self::{
    bsdf::{Bsdf, BsdfSample, ChosenLobe, Lobes},
    compiled::{AlphaSource, CompiledMaterial, MaterialCompiler},
    conductor::Conductor,
    conductor_fresnel::Reflectance,
    dielectric::{Dielectric, DielectricBsdf},
    diffuse_transmission::DiffuseTransmission,
    disney::Disney,
    lambertian::{Lambertian, LambertianBsdf},
    materials::{Local, Materials},
    microfacets::Distribution,
    mirror::Mirror,
    plastic::Plastic,
    rough_dielectric::{RoughDielectric, RoughDielectricBsdf},
    rough_plastic::RoughPlastic,
    roughness::Roughness,
    shade::Shade,
};
use noisefall_base::declare::{Meaning, Parameter, Path, Problem};

macro_rules! materials {
    ($($module:ident::$Material:ident => $($Stage:ident)*),+ $(,)?) => {
        noisefall_base::declare::catalogue! {
            /// A material as a scene describes it.
            pub enum Material: Compile, "material" { $($module::$Material),+ }
        }

        /// A stage of the kernel that shades surfaces.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Stage {
            $($(
                #[doc = concat!("A stage of `", stringify!($module), ".rs`.")]
                $Stage,
            )*)+
        }

        impl Stage {
            /// All stages, in the order of the catalogue.
            pub const ALL: &'static [Stage] = &[$($(Stage::$Stage,)*)+];
        }

        /// `in_stage!(stage, K => call::<K>(…))`: the call with the [`Shade`] of a [`Stage`].
        #[macro_export]
        macro_rules! in_stage {
            ($stage:expr, $kind:ident => $call:expr) => {
                match $stage {
                    $($($crate::material::Stage::$Stage => {
                        type $kind = $crate::material::$module::$Stage;
                        $call
                    })*)+
                }
            };
        }
    };
}

materials! {
    lambertian::Lambertian => Plain Diffuse,
    mirror::Mirror => Mirror,
    conductor::Conductor => Conductor AnisotropicConductor BeckmannConductor,
    dielectric::Dielectric => Dielectric RoughDielectric TintedDielectric,
    plastic::Plastic => Plastic,
    rough_plastic::RoughPlastic => RoughPlastic,
    thin_dielectric::ThinDielectric => ThinDielectric,
    diffuse_transmission::DiffuseTransmission => DiffuseTransmission,
    principled::Principled => Principled PrincipledGlass,
    disney::Disney => Disney DisneyGlass,
    blend::Blend => ,
    null::Null => ,
}
pub use in_stage;

impl Stage {
    /// Number of stages.
    pub const COUNT: usize = Stage::ALL.len();

    /// Whether light passes to the other side.
    pub fn transmits(self) -> bool {
        in_stage!(self, K => K::TRANSMITS)
    }

    /// Whether sampled lights can contribute.
    pub fn sees_lights(self) -> bool {
        in_stage!(self, K => K::SEES_LIGHTS)
    }

    /// Whether its shading reads texture coordinates and the tangent where a material needs them.
    pub fn reads_chart(self) -> bool {
        in_stage!(self, K => K::CHARTED)
    }

    /// Whether it is ideally diffuse.
    pub fn is_diffuse(self) -> bool {
        in_stage!(self, K => K::DIFFUSE)
    }

    /// Whether it has highlights: whether it reflects light in some directions more than in others.
    pub fn has_highlights(self) -> bool {
        in_stage!(self, K => K::HIGHLIGHTS)
    }

    /// Whether it has a diffuse transmittance besides its colour.
    pub fn has_transmittance(self) -> bool {
        in_stage!(self, K => K::HAS_TRANSMITTANCE)
    }

    /// Whether lights are better chosen by what the lobe reflects of them.
    pub fn is_glossy(self) -> bool {
        in_stage!(self, K => K::GLOSSY)
    }
}

/// The index of refraction of a kind.
const fn ior(doc: &'static str) -> Parameter {
    Parameter::new("ior", doc)
        .symbol("η")
        .required()
        .aliases("eta index index_of_refraction refraction")
        .means(Meaning::IndexOfRefraction)
}

/// A kind of material: from its description to what the kernel reads.
pub trait Compile {
    /// Checks the values and packs them for the kernel.
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem>;

    /// Checks what can be told without textures.
    fn check(&self) -> Result<(), Problem> {
        Ok(())
    }

    /// Whether all light passes unchanged, as with an opacity of 0.
    fn is_clear(&self) -> bool {
        false
    }
}

impl Material {
    /// Checks the textures that the material names, and makes the tables that it needs.
    pub fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        self.kind().compile(compiler).map_err(|problem| problem.within(&Path::of(self.name())))
    }

    /// Checks what can be told without textures.
    pub fn check(&self) -> Result<(), Problem> {
        self.kind().check().map_err(|problem| problem.within(&Path::of(self.name())))
    }
}
