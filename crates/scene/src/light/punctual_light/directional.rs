//! Parallel light, as from a distant sun.
use glam::{DAffine3, DVec3};

use super::{PunctualLight, PunctualLightKind, Shine};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value};

/// Parallel light, as from a distant sun.
#[derive(Clone, Debug, PartialEq)]
pub struct Directional {
    /// Direction in which the light travels, of any length.
    pub direction: DVec3,
    /// Irradiance of a surface that faces the light.
    pub irradiance: [f64; 3],
}

impl Default for Directional {
    fn default() -> Self {
        Directional { direction: DVec3::new(0.0, -1.0, 0.0), irradiance: [1.0; 3] }
    }
}

impl Kind for Directional {
    const KIND: Parameter =
        Parameter::new("directional", "Parallel light, as from a distant sun.").aliases("sun distant directional_light");
}

impl Declare for Directional {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const DIRECTION: Parameter = Parameter::new("direction", "Direction in which the light travels, of any length.");
        const IRRADIANCE: Parameter = Parameter::new("irradiance", "Irradiance of a surface that faces the light.").unit("W·m⁻²");
        p.value(&DIRECTION, Value::Vector(&mut self.direction));
        p.colour(&IRRADIANCE, &mut self.irradiance, Range::RADIANCE);
    }
}

impl Shine for Directional {
    fn compile(&self, map: &DAffine3, _: &Resources) -> Result<PunctualLight, Problem> {
        let direction = map.transform_vector3(self.direction).try_normalize();
        let direction = direction.ok_or_else(|| Problem::at("direction", "the light has no direction", "it must not be zero"))?;
        Ok(PunctualLight::directional(-direction, self.irradiance))
    }

    fn position(&self) -> Option<DVec3> {
        None
    }

    fn moved(&self, map: &DAffine3) -> Vec<(&'static str, DVec3)> {
        vec![("direction", map.transform_vector3(self.direction))]
    }

    fn placed(&self, position: DVec3, target: DVec3, irradiance: f64) -> PunctualLightKind {
        Directional { direction: target - position, irradiance: [irradiance; 3] }.into()
    }
}
