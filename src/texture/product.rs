//! The product of two colors or textures.
use super::{Constant, TextureCompiler, Texturing};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured};

/// The product of two colors or textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// First factor.
    pub a: Textured,
    /// Second factor.
    pub b: Textured,
}

impl Default for Product {
    fn default() -> Self {
        Product { a: Textured::grey(1.0), b: Textured::grey(1.0) }
    }
}

impl Kind for Product {
    const KIND: Parameter = Parameter::new("product", "The product of two colors or textures.").aliases("multiply scale");
}

impl Declare for Product {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const A: Parameter = Parameter::new("a", "First factor.").required();
        const B: Parameter = Parameter::new("b", "Second factor.").required();
        p.textured(&A, &mut self.a, Range::RADIANCE);
        p.textured(&B, &mut self.b, Range::RADIANCE);
    }
}

impl Texturing for Product {
    type Pattern = Constant;

    fn compile(&self, _: &mut TextureCompiler) -> Result<Constant, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
