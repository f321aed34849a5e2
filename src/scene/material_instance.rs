//! Materials as a scene uses them.
use crate::material::{CompiledMaterial, Material};

/// A material and what varies about it over the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialInstance {
    pub name: String,
    pub material: Material,
    pub compiled: CompiledMaterial,
    /// Texture of heights and its scale, metres.
    pub bump: Option<(u32, f32)>,
    /// Texture of normals.
    pub normal_map: Option<u32>,
    /// Black from behind.
    pub one_sided: bool,
}
