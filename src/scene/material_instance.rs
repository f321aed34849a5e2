//! Materials as a scene uses them.
use crate::material::{CompiledMaterial, Material};

/// A compiled material with its bump and normal maps.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialInstance {
    /// The name in the scene file.
    pub name: String,
    /// The description that the material was compiled from.
    pub material: Material,
    /// The constants of the kernel.
    pub compiled: CompiledMaterial,
    /// Texture of heights and its scale, metres.
    pub bump: Option<(u32, f32)>,
    /// Texture of normals.
    pub normal_map: Option<u32>,
    /// Black from behind.
    pub one_sided: bool,
}
