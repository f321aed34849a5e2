//! Compiled materials and their compiler.
use super::{Roughness, Stage, tables::Tables};
use crate::texture::{ColourSource, TextureCompiler};
use noisefall_base::{
    declare::{Parameter, Problem, Range, Textured},
    math::colour::luminance,
};

/// The width α of the distribution of microfacet slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaSource {
    /// A constant width.
    Constant(f32),
    /// The luminance of a texture is α, or its root if `squared`.
    Texture {
        /// Number of the texture.
        id: u32,
        /// Whether the texture holds the root of α.
        squared: bool,
    },
}

/// A material as the kernel reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct CompiledMaterial {
    /// The stage that shades it.
    pub stage: Stage,
    /// Constants of the kind: see its row.
    pub rows: [[f32; 4]; 3],
    /// Further constants. The last number of `rows` becomes the place of the first of them, as bits.
    pub further: Vec<[f32; 4]>,
    /// Whether its shading reads texture coordinates or the tangent.
    pub charted: bool,
    /// Albedo, or reflectance at normal incidence; white for kinds without.
    pub colour: ColourSource,
    /// Diffuse transmittance, for kinds with one.
    pub transmittance: Option<ColourSource>,
    /// The width α of the GGX distribution.
    pub alpha: AlphaSource,
    /// Transmittance of a metre of the interior, for kinds with an inside.
    pub inside: Option<[f32; 3]>,
    /// Whether it transmits light without an inside.
    pub sheet: bool,
    /// Whether it scatters light even if its colour is black, because of a coat or Fresnel's rise towards grazing angles.
    pub scatters_where_black: bool,
    /// The largest albedo in any channel that lets light bounce between surfaces; 0 for materials that only transmit light
    /// onwards.
    pub albedo: f32,
}

impl CompiledMaterial {
    /// A smooth material with this stage and colour.
    pub fn new(stage: Stage, colour: ColourSource, compiler: &MaterialCompiler) -> CompiledMaterial {
        CompiledMaterial {
            stage,
            rows: [[0.0; 4]; 3],
            further: Vec::new(),
            charted: false,
            colour,
            transmittance: None,
            alpha: AlphaSource::Constant(0.0),
            inside: None,
            sheet: false,
            scatters_where_black: false,
            albedo: compiler.largest(colour),
        }
    }

    /// A material that scatters nothing.
    pub fn black() -> CompiledMaterial {
        let colour = ColourSource::Constant([0.0; 3]);
        CompiledMaterial { colour, scatters_where_black: false, ..CompiledMaterial::colourless(Stage::Plain) }
    }

    /// A material of a stage without a colour.
    pub fn colourless(stage: Stage) -> CompiledMaterial {
        CompiledMaterial {
            stage,
            rows: [[0.0; 4]; 3],
            further: Vec::new(),
            charted: false,
            colour: ColourSource::Constant([1.0; 3]),
            transmittance: None,
            alpha: AlphaSource::Constant(0.0),
            inside: None,
            sheet: false,
            scatters_where_black: true,
            albedo: 0.0,
        }
    }
}

/// Compiler of materials, with the textures and tables that they share.
pub struct MaterialCompiler<'a, 'b> {
    textures: &'a TextureCompiler<'b>,
    pub(super) tables: &'a mut Tables,
}

impl<'a, 'b> MaterialCompiler<'a, 'b> {
    pub(super) fn new(textures: &'a TextureCompiler<'b>, tables: &'a mut Tables) -> Self {
        MaterialCompiler { textures, tables }
    }

    /// The colour of a parameter, or its texture.
    pub fn colour(&self, parameter: &Parameter, value: &Textured, range: &Range) -> Result<ColourSource, Problem> {
        self.textures.colour(parameter, value, range)
    }

    /// α and its largest value, which decides whether the surface is rough.
    pub fn alpha(&self, roughness: &Roughness) -> Result<(AlphaSource, f32), Problem> {
        let (parameter, value, squared) = roughness.parts();
        self.alpha_of(parameter, value, squared)
    }

    /// α and its largest value, from a parameter whose value is α, or its root if `squared`.
    pub fn alpha_of(&self, parameter: &Parameter, value: &Textured<f64>, squared: bool) -> Result<(AlphaSource, f32), Problem> {
        let alpha = |value: f32| if squared { value * value } else { value };
        match value {
            Textured::Constant(value) => {
                let alpha = alpha(*value as f32);
                Ok((AlphaSource::Constant(alpha), alpha))
            }
            Textured::Texture(name) => {
                let named = Textured::Texture(name.clone());
                let source = self.textures.colour(parameter, &named, &Range::ROUGHNESS)?;
                let ColourSource::Texture(id) = source else { return Ok((AlphaSource::Constant(0.0), 0.0)) };
                let most = luminance(self.textures.textures.maximum(id));
                Ok((AlphaSource::Texture { id, squared }, alpha(most)))
            }
        }
    }

    /// The number of a parameter in all channels, or its texture, whose luminance it is.
    pub fn number(&self, parameter: &Parameter, value: &Textured<f64>, range: &Range) -> Result<ColourSource, Problem> {
        self.textures.colour(parameter, &value.clone().map(|value| [value; 3]), range)
    }

    /// The colour, or the mean colour of the texture.
    pub fn typical(&self, colour: ColourSource) -> [f32; 3] {
        self.textures.typical(colour)
    }

    /// The largest value of any channel, at most 1.
    pub fn largest(&self, colour: ColourSource) -> f32 {
        self.textures.largest(colour)
    }

    /// The largest value of each channel.
    pub(super) fn maximum(&self, colour: ColourSource) -> [f32; 3] {
        self.textures.maximum(colour)
    }
}
