//! A surface that does not touch light: its opacity is 0 (`scene/compile/material.rs`), so no path meets it.
use super::{Compile, CompiledMaterial, MaterialCompiler};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A surface that does not touch light, in a scene description.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Null;

impl Kind for Null {
    const KIND: Parameter = Parameter::new("null", "A surface that light passes unchanged.")
        .aliases("invisible interface passthrough")
        .advice("such as null = {}");
}

impl Declare for Null {
    fn parameters(&mut self, _: &mut dyn Parameters) {}
}

impl Compile for Null {
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        Ok(CompiledMaterial::black())
    }

    fn is_clear(&self) -> bool {
        true
    }
}
