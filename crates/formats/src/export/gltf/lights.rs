//! Lights of KHR_lights_punctual, and light that glTF cannot express.
use glam::{DAffine3, DVec3};
use serde_json::{Map, Value, json};

use super::{
    super::{ExportError, geometry::upwards, notes},
    camera::looking,
    context::{Export, table},
    document::LIGHTS,
};
use crate::import::gltf::EFFICACY;
use noisefall_scene::{
    light::punctual_light::{
        PunctualLightKind,
        projector::Projector,
        spot::{Falloff, Spot},
    },
    scene::description::{EnvironmentDescription, PunctualLightDescription},
    shape::product,
    texture::ImageTexture,
};

/// The widest cone of the format, degrees.
const WIDEST: f64 = 90.0;
/// The format wants the inner angle of a cone to be smaller than the outer one.
const SHARPEST: f64 = 1.0 - 1e-9;

/// Adds all lights, and remarks on the environment.
pub fn all(export: &mut Export) -> Result<(), ExportError> {
    let description = export.description;
    for (number, punctual_light) in description.punctual_lights.iter().enumerate() {
        export.at(notes::element("light", number, &punctual_light.name), |export| export.punctual_light(punctual_light))?;
    }
    if let Some(environment) = description.environment.as_ref().filter(|environment| !is_black(environment)) {
        export.at("environment".to_owned(), |export| {
            let found = format!("an environment `{}`", environment.name());
            export.remark(found, "nothing", "its light is missing, and what is seen behind objects is the choice of the program");
        });
    }
    Ok(())
}

fn is_black(environment: &EnvironmentDescription) -> bool {
    matches!(environment, EnvironmentDescription::Constant(constant) if constant.radiance == [0.0; 3])
}

impl Export<'_> {
    fn punctual_light(&mut self, punctual_light: &PunctualLightDescription) -> Result<(), ExportError> {
        let map = product(&punctual_light.transform).unwrap_or(DAffine3::IDENTITY);
        let point = |p: DVec3| map.transform_point3(p);
        let towards = |direction: DVec3| direction.normalize_or(DVec3::NEG_Y);
        let (kind, place, power) = match &punctual_light.kind {
            PunctualLightKind::Point(punctual_light) => {
                (json!({ "type": "point" }), DAffine3::from_translation(point(punctual_light.position)), punctual_light.intensity)
            }
            PunctualLightKind::Directional(punctual_light) => {
                let forward = towards(map.transform_vector3(punctual_light.direction));
                let place = looking(DVec3::ZERO, forward, upwards(forward, None));
                (json!({ "type": "directional" }), place, punctual_light.irradiance)
            }
            PunctualLightKind::Spot(punctual_light) => {
                let (eye, target) = (point(punctual_light.position), point(punctual_light.target));
                let forward = towards(target - eye);
                (self.spot(punctual_light), looking(eye, forward, upwards(forward, None)), punctual_light.intensity)
            }
            PunctualLightKind::Projector(punctual_light) => {
                let (eye, target) = (point(punctual_light.position), point(punctual_light.target));
                let forward = towards(target - eye);
                let (cone, power) = self.projector(punctual_light)?;
                (cone, looking(eye, forward, upwards(forward, Some(map.transform_vector3(punctual_light.up)))), power)
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            _ => {
                let substitute = self.colors.punctual_substitute(punctual_light, &mut self.notes);
                return substitute.map_or(Ok(()), |substitute| self.punctual_light(&substitute));
            }
        };
        self.add_light(table(kind), &punctual_light.name, &place, power);
        Ok(())
    }

    /// Adds a light of a power in W/sr or W/m². The file states candela and lux.
    fn add_light(&mut self, mut punctual_light: Map<String, Value>, name: &str, place: &DAffine3, power: [f64; 3]) {
        let strongest = power.iter().fold(0.0, |a: f64, b| a.max(*b));
        let color = power.map(|x| if strongest > 0.0 { x / strongest } else { 1.0 });
        punctual_light.insert("color".to_owned(), json!(color));
        punctual_light.insert("intensity".to_owned(), json!(strongest * EFFICACY));
        if !name.is_empty() {
            punctual_light.insert("name".to_owned(), json!(name));
        }
        let index = self.document.add_light(Value::Object(punctual_light));
        let mut node = Map::new();
        self.document.extend(&mut node, LIGHTS, json!({ "light": index }));
        self.node(name, place, node);
    }

    fn spot(&mut self, punctual_light: &Spot) -> Value {
        if punctual_light.falloff != Falloff::Square && punctual_light.inner < punctual_light.angle {
            let used = "the square of what is linear in the cosine";
            self.remark("the falloff of a spot", used, "its edge has another softness");
        }
        if punctual_light.angle > WIDEST {
            self.remark(format!("a spot of {}°", punctual_light.angle), "90°", "what lies behind it gets no light");
        }
        cone(punctual_light.inner, punctual_light.angle)
    }

    /// A spot with the mean of the image.
    fn projector(&mut self, punctual_light: &Projector) -> Result<(Value, [f64; 3]), ExportError> {
        self.remark("a projector", "a spot of its width and its mean colour", "its light is round and has no image");
        let mean = match punctual_light.image.is_empty() {
            true => [1.0; 3],
            false => {
                let image = ImageTexture::read(self.resources, "image", &punctual_light.image, punctual_light.encoding);
                image.map_err(|problem| self.invalid(problem))?.mean().map(f64::from)
            }
        };
        let half = punctual_light.fov / 2.0;
        let power = [0, 1, 2].map(|i| mean[i] * punctual_light.tint[i] * punctual_light.scale);
        Ok((cone(punctual_light.inner.min(punctual_light.angle).min(half), punctual_light.angle.min(half)), power))
    }
}

/// A cone of angles between the axis and its edge, degrees.
fn cone(inner: f64, outer: f64) -> Value {
    let outer = outer.min(WIDEST).to_radians();
    let inner = inner.to_radians().min(outer * SHARPEST);
    json!({ "type": "spot", "spot": { "innerConeAngle": inner, "outerConeAngle": outer } })
}
