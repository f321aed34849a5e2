//! A thin sheet that reflects and transmits diffusely: leaves, paper.
use super::{Compile, CompiledMaterial, MaterialCompiler};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured};

/// A thin sheet that reflects and transmits diffusely, in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// Fraction of the light that is reflected.
    pub reflectance: Textured,
    /// Fraction of the light that is transmitted.
    pub transmittance: Textured,
}

impl Default for DiffuseTransmission {
    fn default() -> Self {
        DiffuseTransmission { reflectance: Textured::grey(0.25), transmittance: Textured::grey(0.25) }
    }
}

impl Kind for DiffuseTransmission {
    const KIND: Parameter =
        Parameter::new("diffuse_transmission", "A thin sheet, such as a leaf or paper, that reflects and transmits diffusely.")
            .aliases("translucent leaf paper diffusetransmission");
}

impl Declare for DiffuseTransmission {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const REFLECTANCE: Parameter =
            Parameter::new("reflectance", "Fraction of the light that is reflected, per channel.").symbol("ρ").required();
        const TRANSMITTANCE: Parameter =
            Parameter::new("transmittance", "Fraction of the light that is transmitted, per channel.").symbol("τ").required();
        p.textured(&REFLECTANCE, &mut self.reflectance, Range::REFLECTANCE);
        p.textured(&TRANSMITTANCE, &mut self.transmittance, Range::REFLECTANCE);
    }
}

impl Compile for DiffuseTransmission {
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
