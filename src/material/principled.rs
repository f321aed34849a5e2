//! OpenPBR Surface 1.1: metal, glass, diffuse base, coat and fuzz in one material.
use super::{Compile, CompiledMaterial, MaterialCompiler};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured};

/// OpenPBR Surface 1.1 in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Principled {
    /// Factor of the base color.
    pub base_weight: Textured<f64>,
    /// Albedo of the diffuse base, and reflectance of the metal at normal incidence.
    pub base_color: Textured,
    /// Roughness of the diffuse base; 0 is Lambertian.
    pub base_diffuse_roughness: Textured<f64>,
    /// Fraction of the base that is metal.
    pub base_metalness: Textured<f64>,
    /// Factor of the reflectance of the interface; of metals, at grazing angles too.
    pub specular_weight: Textured<f64>,
    /// Tint of the reflection off the interface; of metals, at grazing angles.
    pub specular_color: Textured,
    /// Square root of the width α of the GGX distribution.
    pub specular_roughness: Textured<f64>,
    /// How much longer the highlight is across the tangent; 0 is round.
    pub specular_roughness_anisotropy: Textured<f64>,
    /// Index of refraction of the base.
    pub specular_ior: f64,
    /// Fraction of the base, besides metal, that is clear and refracts.
    pub transmission_weight: Textured<f64>,
    /// Color of the light that passes: at each interface, or after the depth.
    pub transmission_color: Textured,
    /// Distance after which the inside has its color; 0 tints the interface. Metres.
    pub transmission_depth: f64,
    /// Fraction of the surface under a clear coat.
    pub coat_weight: Textured<f64>,
    /// Fraction of the light that the coat transmits, in and out.
    pub coat_color: Textured,
    /// Square root of the width α of the coat.
    pub coat_roughness: Textured<f64>,
    /// Anisotropy of the coat; 0 is round.
    pub coat_roughness_anisotropy: Textured<f64>,
    /// Index of refraction of the coat.
    pub coat_ior: f64,
    /// How much reflections inside the coat darken the base.
    pub coat_darkening: Textured<f64>,
    /// Fraction of the surface under fuzz.
    pub fuzz_weight: Textured<f64>,
    /// Albedo of the fuzz.
    pub fuzz_color: Textured,
    /// Roughness of the fuzz.
    pub fuzz_roughness: Textured<f64>,
    /// Fraction of the surface with a thin film.
    pub thin_film_weight: Textured<f64>,
    /// Thickness of the film. Micrometres.
    pub thin_film_thickness: Textured<f64>,
    /// Index of refraction of the film.
    pub thin_film_ior: f64,
    /// Rotation of the tangent about the normal, degrees.
    pub tangent_rotation: f64,
    /// Whether the surface is a thin sheet, which refracts nothing.
    pub thin_walled: bool,
}

impl Default for Principled {
    fn default() -> Self {
        Principled {
            base_weight: Textured::Constant(1.0),
            base_color: Textured::grey(0.8),
            base_diffuse_roughness: Textured::Constant(0.0),
            base_metalness: Textured::Constant(0.0),
            specular_weight: Textured::Constant(1.0),
            specular_color: Textured::grey(1.0),
            specular_roughness: Textured::Constant(0.3),
            specular_roughness_anisotropy: Textured::Constant(0.0),
            specular_ior: 1.5,
            transmission_weight: Textured::Constant(0.0),
            transmission_color: Textured::grey(1.0),
            transmission_depth: 0.0,
            coat_weight: Textured::Constant(0.0),
            coat_color: Textured::grey(1.0),
            coat_roughness: Textured::Constant(0.0),
            coat_roughness_anisotropy: Textured::Constant(0.0),
            coat_ior: 1.6,
            coat_darkening: Textured::Constant(1.0),
            fuzz_weight: Textured::Constant(0.0),
            fuzz_color: Textured::grey(1.0),
            fuzz_roughness: Textured::Constant(0.5),
            thin_film_weight: Textured::Constant(0.0),
            thin_film_thickness: Textured::Constant(0.5),
            thin_film_ior: 1.4,
            tangent_rotation: 0.0,
            thin_walled: false,
        }
    }
}

