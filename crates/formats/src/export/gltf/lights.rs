//! Lamps of KHR_lights_punctual, and light that glTF cannot express.
use glam::{DAffine3, DVec3};
use serde_json::{Map, Value, json};

use super::{
    super::{ExportError, geometry::upwards, notes},
    camera::looking,
    context::{Export, table},
    document::LAMPS,
};
use crate::import::gltf::EFFICACY;
use noisefall_scene::{
    light::lamp::{
        LampKind,
        projector::Projector,
        spot::{Falloff, Spot},
    },
    scene::description::{BackgroundDescription, LampDescription},
    shape::product,
    texture::ImageTexture,
};

/// The widest cone of the format, degrees.
const WIDEST: f64 = 90.0;
/// The format wants the inner angle of a cone to be smaller than the outer one.
const SHARPEST: f64 = 1.0 - 1e-9;

/// Adds all lamps, and remarks on the background.
pub fn all(export: &mut Export) -> Result<(), ExportError> {
    let description = export.description;
    for (number, lamp) in description.lamps.iter().enumerate() {
        export.at(notes::element("lamp", number, &lamp.name), |export| export.lamp(lamp))?;
    }
    if let Some(background) = description.background.as_ref().filter(|background| !is_black(background)) {
        export.at("background".to_owned(), |export| {
            let found = format!("a background `{}`", background.name());
            export.remark(found, "nothing", "its light is missing, and what is seen behind objects is the choice of the program");
        });
    }
    Ok(())
}

fn is_black(background: &BackgroundDescription) -> bool {
    matches!(background, BackgroundDescription::Constant(constant) if constant.radiance == [0.0; 3])
}

impl Export<'_> {
    fn lamp(&mut self, lamp: &LampDescription) -> Result<(), ExportError> {
        let map = product(&lamp.transform).unwrap_or(DAffine3::IDENTITY);
        let point = |p: DVec3| map.transform_point3(p);
        let towards = |direction: DVec3| direction.normalize_or(DVec3::NEG_Y);
        let (kind, place, power) = match &lamp.kind {
            LampKind::Point(lamp) => {
                (json!({ "type": "point" }), DAffine3::from_translation(point(lamp.position)), lamp.intensity)
            }
            LampKind::Directional(lamp) => {
                let forward = towards(map.transform_vector3(lamp.direction));
                let place = looking(DVec3::ZERO, forward, upwards(forward, None));
                (json!({ "type": "directional" }), place, lamp.irradiance)
            }
            LampKind::Spot(lamp) => {
                let (eye, target) = (point(lamp.position), point(lamp.target));
                let forward = towards(target - eye);
                (self.spot(lamp), looking(eye, forward, upwards(forward, None)), lamp.intensity)
            }
            LampKind::Projector(lamp) => {
                let (eye, target) = (point(lamp.position), point(lamp.target));
                let forward = towards(target - eye);
                let (cone, power) = self.projector(lamp)?;
                (cone, looking(eye, forward, upwards(forward, Some(map.transform_vector3(lamp.up)))), power)
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            _ => {
                let substitute = self.colors.lamp_substitute(lamp, &mut self.notes);
                return substitute.map_or(Ok(()), |substitute| self.lamp(&substitute));
            }
        };
        self.add_lamp(table(kind), &lamp.name, &place, power);
        Ok(())
    }

    /// Adds a lamp of a power in W/sr or W/m². The file states candela and lux.
    fn add_lamp(&mut self, mut lamp: Map<String, Value>, name: &str, place: &DAffine3, power: [f64; 3]) {
        let strongest = power.iter().fold(0.0, |a: f64, b| a.max(*b));
        let color = power.map(|x| if strongest > 0.0 { x / strongest } else { 1.0 });
        lamp.insert("color".to_owned(), json!(color));
        lamp.insert("intensity".to_owned(), json!(strongest * EFFICACY));
        if !name.is_empty() {
            lamp.insert("name".to_owned(), json!(name));
        }
        let index = self.document.add_lamp(Value::Object(lamp));
        let mut node = Map::new();
        self.document.extend(&mut node, LAMPS, json!({ "light": index }));
        self.node(name, place, node);
    }

    fn spot(&mut self, lamp: &Spot) -> Value {
        if lamp.falloff != Falloff::Square && lamp.inner < lamp.angle {
            let used = "the square of what is linear in the cosine";
            self.remark("the falloff of a spot", used, "its edge has another softness");
        }
        if lamp.angle > WIDEST {
            self.remark(format!("a spot of {}°", lamp.angle), "90°", "what lies behind it gets no light");
        }
        cone(lamp.inner, lamp.angle)
    }

    /// A spot with the mean of the image.
    fn projector(&mut self, lamp: &Projector) -> Result<(Value, [f64; 3]), ExportError> {
        self.remark("a projector", "a spot of its width and its mean colour", "its light is round and has no image");
        let mean = match lamp.image.is_empty() {
            true => [1.0; 3],
            false => {
                let image = ImageTexture::read(self.resources, "image", &lamp.image, lamp.encoding);
                image.map_err(|problem| self.invalid(problem))?.mean().map(f64::from)
            }
        };
        let half = lamp.fov / 2.0;
        let power = [0, 1, 2].map(|i| mean[i] * lamp.tint[i] * lamp.scale);
        Ok((cone(lamp.inner.min(lamp.angle).min(half), lamp.angle.min(half)), power))
    }
}

/// A cone of angles between the axis and its edge, degrees.
fn cone(inner: f64, outer: f64) -> Value {
    let outer = outer.min(WIDEST).to_radians();
    let inner = inner.to_radians().min(outer * SHARPEST);
    json!({ "type": "spot", "spot": { "innerConeAngle": inner, "outerConeAngle": outer } })
}
