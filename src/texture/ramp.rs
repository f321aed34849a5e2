//! Colors along a scale, interpolated between stops.
use super::{Constant, TextureCompiler, Texturing};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured};

/// Colors along a scale, interpolated between stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    /// Place on the scale.
    pub input: Textured<f64>,
    /// Colors by place, in ascending order.
    pub stops: Vec<Stop>,
}

/// A color at a place of a scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stop {
    /// Place, from 0 to 1.
    pub at: f64,
    /// The color there.
    pub color: [f64; 3],
}

impl Declare for Stop {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const AT: Parameter = Parameter::new("at", "Place on the scale.").required();
        const COLOR: Parameter = Parameter::new("color", "The color there.").required();
        p.number(&AT, &mut self.at, Range::UNIT);
        p.colour(&COLOR, &mut self.color, Range::RADIANCE);
    }
}

impl Default for Ramp {
    fn default() -> Self {
        Ramp { input: Textured::Constant(0.5), stops: vec![Stop { at: 0.0, color: [0.0; 3] }, Stop { at: 1.0, color: [1.0; 3] }] }
    }
}

impl Kind for Ramp {
    const KIND: Parameter =
        Parameter::new("ramp", "Colors along a scale, interpolated between stops.").aliases("gradient color_ramp");
}

impl Declare for Ramp {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const INPUT: Parameter = Parameter::new("input", "Place on the scale.").required();
        const STOPS: Parameter = Parameter::new("stops", "Colors by place, in ascending order.").required();
        p.textured_number(&INPUT, &mut self.input, Range::UNIT);
        p.list(&STOPS, &mut self.stops);
    }
}

impl Texturing for Ramp {
    type Pattern = Constant;

    fn compile(&self, _: &mut TextureCompiler) -> Result<Constant, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