impl Kind for Principled {
    const KIND: Parameter =
        Parameter::new("principled", "OpenPBR Surface: diffuse base, metal or glass, with coat, fuzz and thin film.")
            .aliases("openpbr disney standard_surface pbr uber");
}

impl Declare for Principled {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const BASE_WEIGHT: Parameter = Parameter::new("base_weight", "Factor of the base color.");
        const BASE_COLOR: Parameter =
            Parameter::new("base_color", "Albedo of the diffuse base, and reflectance of the metal at normal incidence.");
        const BASE_DIFFUSE_ROUGHNESS: Parameter =
            Parameter::new("base_diffuse_roughness", "Roughness of the diffuse base; 0 is Lambertian.");
        const BASE_METALNESS: Parameter = Parameter::new("base_metalness", "Fraction of the base that is metal.");
        const SPECULAR_WEIGHT: Parameter =
            Parameter::new("specular_weight", "Factor of the reflectance of the interface; of metals, at grazing angles too.");
        const SPECULAR_COLOR: Parameter =
            Parameter::new("specular_color", "Tint of the reflection off the interface; of metals, at grazing angles.");
        const SPECULAR_ROUGHNESS: Parameter =
            Parameter::new("specular_roughness", "Square root of the width α of the GGX distribution.");
        const SPECULAR_ROUGHNESS_ANISOTROPY: Parameter =
            Parameter::new("specular_roughness_anisotropy", "How much longer the highlight is across the tangent; 0 is round.");
        const SPECULAR_IOR: Parameter = Parameter::new("specular_ior", "Index of refraction of the base.");
        const TRANSMISSION_WEIGHT: Parameter =
            Parameter::new("transmission_weight", "Fraction of the base, besides metal, that is clear and refracts.");
        const TRANSMISSION_COLOR: Parameter =
            Parameter::new("transmission_color", "Color of the light that passes: at each interface, or after the depth.");
        const TRANSMISSION_DEPTH: Parameter =
            Parameter::new("transmission_depth", "Distance after which the inside has its color; 0 tints the interface.")
                .unit("m");
        const COAT_WEIGHT: Parameter = Parameter::new("coat_weight", "Fraction of the surface under a clear coat.");
        const COAT_COLOR: Parameter = Parameter::new("coat_color", "Fraction of the light that the coat transmits, in and out.");
        const COAT_ROUGHNESS: Parameter = Parameter::new("coat_roughness", "Square root of the width α of the coat.");
        const COAT_ROUGHNESS_ANISOTROPY: Parameter =
            Parameter::new("coat_roughness_anisotropy", "Anisotropy of the coat; 0 is round.");
        const COAT_IOR: Parameter = Parameter::new("coat_ior", "Index of refraction of the coat.");
        const COAT_DARKENING: Parameter =
            Parameter::new("coat_darkening", "How much reflections inside the coat darken the base.");
        const FUZZ_WEIGHT: Parameter = Parameter::new("fuzz_weight", "Fraction of the surface under fuzz.");
        const FUZZ_COLOR: Parameter = Parameter::new("fuzz_color", "Albedo of the fuzz.");
        const FUZZ_ROUGHNESS: Parameter = Parameter::new("fuzz_roughness", "Roughness of the fuzz.");
        const THIN_FILM_WEIGHT: Parameter = Parameter::new("thin_film_weight", "Fraction of the surface with a thin film.");
        const THIN_FILM_THICKNESS: Parameter = Parameter::new("thin_film_thickness", "Thickness of the film.").unit("µm");
        const THIN_FILM_IOR: Parameter = Parameter::new("thin_film_ior", "Index of refraction of the film.");
        const TANGENT_ROTATION: Parameter =
            Parameter::new("tangent_rotation", "Rotation of the tangent about the normal.").unit("degrees");
        const THIN_WALLED: Parameter =
            Parameter::new("thin_walled", "Whether the surface is a thin sheet, which refracts nothing.");
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
        p.textured_number(&THIN_FILM_THICKNESS, &mut self.thin_film_thickness, Range::linear(0.0, 10.0));
        p.number(&THIN_FILM_IOR, &mut self.thin_film_ior, Range::linear(1.0, 20.0));
        p.number(&TANGENT_ROTATION, &mut self.tangent_rotation, Range::FINITE);
        p.flag(&THIN_WALLED, &mut self.thin_walled);
    }
}

impl Compile for Principled {
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
