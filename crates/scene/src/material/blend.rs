//! A mixture of two materials.
//!
//! Every hit is at one of the two, with the probability of its weight, so that the mean is that of the sum of both BSDFs by weight
//! (M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", 4th edition, section 10.5.2). The surface stage of the kernel
//! therefore never sees a blend, only its parts (`integrator/passage.rs`). A blend by side is one of the two on its front, and the other
//! on its back. A blend of diffuse surfaces is compiled to one of them, without
//! a choice (`scene/compile/merge.rs`).
use super::{Compile, CompiledMaterial, MaterialCompiler};
use noisefall_base::declare::{Declare, Family, Kind, Parameter, Parameters, Problem, Range, Textured, Value};

/// A mixture of two materials in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Blend {
    /// Name of the first material.
    pub first: String,
    /// Name of the second material.
    pub second: String,
    /// Fraction of the second material, from 0 to 1.
    pub weight: Textured<f64>,
    /// Whether the front is of the first material alone, and the back of the second.
    pub by_side: bool,
}

impl Blend {
    /// The key of the weight.
    pub const WEIGHT: Parameter = Parameter::new("weight", "Fraction of the second material.").symbol("w");
}

impl Default for Blend {
    fn default() -> Self {
        Blend { first: String::new(), second: String::new(), weight: Textured::Constant(0.5), by_side: false }
    }
}

impl Kind for Blend {
    const KIND: Parameter = Parameter::new("blend", "A mixture of two materials. Each may itself be a blend or `null`.")
        .aliases("mix blendbsdf")
        .advice("such as blend = { first = \"paint\", second = \"rust\", weight = 0.3 }");
}

impl Declare for Blend {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const FIRST: Parameter = Parameter::new("first", "Name of the first material.").required();
        const SECOND: Parameter = Parameter::new("second", "Name of the second material.").required();
        const BY_SIDE: Parameter = Parameter::new(
            "by_side",
            "Whether the front has the first material and the back the second, regardless of the weight.",
        )
        .aliases("sides front_and_back");
        p.value(&FIRST, Value::Name(&mut self.first, Family::Material));
        p.value(&SECOND, Value::Name(&mut self.second, Family::Material));
        p.textured_number(&Self::WEIGHT, &mut self.weight, Range::UNIT);
        p.flag(&BY_SIDE, &mut self.by_side);
    }
}

impl Compile for Blend {
    /// The names are known once all materials are compiled: see `scene/compile/blend.rs`.
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        Ok(CompiledMaterial::black())
    }
}
