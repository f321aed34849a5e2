//! A mixture of two materials.
use super::{Compile, CompiledMaterial, MaterialCompiler};
use crate::declare::{Declare, Family, Kind, Parameter, Parameters, Problem, Range, Textured, Value};

/// A mixture of two materials in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Blend {
    /// Name of the first material.
    pub first: String,
    /// Name of the second material.
    pub second: String,
    /// Fraction of the second material, from 0 to 1.
    pub weight: Textured<f64>,
}

impl Default for Blend {
    fn default() -> Self {
        Blend { first: String::new(), second: String::new(), weight: Textured::Constant(0.5) }
    }
}

impl Kind for Blend {
    const KIND: Parameter = Parameter::new("blend", "A mixture of two materials.").aliases("mix blendbsdf");
}

impl Declare for Blend {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const FIRST: Parameter = Parameter::new("first", "Name of the first material.").required();
        const SECOND: Parameter = Parameter::new("second", "Name of the second material.").required();
        const WEIGHT: Parameter = Parameter::new("weight", "Fraction of the second material.").symbol("w");
        p.value(&FIRST, Value::Name(&mut self.first, Family::Material));
        p.value(&SECOND, Value::Name(&mut self.second, Family::Material));
        p.textured_number(&WEIGHT, &mut self.weight, Range::UNIT);
    }
}

impl Compile for Blend {
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
