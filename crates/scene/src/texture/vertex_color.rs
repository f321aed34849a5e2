//! The colours of a mesh’s vertices, interpolated; white without them.
use super::{LookupResult, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing, image::Channel};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem},
    math::{Lanes, M, Pick, V},
};

/// The colours of a mesh’s vertices, interpolated; white without them.
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
    const KIND: Parameter = Parameter::new("vertex_color", "The colours of a mesh’s vertices, interpolated; white without them.")
        .aliases("mesh_attribute vertex_colour");
}

impl Declare for VertexColor {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const CHANNEL: Parameter = Parameter::new("channel", "The channels that are used.");
        p.word(&CHANNEL, &mut self.channel);
    }
}

impl Texturing for VertexColor {
    type Pattern = VertexLookup;

    fn compile(&self, _: &mut TextureCompiler) -> Result<VertexLookup, Problem> {
        Ok(VertexLookup(self.channel))
    }
}

/// Vertex colours as the renderer looks them up: their channels. As a height they are flat, because they do not depend on u and v.
pub struct VertexLookup(pub Channel);

impl Pattern for VertexLookup {
    const READS_VERTICES: bool = true;

    /// Vertex colours are at most 1. Their mean depends on the mesh; that of white stands for it.
    fn summary(&self, _: &Textures) -> Summary {
        Summary { mean: [1.0; 3], maximum: [1.0; 3], steps: [Summary::COARSEST, Summary::COARSEST, f32::INFINITY], lookups: 0 }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, _: &Textures, found: &mut LookupResult<L>) {
        let colour = match at.vertex {
            None => V::splat(l, [1.0; 3]),
            Some(&[r, g, b, opacity]) => match self.0 {
                Channel::Rgb => V { x: r, y: g, z: b },
                Channel::Red => V { x: r, y: r, z: r },
                Channel::Green => V { x: g, y: g, z: g },
                Channel::Blue => V { x: b, y: b, z: b },
                Channel::Alpha => V { x: opacity, y: opacity, z: opacity },
            },
        };
        found.colour = here.pick(colour, found.colour);
    }
}
