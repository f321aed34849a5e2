//! Materials as a scene uses them.
use crate::{
    material::{CompiledMaterial, Material},
    texture::NumberSource,
};

/// A compiled material with its opacity, bump map and normal map.
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
    /// Whether bump and normal maps darken light at grazing angles.
    pub normal_shadowing: bool,
    /// Whether normals of bump and normal maps that face away from the viewer are mirrored.
    pub mirrored_normals: bool,
    /// Whether the back shows bump and normal map as the front does.
    pub two_sided_relief: bool,
    /// Black from behind.
    pub one_sided: bool,
    /// Fraction of the light that meets the surface.
    pub opacity: NumberSource,
    /// The parts of a blend.
    pub blend: Option<BlendParts>,
    /// Properties of the surface.
    pub properties: Properties,
}

/// The parts of a blend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlendParts {
    /// Numbers of the two materials.
    pub materials: [u32; 2],
    /// Fraction of the second material, or [`BY_SIDE`].
    pub weight: NumberSource,
}

/// The weight of blends that are the first material on their front, and the second on their back.
pub const BY_SIDE: f32 = -1.0;

/// Properties of a surface. A blend has a property if one of its materials has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Whether it is ideally diffuse.
    pub diffuse: bool,
    /// Whether its BSDF transmits light.
    pub transmits: bool,
    /// Whether it bounds an interior.
    pub has_inside: bool,
    /// Whether its opacity lets light pass.
    pub passes: bool,
    /// The largest albedo in any channel: see [`CompiledMaterial::albedo`].
    pub albedo: f32,
}

impl Properties {
    /// The properties of a compiled material with an opacity.
    pub fn new(compiled: &CompiledMaterial, opacity: NumberSource) -> Properties {
        Properties {
            diffuse: compiled.stage.is_diffuse(),
            transmits: compiled.stage.transmits(),
            has_inside: compiled.inside.is_some(),
            passes: opacity != NumberSource::Constant(1.0),
            albedo: compiled.albedo,
        }
    }

    /// The properties of a blend of its parts, by those that it has before.
    #[must_use]
    pub fn of_blend(self, parts: Properties) -> Properties {
        Properties { passes: self.passes | parts.passes, ..parts }
    }

    /// The properties of either of two surfaces.
    #[must_use]
    pub fn or(self, other: Properties) -> Properties {
        Properties {
            diffuse: self.diffuse | other.diffuse,
            transmits: self.transmits | other.transmits,
            has_inside: self.has_inside | other.has_inside,
            passes: self.passes | other.passes,
            albedo: self.albedo.max(other.albedo),
        }
    }
}
