//! A light without size that shines equally in all directions.
use glam::{DAffine3, DVec3};

use super::{PunctualLight, PunctualLightKind, Shine, intensity};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources};

/// A light without size that shines equally in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Position of the light.
    pub position: DVec3,
    /// Radiant intensity of each channel.
    pub intensity: [f64; 3],
}

impl Default for Point {
    fn default() -> Self {
        Point { position: DVec3::new(0.0, 2.0, 0.0), intensity: [1.0; 3] }
    }
}

impl Kind for Point {
    const KIND: Parameter =
        Parameter::new("point", "A light without size that shines equally in all directions.").aliases("point_light omni");
}

impl Declare for Point {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const POSITION: Parameter = Parameter::new("position", "Position of the light.").unit("m");
        const INTENSITY: Parameter = Parameter::new("intensity", "Radiant intensity of each channel.").unit("W·sr⁻¹");
        p.point(&POSITION, &mut self.position);
        p.colour(&INTENSITY, &mut self.intensity, Range::RADIANCE);
    }
}

impl Shine for Point {
    fn compile(&self, map: &DAffine3, _: &Resources) -> Result<PunctualLight, Problem> {
        Ok(PunctualLight::point(map.transform_point3(self.position), self.intensity))
    }

    fn position(&self) -> Option<DVec3> {
        Some(self.position)
    }

    fn moved(&self, map: &DAffine3) -> Vec<(&'static str, DVec3)> {
        vec![("position", map.transform_point3(self.position))]
    }

    fn placed(&self, position: DVec3, target: DVec3, irradiance: f64) -> PunctualLightKind {
        Point { position, intensity: [intensity(position, target, irradiance); 3] }.into()
    }
}
