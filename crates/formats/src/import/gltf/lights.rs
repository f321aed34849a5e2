//! Lights of KHR_lights_punctual.
//!
//! The file states candela and lux. They become W/sr and W/m² in every channel by 683 lm/W, the luminous efficacy that defines the
//! candela. Blender multiplies by the same number when it exports, so its watts come back.
use glam::{DAffine3, DVec3};

use super::extensions::Light;
use crate::import::Remarks;
use noisefall_scene::{
    light::punctual_light::{
        PunctualLightKind,
        directional::Directional,
        point::Point,
        spot::{Falloff, Spot},
    },
    scene::description::PunctualLightDescription,
};

/// Lumens of a watt.
pub const EFFICACY: f64 = 683.0;

/// A light at a place; `None` if it is dark or of no known type. It shines along −z of its node.
pub fn punctual_light(
    light: &Light,
    name: &str,
    world: &DAffine3,
    remarks: &mut Remarks,
    place: &str,
) -> Option<PunctualLightDescription> {
    let power = light.color.map(|x| x.max(0.0) * light.intensity.max(0.0) / EFFICACY);
    let position = world.translation;
    if power.iter().all(|x| *x <= 0.0) || !position.is_finite() {
        return None;
    }
    let direction = (world.matrix3 * DVec3::NEG_Z).try_normalize().unwrap_or(DVec3::NEG_Z);
    if light.range.is_some() {
        remarks.add(place, "`range` of a light", "no limit", "the light also lights what is farther away");
    }
    let kind: PunctualLightKind = match light.r#type.as_str() {
        "directional" => Directional { direction, irradiance: power }.into(),
        "point" => Point { position, intensity: power }.into(),
        "spot" => {
            let cone = light.spot.clone().unwrap_or_default();
            let angle = cone.outer_cone_angle.to_degrees().clamp(0.01, 180.0);
            Spot {
                position,
                target: position + direction,
                intensity: power,
                angle,
                inner: cone.inner_cone_angle.to_degrees().clamp(0.0, angle),
                falloff: Falloff::Square,
            }
            .into()
        }
        other => {
            remarks.add(place, format!("a light of type `{other}`"), "nothing", "its light is missing");
            return None;
        }
    };
    Some(PunctualLightDescription { name: name.to_owned(), kind, transform: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(light: &Light) -> Option<PunctualLightKind> {
        let world = DAffine3::from_rotation_translation(glam::DQuat::from_rotation_y(90f64.to_radians()), DVec3::ONE);
        punctual_light(light, "light", &world, &mut Remarks::default(), "place").map(|punctual_light| punctual_light.kind)
    }

    #[test]
    fn candela_and_lux_become_watts() {
        let light = |kind: &str| Light { intensity: 1366.0, color: [1.0, 0.5, 0.0], r#type: kind.into(), ..Light::default() };
        let Some(PunctualLightKind::Point(point)) = of(&light("point")) else { panic!("a point") };
        assert_eq!((point.position, point.intensity), (DVec3::ONE, [2.0, 1.0, 0.0]));
        let Some(PunctualLightKind::Directional(sun)) = of(&light("directional")) else { panic!("a sun") };
        assert!(sun.irradiance == [2.0, 1.0, 0.0] && (sun.direction - DVec3::NEG_X).length() < 1e-12);
        let Some(PunctualLightKind::Spot(spot)) = of(&light("spot")) else { panic!("a spot") };
        assert!((spot.angle - 45.0).abs() < 1e-9 && spot.inner == 0.0 && spot.falloff == Falloff::Square);
        assert!((spot.target - DVec3::new(0.0, 1.0, 1.0)).length() < 1e-12);
        assert_eq!((of(&light("laser")), of(&Light { intensity: 0.0, ..light("point") })), (None, None));
    }
}
