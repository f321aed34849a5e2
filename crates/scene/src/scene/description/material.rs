//! Materials of a scene file.
use crate::{material::Material, texture::TEXTURE};
use noisefall_base::declare::{Declare, Family, Parameter, Parameters, Range, Textured, Value};

/// The key of the opacity of materials.
pub const OPACITY: Parameter =
    Parameter::new("opacity", "Fraction of the light that meets the surface; the rest passes unchanged. Default: 1.")
        .symbol("α")
        .aliases("alpha mask cutout");

/// A material of a scene file: its kind, and the parameters that all kinds share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialDescription {
    /// The BSDF.
    pub kind: Material,
    /// A height field that tilts the shading normal.
    pub bump: Option<Bump>,
    /// A linear image file of shading normals.
    pub normal_map: Option<String>,
    /// Whether bump and normal maps darken light at grazing angles; `None` means that they do not.
    pub normal_shadowing: Option<bool>,
    /// Whether normals of bump and normal maps that face away from the viewer are mirrored; `None` means that they are not.
    pub mirrored_normals: Option<bool>,
    /// Whether bumps rise from both sides; `None` means that bumps of the front are dents of the back.
    pub two_sided_relief: Option<bool>,
    /// Whether the back reflects too; `None` means that it does.
    pub two_sided: Option<bool>,
    /// Fraction of the light that meets the surface; the rest passes. `None` means 1.
    pub opacity: Option<Textured<f64>>,
}

impl Declare for MaterialDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const BUMP: Parameter = Parameter::new(
            "bump",
            "Makes the surface look uneven: heights from a texture tilt the shading normal; outlines stay smooth.",
        )
        .aliases("bump_map displacement");
        const NORMAL_MAP: Parameter = Parameter::new("normal_map", "A linear image of shading normals.").aliases("normals");
        const SHADOWING: Parameter = Parameter::new(
            "normal_shadowing",
            "Whether bump and normal maps darken light at grazing angles, as microfacets do. This softens hard edges of shading, and makes the surface not reciprocal. Default: false.",
        )
        .aliases("use_shadowing_function shadow_terminator");
        const MIRRORED: Parameter = Parameter::new(
            "mirrored_normals",
            "Whether mapped normals that face away from the viewer are mirrored at the normal of the surface. Otherwise that normal replaces them. Default: false.",
        )
        .aliases("flip_invalid_normals");
        const RELIEF: Parameter = Parameter::new(
            "two_sided_relief",
            "Whether bump and normal maps look the same from both sides. Otherwise bumps of the front are dents of the back. Default: false.",
        );
        const TWO_SIDED: Parameter =
            Parameter::new("two_sided", "Whether the back reflects too. Default: true.").aliases("twosided double_sided");
        p.one_of(&mut self.kind);
        p.optional_table(&BUMP, &mut self.bump);
        p.optional(&NORMAL_MAP, &mut self.normal_map, String::new, |p, path| p.value(&NORMAL_MAP, Value::File(path)));
        p.optional(&SHADOWING, &mut self.normal_shadowing, || true, |p, shadowing| p.flag(&SHADOWING, shadowing));
        p.optional(&MIRRORED, &mut self.mirrored_normals, || true, |p, mirrored| p.flag(&MIRRORED, mirrored));
        p.optional(&RELIEF, &mut self.two_sided_relief, || true, |p, relief| p.flag(&RELIEF, relief));
        p.optional(&TWO_SIDED, &mut self.two_sided, || true, |p, two_sided| p.flag(&TWO_SIDED, two_sided));
        p.optional(
            &OPACITY,
            &mut self.opacity,
            || Textured::Constant(1.0),
            |p, opacity| {
                p.textured_number(&OPACITY, opacity, Range::UNIT);
            },
        );
    }
}

/// A texture of heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Bump {
    /// The name of a texture; its luminance is the height.
    pub texture: String,
    /// Height of luminance 1 above luminance 0, metres.
    pub height: f64,
}

impl Default for Bump {
    fn default() -> Self {
        Bump { texture: String::new(), height: 0.01 }
    }
}

impl Declare for Bump {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const HEIGHT: Parameter =
            Parameter::new("height", "Height of luminance 1 above luminance 0.").symbol("h").unit("m").required();
        p.value(&TEXTURE.required(), Value::Name(&mut self.texture, Family::Texture));
        p.number(&HEIGHT, &mut self.height, Range::linear(-1e6, 1e6));
    }
}
