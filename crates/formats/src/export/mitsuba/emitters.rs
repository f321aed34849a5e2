//! Punctual lights, and the environment.
use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3};

use super::{
    super::{geometry::upwards, notes},
    context::Export,
    markup::{Element, FILE, words},
};
use noisefall_scene::{
    light::{
        environment::{image::Image, sky::SkyModel},
        punctual_light::{
            PunctualLightKind,
            projector::Projector,
            spot::{Falloff, Spot},
        },
    },
    scene::description::{EnvironmentDescription, PunctualLightDescription},
    shape::product,
    texture::image as texture,
};

/// Adds all lights and the environment.
pub fn all(export: &mut Export) {
    let description = export.description;
    for (number, punctual_light) in description.punctual_lights.iter().enumerate() {
        let (element, _) =
            export.at(notes::element("light", number, &punctual_light.name), |export| export.punctual_light(punctual_light));
        let Some(element) = element else { continue };
        let id = export.id(&punctual_light.name, "light");
        export.scene.push(element.attribute("id", id));
    }
    if let Some(environment) = &description.environment {
        let (element, _) = export.at("environment".to_owned(), |export| export.environment(environment));
        export.scene.push(element);
    }
}

impl Export<'_> {
    fn punctual_light(&mut self, punctual_light: &PunctualLightDescription) -> Option<Element> {
        let map = product(&punctual_light.transform).unwrap_or(DAffine3::IDENTITY);
        let point = |p: DVec3| map.transform_point3(p);
        Some(match &punctual_light.kind {
            PunctualLightKind::Point(punctual_light) => Element::plugin("emitter", "point")
                .point("position", point(punctual_light.position))
                .with(Element::color("intensity", punctual_light.intensity)),
            PunctualLightKind::Directional(punctual_light) => Element::plugin("emitter", "directional")
                .vector("direction", map.transform_vector3(punctual_light.direction))
                .with(Element::color("irradiance", punctual_light.irradiance)),
            PunctualLightKind::Spot(punctual_light) => {
                self.spot(punctual_light, look_at(point(punctual_light.position), point(punctual_light.target), None))
            }
            PunctualLightKind::Projector(punctual_light) => {
                let up = map.transform_vector3(punctual_light.up);
                self.projector(punctual_light, look_at(point(punctual_light.position), point(punctual_light.target), Some(up)))
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            _ => {
                let substitute = self.colors.punctual_substitute(punctual_light, &mut self.notes)?;
                self.punctual_light(&substitute)?
            }
        })
    }

    fn spot(&mut self, punctual_light: &Spot, place: Element) -> Element {
        if punctual_light.falloff != Falloff::Linear && punctual_light.inner < punctual_light.angle {
            self.remark("the falloff of a spot", "one that is linear in the angle", "its edge has another softness");
        }
        Element::plugin("emitter", "spot")
            .with(place)
            .with(Element::color("intensity", punctual_light.intensity))
            .float("cutoff_angle", punctual_light.angle)
            .float("beam_width", punctual_light.inner.min(punctual_light.angle))
    }

    /// The irradiance of Mitsuba's is that at a distance of 1, divided by π.
    fn projector(&mut self, punctual_light: &Projector, place: Element) -> Element {
        if punctual_light.tint != [1.0; 3] || punctual_light.angle < 180.0 || punctual_light.aspect != 0.0 {
            self.remark(
                "the tint, the cone or the aspect of a projector",
                "none",
                "its image has other colours or another outline",
            );
        }
        if !punctual_light.flat {
            self.remark("a projector of even intensity", "one of even irradiance", "its light is brighter towards the edges");
        }
        let element = Element::plugin("emitter", "projector")
            .with(place)
            .float("scale", punctual_light.scale / PI)
            .float("fov", punctual_light.fov);
        let element = element.text("fov_axis", "x");
        if punctual_light.image.is_empty() {
            return element.with(Element::color("irradiance", [1.0; 3]));
        }
        let (path, encoding, filter) = (punctual_light.image.clone(), punctual_light.encoding, punctual_light.filter);
        let image = texture::Image {
            path,
            encoding,
            filter,
            wrap_u: punctual_light.wrap,
            wrap_v: punctual_light.wrap,
            ..texture::Image::default()
        };
        element.with(self.bitmap(&image).attribute("name", "irradiance"))
    }

    fn environment(&mut self, environment: &EnvironmentDescription) -> Element {
        match environment {
            EnvironmentDescription::Constant(constant) => {
                Element::plugin("emitter", "constant").with(Element::color("radiance", constant.radiance))
            }
            EnvironmentDescription::Image(image) => {
                let path = self.sky_image(image);
                let element = Element::plugin("emitter", "envmap").text(FILE, &path).float("scale", image.scale);
                element.transform("to_world", &turn(image))
            }
            EnvironmentDescription::Sky(sky) => {
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
                let mean = self.colors.environment_substitute(other, &mut self.notes);
                Element::plugin("emitter", "constant").with(Element::color("radiance", mean))
            }
        }
    }
}

/// The turn of an environment. Mitsuba's images have their centre at +z, and ours at −z.
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
