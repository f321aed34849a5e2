//! What a scene file says, word for word: the shape of the TOML, before names are resolved and values checked.
//!
//! Every key of the format stands here.
mod shape;

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, de};
use toml::Spanned;

pub use self::shape::{
    CuboidDesc, CylinderDesc, DiskDesc, IsosurfaceDesc, MeshDesc, RectangleDesc, ShapeDesc, TransformDesc, TriangleDesc,
};
pub use super::colour::Colour;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneDesc {
    /// Checked before the rest is read.
    #[serde(rename = "format")]
    pub _format: i64,
    pub title: Option<String>,
    pub notes: Option<String>,
    pub camera: Spanned<CameraDesc>,
    pub background: Option<Spanned<BackgroundDesc>>,
    #[serde(default)]
    pub textures: BTreeMap<String, Spanned<TextureDesc>>,
    #[serde(default)]
    pub materials: BTreeMap<String, Spanned<MaterialDesc>>,
    #[serde(default)]
    pub objects: Vec<Spanned<ObjectDesc>>,
    #[serde(default)]
    pub render: RenderDesc,
    pub truth: Option<Spanned<TruthDesc>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraDesc {
    pub eye: Spanned<Exactly<f64, 3>>,
    pub look_at: Spanned<Exactly<f64, 3>>,
    pub up: Option<Spanned<Exactly<f64, 3>>>,
    pub fov: Option<Spanned<f64>>,
    pub resolution: Spanned<Exactly<u32, 2>>,
    pub projection: Option<Spanned<ProjectionDesc>>,
    pub lens: Option<Spanned<LensDesc>>,
    pub filter: Option<Spanned<super::filter::FilterDesc>>,
    pub shutter: Option<Spanned<Exactly<f64, 2>>>,
    /// What carries the camera from time 0 to 1.
    #[serde(default)]
    pub motion: Vec<Spanned<TransformDesc>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum ProjectionDesc {
    Perspective,
    Orthographic { width: f64 },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LensDesc {
    pub radius: f64,
    pub focus: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BackgroundDesc {
    pub radiance: Option<Spanned<Colour>>,
    pub image: Option<Spanned<String>>,
    pub rotate: Option<Spanned<f64>>,
    pub scale: Option<Spanned<f64>>,
}

/// Exactly one of the kinds is given.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureDesc {
    pub image: Option<ImageTextureDesc>,
    pub checker: Option<CheckerDesc>,
    pub noise: Option<NoiseDesc>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageTextureDesc {
    pub path: Spanned<String>,
    #[serde(default)]
    pub encoding: crate::image::Encoding,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CheckerDesc {
    pub even: Spanned<Colour>,
    pub odd: Spanned<Colour>,
    pub scale: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoiseDesc {
    pub scale: Spanned<f64>,
    pub octaves: Spanned<u32>,
    pub low: Spanned<Colour>,
    pub high: Spanned<Colour>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialDesc {
    pub lambertian: Option<LambertianDesc>,
    pub mirror: Option<MirrorDesc>,
    pub dielectric: Option<DielectricDesc>,
    pub conductor: Option<Spanned<ConductorDesc>>,
    pub plastic: Option<PlasticDesc>,
    pub bump: Option<BumpDesc>,
    pub normal_map: Option<Spanned<String>>,
    pub two_sided: Option<Spanned<bool>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MirrorDesc {
    pub reflectance: Spanned<Colour>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DielectricDesc {
    pub ior: Spanned<f64>,
    pub ior_outside: Option<Spanned<f64>>,
    pub roughness: Option<Spanned<Colour>>,
    pub alpha: Option<Spanned<Colour>>,
    pub transmittance: Option<Spanned<Colour>>,
    pub energy_compensation: Option<bool>,
}

/// Either `eta` and `k`, or `f0`, or `reflectance`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConductorDesc {
    pub eta: Option<Spanned<Colour>>,
    pub k: Option<Spanned<Colour>>,
    pub f0: Option<Spanned<Colour>>,
    pub reflectance: Option<Spanned<Colour>>,
    pub roughness: Option<Spanned<Colour>>,
    pub alpha: Option<Spanned<Colour>>,
    pub energy_compensation: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlasticDesc {
    pub albedo: Spanned<Colour>,
    pub ior: Spanned<f64>,
    pub roughness: Option<Spanned<Colour>>,
    pub alpha: Option<Spanned<Colour>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BumpDesc {
    pub texture: Spanned<String>,
    /// Metres that the brightest texel rises above the darkest.
    pub height: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LambertianDesc {
    pub albedo: Spanned<Colour>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectDesc {
    pub name: Option<String>,
    pub shape: Spanned<ShapeDesc>,
    pub material: Option<Spanned<String>>,
    pub emission: Option<Spanned<EmissionDesc>>,
    #[serde(default)]
    pub flip: bool,
    #[serde(default)]
    pub transform: Vec<Spanned<TransformDesc>>,
    #[serde(default)]
    pub motion: Vec<Spanned<TransformDesc>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EmissionDesc {
    pub radiance: Option<Spanned<Colour>>,
    #[serde(default)]
    pub two_sided: bool,
    pub texture: Option<Spanned<String>>,
    pub scale: Option<Spanned<f64>>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RenderDesc {
    pub estimator: Option<super::Estimator>,
    pub directions: Option<crate::sampling::Directions>,
    pub sampler: Option<crate::sampling::Sampler>,
    pub max_bounces: Option<u32>,
    pub roulette: Option<Spanned<super::roulette::RouletteDesc>>,
    pub reuse: Option<super::Reuse>,
    pub adaptive: Option<bool>,
    pub spp: Option<Spanned<u32>>,
    pub seed: Option<u32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TruthDesc {
    pub radiance: Option<Spanned<Colour>>,
    pub image: Option<Spanned<String>>,
}

/// An array of neither more nor fewer than `N` elements.
pub struct Exactly<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let elements = Vec::deserialize(deserializer)?;
        let length = elements.len();
        let exactly = elements.try_into().map_err(|_| de::Error::invalid_length(length, &format!("a list of {N}").as_str()))?;
        Ok(Exactly(exactly))
    }
}
