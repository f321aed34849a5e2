//! The parameters of a principled material.
use super::Principled;
use noisefall_base::declare::{Declare, Meaning, Parameter, Parameters, Range};

pub(super) const BASE_WEIGHT: Parameter = Parameter::new("base_weight", "Factor that multiplies the base colour.");
pub(super) const BASE_COLOR: Parameter =
    Parameter::new("base_color", "Albedo of the diffuse base, and reflectance of the metal at normal incidence.")
        .means(Meaning::Colour);
pub(super) const BASE_DIFFUSE_ROUGHNESS: Parameter =
    Parameter::new("base_diffuse_roughness", "Roughness of the diffuse base; 0 is Lambertian.");
pub(super) const BASE_METALNESS: Parameter = Parameter::new("base_metalness", "Fraction of the base that is metal.");
pub(super) const SPECULAR_WEIGHT: Parameter = Parameter::new(
    "specular_weight",
    "Factor that multiplies the reflectance of the interface; for metals, also at grazing angles.",
);
pub(super) const SPECULAR_COLOR: Parameter =
    Parameter::new("specular_color", "Tint of the reflection off the interface; for metals, only at grazing angles.");
pub(super) const SPECULAR_ROUGHNESS: Parameter =
    Parameter::new("specular_roughness", "Square root of the width α of the GGX distribution.").means(Meaning::Roughness);
pub(super) const SPECULAR_ROUGHNESS_ANISOTROPY: Parameter =
    Parameter::new("specular_roughness_anisotropy", "How much longer the highlight is along the tangent; 0 is round.");
pub(super) const SPECULAR_IOR: Parameter =
    Parameter::new("specular_ior", "Index of refraction of the base.").means(Meaning::IndexOfRefraction);
pub(super) const TRANSMISSION_WEIGHT: Parameter =
    Parameter::new("transmission_weight", "Fraction of the non-metallic base that is clear and refracts.");
pub(super) const TRANSMISSION_COLOR: Parameter =
    Parameter::new("transmission_color", "Colour of the transmitted light, at each interface or after `transmission_depth`.");
pub(super) const TRANSMISSION_DEPTH: Parameter = Parameter::new(
    "transmission_depth",
    "Distance inside after which light has the colour of transmission; 0 tints at the interface.",
)
.unit("m");
pub(super) const COAT_WEIGHT: Parameter = Parameter::new("coat_weight", "Fraction of the surface under a clear coat.");
pub(super) const COAT_COLOR: Parameter =
    Parameter::new("coat_color", "Fraction of the light that the coat transmits, in and out.");
pub(super) const COAT_ROUGHNESS: Parameter = Parameter::new("coat_roughness", "Square root of the width α of the coat.");
pub(super) const COAT_ROUGHNESS_ANISOTROPY: Parameter =
    Parameter::new("coat_roughness_anisotropy", "Anisotropy of the coat; 0 is round.");
pub(super) const COAT_IOR: Parameter = Parameter::new("coat_ior", "Index of refraction of the coat.");
pub(super) const COAT_DARKENING: Parameter =
    Parameter::new("coat_darkening", "How much reflections inside the coat darken the base.");
pub(super) const FUZZ_WEIGHT: Parameter = Parameter::new("fuzz_weight", "Fraction of the surface under fuzz.");
pub(super) const FUZZ_COLOR: Parameter = Parameter::new("fuzz_color", "Albedo of the fuzz.");
pub(super) const FUZZ_ROUGHNESS: Parameter = Parameter::new("fuzz_roughness", "Roughness of the fuzz.");
pub(super) const THIN_FILM_WEIGHT: Parameter = Parameter::new("thin_film_weight", "Fraction of the surface with a thin film.");
pub(super) const THIN_FILM_THICKNESS: Parameter = Parameter::new("thin_film_thickness", "Thickness of the film.").unit("µm");
pub(super) const THIN_FILM_IOR: Parameter = Parameter::new("thin_film_ior", "Index of refraction of the film.");
pub(super) const TANGENT_ROTATION: Parameter =
    Parameter::new("tangent_rotation", "Rotation of the tangent about the normal.").unit("°");
pub(super) const THIN_WALLED: Parameter =
    Parameter::new("thin_walled", "Whether the surface is a thin sheet, which refracts nothing.");

/// Thickness of films, µm.
pub(super) const THICKNESS: Range = Range::linear(0.0, 10.0);

impl Declare for Principled {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.textured_number(&BASE_WEIGHT, &mut self.base_weight, Range::UNIT);
        p.textured(&BASE_COLOR, &mut self.base_color, Range::REFLECTANCE);
        p.textured_number(&BASE_DIFFUSE_ROUGHNESS, &mut self.base_diffuse_roughness, Range::UNIT);
        p.textured_number(&BASE_METALNESS, &mut self.base_metalness, Range::UNIT);
        p.textured_number(&SPECULAR_WEIGHT, &mut self.specular_weight, Range::UNIT);
        p.textured(&SPECULAR_COLOR, &mut self.specular_color, Range::REFLECTANCE);
        p.textured_number(&SPECULAR_ROUGHNESS, &mut self.specular_roughness, Range::ROUGHNESS);
        p.textured_number(&SPECULAR_ROUGHNESS_ANISOTROPY, &mut self.specular_roughness_anisotropy, Range::UNIT);
        p.number(&SPECULAR_IOR, &mut self.specular_ior, Range::INDEX);
        p.textured_number(&TRANSMISSION_WEIGHT, &mut self.transmission_weight, Range::UNIT);
        p.textured(&TRANSMISSION_COLOR, &mut self.transmission_color, Range::REFLECTANCE);
        p.number(&TRANSMISSION_DEPTH, &mut self.transmission_depth, Range::log(0.0, 1e12));
        p.textured_number(&COAT_WEIGHT, &mut self.coat_weight, Range::UNIT);
        p.textured(&COAT_COLOR, &mut self.coat_color, Range::REFLECTANCE);
        p.textured_number(&COAT_ROUGHNESS, &mut self.coat_roughness, Range::ROUGHNESS);
        p.textured_number(&COAT_ROUGHNESS_ANISOTROPY, &mut self.coat_roughness_anisotropy, Range::UNIT);
        p.number(&COAT_IOR, &mut self.coat_ior, Range::linear(1.0, 20.0));
        p.textured_number(&COAT_DARKENING, &mut self.coat_darkening, Range::UNIT);
        p.textured_number(&FUZZ_WEIGHT, &mut self.fuzz_weight, Range::UNIT);
        p.textured(&FUZZ_COLOR, &mut self.fuzz_color, Range::REFLECTANCE);
        p.textured_number(&FUZZ_ROUGHNESS, &mut self.fuzz_roughness, Range::ROUGHNESS);
        p.textured_number(&THIN_FILM_WEIGHT, &mut self.thin_film_weight, Range::UNIT);
        p.textured_number(&THIN_FILM_THICKNESS, &mut self.thin_film_thickness, THICKNESS);
        p.number(&THIN_FILM_IOR, &mut self.thin_film_ior, Range::linear(1.0, 20.0));
        p.number(&TANGENT_ROTATION, &mut self.tangent_rotation, Range::linear(-360.0, 360.0));
        p.flag(&THIN_WALLED, &mut self.thin_walled);
    }
}
