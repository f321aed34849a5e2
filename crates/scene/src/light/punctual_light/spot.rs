//! A light without size that shines within a cone.
use glam::{DAffine3, DVec3};

pub use super::falloff::Falloff;
use super::{PunctualLight, PunctualLightKind, Shine, intensity};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources};

/// A light without size that shines within a cone.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Position of the light.
    pub position: DVec3,
    /// Point that the light is aimed at.
    pub target: DVec3,
    /// Radiant intensity on the axis.
    pub intensity: [f64; 3],
    /// Angle between the axis and the edge of the cone, where the light ends.
    pub angle: f64,
    /// Angle up to which the intensity is that of the axis; at most `angle`.
    pub inner: f64,
    /// How the intensity falls from `inner` to `angle`.
    pub falloff: Falloff,
}

impl Default for Spot {
    fn default() -> Self {
        Spot {
            position: DVec3::new(0.0, 2.0, 0.0),
            target: DVec3::ZERO,
            intensity: [1.0; 3],
            angle: 30.0,
            inner: 20.0,
            falloff: Falloff::Smooth,
        }
    }
}

impl Kind for Spot {
    const KIND: Parameter =
        Parameter::new("spot", "A light without size that shines within a cone.").aliases("spotlight spot_light");
}

impl Declare for Spot {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const POSITION: Parameter = Parameter::new("position", "Position of the light.").unit("m");
        const TARGET: Parameter = Parameter::new("target", "Point that the light is aimed at.").unit("m");
        const INTENSITY: Parameter = Parameter::new("intensity", "Radiant intensity on the axis.").unit("W·sr⁻¹");
        const ANGLE: Parameter =
            Parameter::new("angle", "Angle between the axis and the edge of the cone, where the light ends.").unit("°");
        const INNER: Parameter =
            Parameter::new("inner", "Angle up to which the intensity is that of the axis; at most `angle`.").unit("°");
        const FALLOFF: Parameter = Parameter::new("falloff", "How the intensity falls from `inner` to `angle`.");
        p.point(&POSITION, &mut self.position);
        p.point(&TARGET, &mut self.target);
        p.colour(&INTENSITY, &mut self.intensity, Range::RADIANCE);
        p.number(&ANGLE, &mut self.angle, Range::linear(0.01, 180.0));
        p.number(&INNER, &mut self.inner, Range::linear(0.0, 180.0));
        p.word(&FALLOFF, &mut self.falloff);
    }
}

impl Shine for Spot {
    fn compile(&self, map: &DAffine3, _: &Resources) -> Result<PunctualLight, Problem> {
        let [position, target] = [self.position, self.target].map(|p| map.transform_point3(p));
        let axis = axis(position, target)?;
        let angles = [self.inner, self.angle].map(f64::to_radians);
        Ok(PunctualLight::spot(position, self.intensity, axis, angles, self.falloff))
    }

    fn position(&self) -> Option<DVec3> {
        Some(self.position)
    }

    fn moved(&self, map: &DAffine3) -> Vec<(&'static str, DVec3)> {
        vec![("position", map.transform_point3(self.position)), ("target", map.transform_point3(self.target))]
    }

    fn placed(&self, position: DVec3, target: DVec3, irradiance: f64) -> PunctualLightKind {
        Spot { position, target, intensity: [intensity(position, target, irradiance); 3], ..Spot::default() }.into()
    }
}

/// The unit direction from a light to its target.
pub(super) fn axis(position: DVec3, target: DVec3) -> Result<DVec3, Problem> {
    let axis = (target - position).try_normalize();
    axis.ok_or_else(|| Problem::at("target", "`target` and `position` are the same point", "the light shines in no direction"))
}
