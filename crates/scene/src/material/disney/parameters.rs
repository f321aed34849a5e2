//! The parameters of Disney's BSDF.
use super::Disney;
use noisefall_base::declare::{Declare, Meaning, Parameter, Parameters, Range};

pub(super) const BASE_COLOR: Parameter =
    Parameter::new("base_color", "Albedo of the diffuse base, and reflectance of the metal at normal incidence.")
        .aliases("color colour albedo reflectance")
        .means(Meaning::Colour);
pub(super) const METALLIC: Parameter =
    Parameter::new("metallic", "Fraction of the base that is metal.").aliases("metalness metal");
pub(super) const ROUGHNESS: Parameter =
    Parameter::new("roughness", "Square root of the width α of the GGX distribution.").means(Meaning::Roughness);
pub(super) const ANISOTROPIC: Parameter =
    Parameter::new("anisotropic", "How much longer the highlight is along the tangent; 0 is round.").aliases("anisotropy");
pub(super) const IOR: Parameter = Parameter::new("ior", "Index of refraction. With 1, nothing is reflected, even by metal.")
    .symbol("η")
    .aliases("eta index")
    .means(Meaning::IndexOfRefraction);
pub(super) const SPEC_TINT: Parameter =
    Parameter::new("spec_tint", "How strongly the hue of the base colour tints the reflection off the interface.")
        .aliases("specular_tint");
pub(super) const SPEC_TRANS: Parameter =
    Parameter::new("spec_trans", "Fraction of the non-metallic base that is clear and refracts.")
        .aliases("transmission specular_transmission");
pub(super) const FLATNESS: Parameter =
    Parameter::new("flatness", "How strongly the diffuse lobe resembles thin subsurface scattering.");
pub(super) const SHEEN: Parameter = Parameter::new("sheen", "Amount of light that fibres reflect at grazing angles.");
pub(super) const SHEEN_TINT: Parameter = Parameter::new("sheen_tint", "How strongly the hue of the base colour tints the sheen.");
pub(super) const CLEARCOAT: Parameter =
    Parameter::new("clearcoat", "Strength of the clear coat. It takes no light from the base.");
pub(super) const CLEARCOAT_GLOSS: Parameter =
    Parameter::new("clearcoat_gloss", "Sharpness of the clear coat: its facets have a width from 0.1 to 0.001.");

impl Declare for Disney {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.textured(&BASE_COLOR, &mut self.base_color, Range::REFLECTANCE);
        p.textured_number(&METALLIC, &mut self.metallic, Range::UNIT);
        p.textured_number(&ROUGHNESS, &mut self.roughness, Range::ROUGHNESS);
        p.textured_number(&ANISOTROPIC, &mut self.anisotropic, Range::UNIT);
        p.number(&IOR, &mut self.ior, Range::INDEX);
        p.textured_number(&SPEC_TINT, &mut self.spec_tint, Range::UNIT);
        p.textured_number(&SPEC_TRANS, &mut self.spec_trans, Range::UNIT);
        p.textured_number(&FLATNESS, &mut self.flatness, Range::UNIT);
        p.textured_number(&SHEEN, &mut self.sheen, Range::UNIT);
        p.textured_number(&SHEEN_TINT, &mut self.sheen_tint, Range::UNIT);
        p.textured_number(&CLEARCOAT, &mut self.clearcoat, Range::UNIT);
        p.textured_number(&CLEARCOAT_GLOSS, &mut self.clearcoat_gloss, Range::UNIT);
    }
}
