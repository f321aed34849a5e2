//! Lamps without surface, and the background.
use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3};

use super::{
    super::{geometry::upwards, notes},
    context::Export,
    markup::{Element, FILE, words},
};
use noisefall_scene::{
    light::{
        background::{image::Image, sky::SkyModel},
        lamp::{
            LampKind,
            projector::Projector,
            spot::{Falloff, Spot},
        },
    },
    scene::description::{BackgroundDescription, LampDescription},
    shape::product,
    texture::image as texture,
};

/// Adds all lamps and the background.
pub fn all(export: &mut Export) {
    let description = export.description;
    for (number, lamp) in description.lamps.iter().enumerate() {
        let (element, _) = export.at(notes::element("lamp", number, &lamp.name), |export| export.lamp(lamp));
        let Some(element) = element else { continue };
        let id = export.id(&lamp.name, "lamp");
        export.scene.push(element.attribute("id", id));
    }
    if let Some(background) = &description.background {
        let (element, _) = export.at("background".to_owned(), |export| export.background(background));
        export.scene.push(element);
    }
}

impl Export<'_> {
    fn lamp(&mut self, lamp: &LampDescription) -> Option<Element> {
        let map = product(&lamp.transform).unwrap_or(DAffine3::IDENTITY);
        let point = |p: DVec3| map.transform_point3(p);
        Some(match &lamp.kind {
            LampKind::Point(lamp) => Element::plugin("emitter", "point")
                .point("position", point(lamp.position))
                .with(Element::color("intensity", lamp.intensity)),
            LampKind::Directional(lamp) => Element::plugin("emitter", "directional")
                .vector("direction", map.transform_vector3(lamp.direction))
                .with(Element::color("irradiance", lamp.irradiance)),
            LampKind::Spot(lamp) => self.spot(lamp, look_at(point(lamp.position), point(lamp.target), None)),
            LampKind::Projector(lamp) => {
                let up = map.transform_vector3(lamp.up);
                self.projector(lamp, look_at(point(lamp.position), point(lamp.target), Some(up)))
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            _ => {
                let substitute = self.colors.lamp_substitute(lamp, &mut self.notes)?;
                self.lamp(&substitute)?
            }
        })
    }

    fn spot(&mut self, lamp: &Spot, place: Element) -> Element {
        if lamp.falloff != Falloff::Linear && lamp.inner < lamp.angle {
            self.remark("the falloff of a spot", "one that is linear in the angle", "its edge has another softness");
        }
        Element::plugin("emitter", "spot")
            .with(place)
            .with(Element::color("intensity", lamp.intensity))
            .float("cutoff_angle", lamp.angle)
            .float("beam_width", lamp.inner.min(lamp.angle))
    }

    /// The irradiance of Mitsuba's is that at a distance of 1, divided by π.
    fn projector(&mut self, lamp: &Projector, place: Element) -> Element {
        if lamp.tint != [1.0; 3] || lamp.angle < 180.0 || lamp.aspect != 0.0 {
            self.remark(
                "the tint, the cone or the aspect of a projector",
                "none",
                "its image has other colours or another outline",
            );
        }
        if !lamp.flat {
            self.remark("a projector of even intensity", "one of even irradiance", "its light is brighter towards the edges");
        }
        let element = Element::plugin("emitter", "projector").with(place).float("scale", lamp.scale / PI).float("fov", lamp.fov);
        let element = element.text("fov_axis", "x");
        if lamp.image.is_empty() {
            return element.with(Element::color("irradiance", [1.0; 3]));
        }
        let (path, encoding, filter) = (lamp.image.clone(), lamp.encoding, lamp.filter);
        let image = texture::Image { path, encoding, filter, wrap_u: lamp.wrap, wrap_v: lamp.wrap, ..texture::Image::default() };
        element.with(self.bitmap(&image).attribute("name", "irradiance"))
    }

    fn background(&mut self, background: &BackgroundDescription) -> Element {
        match background {
            BackgroundDescription::Constant(constant) => {
                Element::plugin("emitter", "constant").with(Element::color("radiance", constant.radiance))
            }
            BackgroundDescription::Image(image) => {
                let path = self.sky_image(image);
                let element = Element::plugin("emitter", "envmap").text(FILE, &path).float("scale", image.scale);
                element.transform("to_world", &turn(image))
            }
            BackgroundDescription::Sky(sky) => {
                if sky.model == SkyModel::Preetham {
                    self.remark("a sky by Preetham", "`sunsky`", "another fit of the radiance and the colour of the sky");
                }
                let zenith = sky.zenith.normalize_or(DVec3::Y);
                let diameter = sky.sun_diameter.map(|degrees| Element::number("sun_aperture", degrees));
                Element::plugin("emitter", "sunsky")
                    .with_all(diameter)
                    .with_all((sky.model == SkyModel::Hosek).then(|| Element::color("albedo", sky.ground_albedo)))
                    .float("turbidity", sky.turbidity.clamp(1.0, 10.0))
                    .float("sky_scale", sky.sky_scale)
                    .float("sun_scale", sky.sun_scale)
                    .vector("sun_direction", sky.sun.normalize_or(DVec3::Y))
                    // Mitsuba's zenith is z.
                    .transform("to_world", &DAffine3::from_quat(DQuat::from_rotation_arc(DVec3::Z, zenith)))
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            other => {
                let mean = self.colors.background_substitute(other, &mut self.notes);
                Element::plugin("emitter", "constant").with(Element::color("radiance", mean))
            }
        }
    }
}

/// The turn of a background. Mitsuba's images have their centre at +z, and ours at −z.
fn turn(image: &Image) -> DAffine3 {
    let map = product(&image.transform).unwrap_or(DAffine3::IDENTITY);
    let degrees = image.rotate - 180.0;
    let turn = if degrees == 0.0 { DAffine3::IDENTITY } else { DAffine3::from_rotation_y(degrees.to_radians()) };
    DAffine3 { translation: DVec3::ZERO, ..map } * turn
}

/// The transform of what looks at a point along +z.
pub fn look_at(origin: DVec3, target: DVec3, up: Option<DVec3>) -> Element {
    let forward = (target - origin).normalize_or(DVec3::Z);
    let up = upwards(forward, up);
    let step = Element::new("lookat").attribute("origin", words(&origin.to_array()));
    let step = step.attribute("target", words(&target.to_array())).attribute("up", words(&up.to_array()));
    Element::new("transform").attribute("name", "to_world").with(step)
}
