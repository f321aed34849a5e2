//! A mixture of two colors or textures.
use super::{Constant, TextureCompiler, Texturing};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured};

/// A mixture of two colors or textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// Color where the weight is 0.
    pub a: Textured,
    /// Color where the weight is 1.
    pub b: Textured,
    /// Fraction of the second color.
    pub weight: Textured<f64>,
}

impl Default for Mix {
    fn default() -> Self {
        Mix { a: Textured::grey(0.0), b: Textured::grey(1.0), weight: Textured::Constant(0.5) }
    }
}

impl Kind for Mix {
    const KIND: Parameter = Parameter::new("mix", "A mixture of two colors or textures.").aliases("lerp blend_texture");
}

impl Declare for Mix {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const A: Parameter = Parameter::new("a", "Color where the weight is 0.").required();
        const B: Parameter = Parameter::new("b", "Color where the weight is 1.").required();
        const WEIGHT: Parameter = Parameter::new("weight", "Fraction of the second color.");
        p.textured(&A, &mut self.a, Range::RADIANCE);
        p.textured(&B, &mut self.b, Range::RADIANCE);
        p.textured_number(&WEIGHT, &mut self.weight, Range::UNIT);
    }
}

impl Texturing for Mix {
    type Pattern = Constant;

    fn compile(&self, _: &mut TextureCompiler) -> Result<Constant, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
