//! The colors of a mesh’s vertices, interpolated; white without them.
use super::{Constant, TextureCompiler, Texturing, image::Channel};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// The colors of a mesh’s vertices, interpolated; white without them.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexColor {
    /// The channels that are used.
    pub channel: Channel,
}

impl Default for VertexColor {
    fn default() -> Self {
        VertexColor { channel: Channel::Rgb }
    }
}

impl Kind for VertexColor {
    const KIND: Parameter = Parameter::new("vertex_color", "The colors of a mesh’s vertices, interpolated; white without them.")
        .aliases("mesh_attribute vertex_colour");
}

impl Declare for VertexColor {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const CHANNEL: Parameter = Parameter::new("channel", "The channels that are used.");
        p.word(&CHANNEL, &mut self.channel);
    }
}

impl Texturing for VertexColor {
    type Pattern = Constant;

    fn compile(&self, _: &mut TextureCompiler) -> Result<Constant, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
