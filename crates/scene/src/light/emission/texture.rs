//! Lights whose radiance is a texture.
use super::{Emission, Emit, Side};
use crate::texture::{TEXTURE, TextureCompiler};
use noisefall_base::declare::{Declare, Family, Kind, Parameter, Parameters, Problem, Value};

/// A radiance given by a texture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texture {
    /// The name of the texture.
    pub name: String,
}

impl Kind for Texture {
    const KIND: Parameter = TEXTURE.required();

    fn chosen(&mut self, p: &mut dyn Parameters) {
        self.parameters(p);
    }
}

impl Declare for Texture {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.value(&Self::KIND, Value::Name(&mut self.name, Family::Texture));
    }
}

impl Emit for Texture {
    fn compile(&self, scale: f32, side: Side, textures: &TextureCompiler) -> Result<Emission, Problem> {
        let id = textures.id("texture", &self.name)?;
        let mean = textures.textures.mean(id).map(|x| x * scale);
        Ok(Emission { radiance: [scale; 3], mean, texture: Some(id), side, translucent: false })
    }
}
