//! The JSON of a glTF file.
//!
//! Structures are small, and rare parts are boxed: a file of many empty elements must not need much more memory than its text.
//! Extensions are in `extensions.rs`.
use serde::{Deserialize, Deserializer};

use super::extensions::{
    DocumentExtensions, MaterialExtensions, NodeExtensions, PrimitiveExtensions, TextureExtensions, ViewExtensions,
};
pub use super::{
    attributes::{Attributes, Index, UvMap, Wanted, element},
    extensions::TextureInfo,
};

/// Longer names are cut: messages and objects repeat them for every node.
const LONGEST_NAME: usize = 200;

/// A glTF document.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Document {
    pub asset: Asset,
    pub scene: Option<Index>,
    pub scenes: Vec<Scene>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<BufferView>,
    pub buffers: Vec<Buffer>,
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub images: Vec<Image>,
    pub samplers: Vec<Sampler>,
    pub cameras: Vec<Camera>,
    pub skins: Vec<Skin>,
    pub animations: Vec<Animation>,
    pub extensions_used: Vec<String>,
    pub extensions_required: Vec<String>,
    pub extensions: DocumentExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Asset {
    pub version: String,
    pub min_version: Option<String>,
    pub generator: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Scene {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub nodes: Vec<Index>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Node {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub children: Vec<Index>,
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<Box<[f64; 3]>>,
    pub rotation: Option<Box<[f64; 4]>>,
    pub scale: Option<Box<[f64; 3]>>,
    pub mesh: Option<Index>,
    pub camera: Option<Index>,
    pub skin: Option<Index>,
    pub weights: Vec<f64>,
    pub extensions: Option<Box<NodeExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Mesh {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub primitives: Vec<Primitive>,
    pub weights: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<Index>,
    pub material: Option<Index>,
    pub mode: Option<u32>,
    pub targets: Vec<Attributes>,
    pub extensions: Option<Box<PrimitiveExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Accessor {
    pub buffer_view: Option<Index>,
    pub byte_offset: u64,
    pub component_type: u32,
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type")]
    pub shape: String,
    pub sparse: Option<Box<Sparse>>,
}

#[derive(Debug, Deserialize)]
pub struct Sparse {
    pub count: u64,
    pub indices: SparseIndices,
    pub values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseIndices {
    pub buffer_view: Index,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseValues {
    pub buffer_view: Index,
    #[serde(default)]
    pub byte_offset: u64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct BufferView {
    pub buffer: Index,
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
    pub extensions: ViewExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Buffer {
    pub uri: Option<String>,
    pub byte_length: u64,
}

#[derive(Debug, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Material {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub pbr_metallic_roughness: Option<Box<MetallicRoughness>>,
    pub normal_texture: Option<Box<TextureInfo>>,
    pub occlusion_texture: Option<Box<TextureInfo>>,
    pub emissive_texture: Option<Box<TextureInfo>>,
    pub emissive_factor: [f64; 3],
    pub alpha_mode: String,
    pub alpha_cutoff: f64,
    pub double_sided: bool,
    pub extensions: Option<Box<MaterialExtensions>>,
}

impl Default for Material {
    fn default() -> Self {
        Material {
            name: String::new(),
            pbr_metallic_roughness: None,
            normal_texture: None,
            occlusion_texture: None,
            emissive_texture: None,
            emissive_factor: [0.0; 3],
            alpha_mode: String::new(),
            alpha_cutoff: 0.5,
            double_sided: false,
            extensions: None,
        }
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct MetallicRoughness {
    pub base_color_factor: [f64; 4],
    pub base_color_texture: Option<TextureInfo>,
    pub metallic_factor: f64,
    pub roughness_factor: f64,
    pub metallic_roughness_texture: Option<TextureInfo>,
}

impl Default for MetallicRoughness {
    fn default() -> Self {
        MetallicRoughness {
            base_color_factor: [1.0; 4],
            base_color_texture: None,
            metallic_factor: 1.0,
            roughness_factor: 1.0,
            metallic_roughness_texture: None,
        }
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Texture {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub sampler: Option<Index>,
    pub source: Option<Index>,
    pub extensions: TextureExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Image {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub uri: Option<String>,
    pub buffer_view: Option<Index>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Sampler {
    pub mag_filter: Option<u32>,
    pub wrap_s: Option<u32>,
    pub wrap_t: Option<u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Camera {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub perspective: Option<Perspective>,
    pub orthographic: Option<Orthographic>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Perspective {
    pub yfov: f64,
    pub aspect_ratio: Option<f64>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Orthographic {
    pub xmag: f64,
    pub ymag: f64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Skin {
    pub joints: Vec<Index>,
    pub inverse_bind_matrices: Option<Index>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Animation {
    #[serde(deserialize_with = "name")]
    pub name: String,
    pub channels: Vec<Channel>,
    pub samplers: Vec<AnimationSampler>,
}

#[derive(Debug, Deserialize)]
pub struct Channel {
    pub sampler: Index,
    pub target: ChannelTarget,
}

#[derive(Debug, Deserialize)]
pub struct ChannelTarget {
    pub node: Option<Index>,
    pub path: String,
}

#[derive(Debug, Deserialize)]
pub struct AnimationSampler {
    pub input: Index,
    pub output: Index,
    #[serde(default)]
    pub interpolation: Option<String>,
}

fn name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let name = String::deserialize(deserializer)?;
    Ok(name.char_indices().nth(LONGEST_NAME).map(|(end, _)| name[..end].to_owned()).unwrap_or(name))
}
