//! Punctual lights.
use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec3};

use super::{image_name, power, times};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_scene::{
    image::{Encoding, read_light},
    light::punctual_light::{
        PunctualLightKind,
        directional::Directional,
        point::Point,
        projector::Projector,
        spot::{Falloff, Spot},
    },
    scene::{SceneError, description::PunctualLightDescription},
    shape::Transform,
};

impl Import {
    pub(super) fn point_light(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        let intensity = times(self.light_colour(entity, "I")?, power(entity, 2.0 * TAU)?);
        if intensity == [0.0; 3] {
            self.remark_black(entity);
            return Ok(());
        }
        let position = map.transform_point3(entity.triple("from", DVec3::ZERO)?);
        self.add_light(entity, Point { position, intensity }, Vec::new());
        Ok(())
    }

    pub(super) fn spot_light(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        let [from, to] = ends(entity, map)?;
        let angle = entity.float("coneangle", 30.0)?;
        let inner = angle - entity.float("conedeltaangle", 5.0)?;
        let [end, start] = [angle, inner].map(|angle| angle.to_radians().cos());
        let emitted = TAU * ((1.0 - start) + (start - end) / 2.0);
        let intensity = times(self.light_colour(entity, "I")?, power(entity, emitted)?);
        if intensity == [0.0; 3] {
            self.remark_black(entity);
            return Ok(());
        }
        let angle = angle.clamp(0.01, 180.0);
        let spot =
            Spot { position: from, target: to, intensity, angle, inner: inner.clamp(0.0, angle), falloff: Falloff::Smooth };
        self.add_light(entity, spot, Vec::new());
        Ok(())
    }

    pub(super) fn distant_light(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        let [from, to] = ends(entity, map)?;
        let illuminance = entity.float("illuminance", -1.0)?;
        let factor = if illuminance > 0.0 { illuminance } else { 1.0 };
        let irradiance = times(self.light_colour(entity, "L")?, factor);
        if irradiance == [0.0; 3] {
            self.remark_black(entity);
            return Ok(());
        }
        self.add_light(entity, Directional { direction: to - from, irradiance }, Vec::new());
        Ok(())
    }

    pub(super) fn goniometric_light(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        let path = self.required_file(entity, image_name(entity))?;
        let image =
            read_light(&path, Encoding::Srgb).map_err(|error| entity.error(error.to_string(), "this image cannot be used"))?;
        // Equal areas of the image are equal solid angles.
        let grey = |pixel: &[f32; 4]| f64::from(pixel[0] + pixel[1] + pixel[2]) / 3.0;
        let mean = image.radiance.iter().map(grey).sum::<f64>() / image.radiance.len() as f64;
        let intensity = times(self.light_colour(entity, "I")?, mean * power(entity, 4.0 * PI * mean)?);
        if intensity == [0.0; 3] {
            self.remark_black(entity);
            return Ok(());
        }
        self.remark(entity, "a point light of the same power", "it shines equally in all directions");
        self.add_light(entity, Point { position: map.translation, intensity }, Vec::new());
        Ok(())
    }

    /// An image that is cast along +z. Its angle is that across its shorter side.
    pub(super) fn projection_light(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        let path = self.required_file(entity, image_name(entity))?;
        let image =
            read_light(&path, Encoding::Srgb).map_err(|error| entity.error(error.to_string(), "this image cannot be used"))?;
        let aspect = f64::from(image.width) / f64::from(image.height);
        let slope = (0.5 * entity.float("fov", 90.0)?.clamp(0.1, 179.0)).to_radians().tan();
        let fov = 2.0 * (slope * aspect.max(1.0)).atan().to_degrees();
        self.remark_parameter(
            entity,
            "power",
            "a radiant intensity of 1 where the image is white",
            "the light has another power",
        );
        let scale = self.image_scale(entity, "I")?;
        if scale == 0.0 || image.is_black() {
            self.remark_black(entity);
            return Ok(());
        }
        let projector = Projector {
            position: DVec3::ZERO,
            target: DVec3::Z,
            up: DVec3::Y,
            image: self.files.folder.described(&path),
            encoding: Encoding::Srgb,
            fov: fov.clamp(0.01, 179.0),
            scale,
            ..Projector::default()
        };
        // The right of the image is at +x, as left-handed cameras have it.
        let mirrored = *map * DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        self.add_light(entity, projector, Transform::list_of(&mirrored));
        Ok(())
    }

    fn add_light(&mut self, entity: &Entity, kind: impl Into<PunctualLightKind>, transform: Vec<Transform>) {
        self.description.punctual_lights.push(PunctualLightDescription {
            name: entity.kind.clone(),
            kind: kind.into(),
            transform,
        });
    }
}

/// `from` and `to` in the world of the description.
fn ends(entity: &Entity, map: &DAffine3) -> Result<[DVec3; 2], SceneError> {
    let [from, to] = [entity.triple("from", DVec3::ZERO)?, entity.triple("to", DVec3::Z)?].map(|p| map.transform_point3(p));
    if from == to {
        return Err(entity.error("the light has no direction", "`from` and `to` must differ"));
    }
    Ok([from, to])
}
