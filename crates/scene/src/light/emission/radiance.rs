//! Lights of a constant radiance.
use super::{Emission, Emit, Side};
use crate::{light::parameters::RADIANCE, texture::TextureCompiler};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range};

/// A constant radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Radiance {
    /// W·sr⁻¹·m⁻², linear Rec. 709.
    pub radiance: [f64; 3],
}

impl Default for Radiance {
    fn default() -> Self {
        Radiance { radiance: [1.0; 3] }
    }
}

impl Kind for Radiance {
    const KIND: Parameter = RADIANCE;

    fn chosen(&mut self, p: &mut dyn Parameters) {
        self.parameters(p);
    }
}

impl Declare for Radiance {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.colour(&RADIANCE, &mut self.radiance, Range::RADIANCE);
    }
}

impl Emit for Radiance {
    fn compile(&self, scale: f32, side: Side, _: &TextureCompiler) -> Result<Emission, Problem> {
        let radiance = self.radiance.map(|x| x as f32 * scale);
        Ok(Emission { radiance, mean: radiance, texture: None, side, translucent: false })
    }
}
