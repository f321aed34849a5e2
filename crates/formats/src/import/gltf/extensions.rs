//! Extensions of glTF that are read, as they stand in the JSON.
use glam::{DAffine2, DVec2};
use serde::{Deserialize, de::IgnoredAny};

use super::attributes::{Attributes, Index};

/// The extensions that are understood.
pub const KNOWN: [&str; 24] = [
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
    // They hold no part of the image.
    "KHR_node_selectability",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Why a file that requires an extension is refused, and how to get one that does not.
pub const REFUSED: [(&str, &str); 1] =
    [("KHR_texture_basisu", "export its textures as PNG, JPEG or WebP: KTX2 files are not supported")];

macro_rules! extensions {
    ($($(#[$doc:meta])* $Name:ident { $($field:ident: $Type:ty = $key:literal),+ $(,)? })+) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Debug, Default, Deserialize)]
            #[serde(default)]
            pub struct $Name {
                $(#[serde(rename = $key)] pub $field: Option<Box<$Type>>),+
            }
        )+
    };
}

extensions! {
    /// Of the document.
    DocumentExtensions { lights: Lights = "KHR_lights_punctual", variants: Variants = "KHR_materials_variants" }
    /// Of nodes.
    NodeExtensions { light: LightUse = "KHR_lights_punctual", instancing: Instancing = "EXT_mesh_gpu_instancing" }
    /// Of primitives.
    PrimitiveExtensions { variants: Mappings = "KHR_materials_variants", draco: Draco = "KHR_draco_mesh_compression" }
    /// Of buffer views.
    ViewExtensions { meshopt_ext: Meshopt = "EXT_meshopt_compression", meshopt_khr: Meshopt = "KHR_meshopt_compression" }
    /// Of textures.
    TextureExtensions { webp: ImageUse = "EXT_texture_webp", basisu: IgnoredAny = "KHR_texture_basisu" }
    /// Of uses of textures.
    TextureInfoExtensions { transform: TextureTransform = "KHR_texture_transform" }
    /// Of materials.
    MaterialExtensions {
        anisotropy: Anisotropy = "KHR_materials_anisotropy",
        clearcoat: Clearcoat = "KHR_materials_clearcoat",
        dispersion: Dispersion = "KHR_materials_dispersion",
        emissive_strength: EmissiveStrength = "KHR_materials_emissive_strength",
        ior: Ior = "KHR_materials_ior",
        iridescence: Iridescence = "KHR_materials_iridescence",
        specular_glossiness: SpecularGlossiness = "KHR_materials_pbrSpecularGlossiness",
        sheen: Sheen = "KHR_materials_sheen",
        specular: Specular = "KHR_materials_specular",
        transmission: Transmission = "KHR_materials_transmission",
        unlit: IgnoredAny = "KHR_materials_unlit",
        volume: Volume = "KHR_materials_volume",
    }
}

impl ViewExtensions {
    /// How the view is compressed. Both extensions mean the same.
    pub fn meshopt(&self) -> Option<&Meshopt> {
        self.meshopt_ext.as_deref().or(self.meshopt_khr.as_deref())
    }
}

impl MaterialExtensions {
    /// The textures of the layers that are read.
    pub fn maps(&self) -> impl Iterator<Item = &TextureInfo> {
        let coat = self.clearcoat.iter().flat_map(|of| [&of.clearcoat_texture, &of.clearcoat_roughness_texture]);
        let film = self.iridescence.iter().flat_map(|of| [&of.iridescence_texture, &of.iridescence_thickness_texture]);
        let sheen = self.sheen.iter().flat_map(|of| [&of.sheen_color_texture, &of.sheen_roughness_texture]);
        let specular = self.specular.iter().flat_map(|of| [&of.specular_texture, &of.specular_color_texture]);
        let transmission = self.transmission.iter().map(|of| &of.transmission_texture);
        coat.chain(film).chain(sheen).chain(specular).chain(transmission).flatten()
    }
}

/// Accessors of the copies of a mesh.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, rename_all = "SCREAMING_SNAKE_CASE")]
pub struct CopyAttributes {
    pub translation: Option<Index>,
    pub rotation: Option<Index>,
    pub scale: Option<Index>,
}

/// A use of a texture.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct TextureInfo {
    pub index: Index,
    #[serde(default)]
    tex_coord: u32,
    /// Of normal maps.
    #[serde(default)]
    pub scale: Option<f64>,
    #[serde(default)]
    pub extensions: TextureInfoExtensions,
}

impl TextureInfo {
    /// From the texture coordinates to those of the image. The rotation is from v towards u, as exporters and viewers do it.
    pub fn map(&self) -> DAffine2 {
        let transform = self.extensions.transform.as_deref().cloned().unwrap_or_default();
        let (scale, offset) = (DVec2::from(transform.scale), DVec2::from(transform.offset));
        DAffine2::from_scale_angle_translation(scale, 0.0 - transform.rotation, offset)
    }

    /// The set of texture coordinates.
    pub fn set(&self) -> u32 {
        let transform = self.extensions.transform.as_ref();
        transform.and_then(|transform| transform.tex_coord).unwrap_or(self.tex_coord)
    }
}

macro_rules! structures {
    ($($Name:ident { $($field:ident: $Type:ty = $default:expr),* $(,)? })+) => {
        $(
            #[derive(Clone, Debug, Deserialize)]
            #[serde(default, rename_all = "camelCase")]
            pub struct $Name { $(pub $field: $Type),* }

            impl Default for $Name {
                fn default() -> Self {
                    $Name { $($field: $default),* }
                }
            }
        )+
    };
}

type Map = Option<TextureInfo>;

structures! {
    Lights { lights: Vec<Light> = Vec::new() }
    LightUse { light: Index = 0 }
    Light {
        name: String = String::new(),
        color: [f64; 3] = [1.0; 3],
        intensity: f64 = 1.0,
        range: Option<f64> = None,
        r#type: String = String::new(),
        spot: Option<Spot> = None,
    }
    Spot { inner_cone_angle: f64 = 0.0, outer_cone_angle: f64 = std::f64::consts::FRAC_PI_4 }
    Variants { variants: Vec<Variant> = Vec::new() }
    Variant { name: String = String::new() }
    Mappings { mappings: Vec<Mapping> = Vec::new() }
    Mapping { material: Index = 0, variants: Vec<Index> = Vec::new() }
    ImageUse { source: Index = 0 }
    TextureTransform {
        offset: [f64; 2] = [0.0; 2],
        rotation: f64 = 0.0,
        scale: [f64; 2] = [1.0; 2],
        tex_coord: Option<u32> = None,
    }
    Anisotropy { anisotropy_strength: f64 = 0.0, anisotropy_rotation: f64 = 0.0, anisotropy_texture: Map = None }
    Clearcoat {
        clearcoat_factor: f64 = 0.0,
        clearcoat_texture: Map = None,
        clearcoat_roughness_factor: f64 = 0.0,
        clearcoat_roughness_texture: Map = None,
        clearcoat_normal_texture: Map = None,
    }
    Dispersion { dispersion: f64 = 0.0 }
    EmissiveStrength { emissive_strength: f64 = 1.0 }
    Ior { ior: f64 = 1.5 }
    Iridescence {
        iridescence_factor: f64 = 0.0,
        iridescence_texture: Map = None,
        iridescence_ior: f64 = 1.3,
        iridescence_thickness_minimum: f64 = 100.0,
        iridescence_thickness_maximum: f64 = 400.0,
        iridescence_thickness_texture: Map = None,
    }
    SpecularGlossiness {
        diffuse_factor: [f64; 4] = [1.0; 4],
        diffuse_texture: Map = None,
        specular_factor: [f64; 3] = [1.0; 3],
        glossiness_factor: f64 = 1.0,
        specular_glossiness_texture: Map = None,
    }
    Sheen {
        sheen_color_factor: [f64; 3] = [0.0; 3],
        sheen_color_texture: Map = None,
        sheen_roughness_factor: f64 = 0.0,
        sheen_roughness_texture: Map = None,
    }
    Specular {
        specular_factor: f64 = 1.0,
        specular_texture: Map = None,
        specular_color_factor: [f64; 3] = [1.0; 3],
        specular_color_texture: Map = None,
    }
    Transmission { transmission_factor: f64 = 0.0, transmission_texture: Map = None }
    Volume {
        thickness_factor: f64 = 0.0,
        attenuation_distance: Option<f64> = None,
        attenuation_color: [f64; 3] = [1.0; 3],
    }
    Instancing { attributes: CopyAttributes = CopyAttributes::default() }
    Meshopt {
        buffer: Index = 0,
        byte_offset: u64 = 0,
        byte_length: u64 = 0,
        byte_stride: u64 = 0,
        count: u64 = 0,
        mode: String = String::new(),
        filter: String = String::new(),
    }
    Draco { buffer_view: Index = 0, attributes: Attributes = Attributes::default() }
}
