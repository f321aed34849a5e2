//! Light from all directions.
use std::{f64::consts::PI, path::Path};

use glam::{DAffine3, DMat3, DVec3};

use super::{image_name, octahedron, times};
use crate::import::{
    pbrt::{import::Import, parameters::Entity, spectra::luminance},
    pictures,
};
use noisefall_base::memory::reserve;
use noisefall_scene::{
    image::{Encoding, Texels, read_light},
    light::environment::{EnvironmentDescription, constant::Constant, image::Image},
    scene::SceneError,
    shape::Transform,
};

/// From our directions to those of pbrt-v3, whose images are equirectangular with +z at the top.
const FROM_EQUIRECTANGULAR: DMat3 = DMat3::from_cols_array(&[0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
/// Widest sky that is computed.
const WIDEST: u32 = 8192;

impl Import {
    pub(super) fn infinite(&mut self, entity: &Entity, map: &DAffine3) -> Result<(), SceneError> {
        self.remark_parameter(entity, "portal", "no portal", "the image is the same if the portals are the only openings");
        let illuminance = entity.float("illuminance", -1.0)?;
        match self.file(entity, image_name(entity))? {
            Some(path) => self.image_of_all_directions(entity, map, &path, illuminance),
            None => {
                let factor = if illuminance > 0.0 { illuminance / PI } else { 1.0 };
                let radiance = times(self.light_colour(entity, "L")?, factor);
                if radiance == [0.0; 3] {
                    self.remark_black(entity);
                } else {
                    self.add_constant(entity, radiance);
                }
                Ok(())
            }
        }
    }

    /// Adds the same radiance from everywhere to what is there.
    fn add_constant(&mut self, entity: &Entity, radiance: [f64; 3]) {
        match &mut self.description.environment {
            None => self.description.environment = Some(Constant { radiance }.into()),
            Some(EnvironmentDescription::Constant(known)) => {
                known.radiance = [0, 1, 2].map(|channel| known.radiance[channel] + radiance[channel]);
            }
            Some(_) => self.remark(entity, "nothing", "there is one image of the sky, and this light is missing"),
        }
    }

    fn image_of_all_directions(
        &mut self,
        entity: &Entity,
        map: &DAffine3,
        path: &Path,
        illuminance: f64,
    ) -> Result<(), SceneError> {
        entity.ignore(&["L"]);
        let wrong = |message: String| entity.error(message, "this image cannot be used");
        let picture = read_light(path, Encoding::Srgb).map_err(|error| wrong(error.to_string()))?;
        let pixels = u64::from(picture.width) * u64::from(picture.height);
        let _room = reserve("pixels of a sky", 16 * pixels).map_err(|error| wrong(error.to_string()))?;
        let mut scale = self.image_scale(entity, "L")?;
        if scale == 0.0 || picture.is_black() {
            self.remark_black(entity);
            return Ok(());
        }
        let is_square = picture.width == picture.height;
        if illuminance > 0.0 && is_square {
            scale *= illuminance / illuminance_of(&picture);
        }
        let frame = rotation(map);
        if frame.is_none() {
            self.remark(entity, "its image without transform", "the sky is not sheared or scaled");
        }
        let frame = frame.unwrap_or(DMat3::IDENTITY);
        let (image, frame) = if is_square {
            let (width, sky) = octahedron::equirectangular(&picture, (2 * picture.width).clamp(8, WIDEST));
            drop(picture);
            let bytes = pictures::exr(width, width / 2, &sky).ok_or_else(|| wrong("the sky cannot be encoded".to_owned()))?;
            self.remark(entity, "the image resampled to an equirectangular one", "its texels are averaged a little");
            (self.new_files.add_image("sky", "exr", bytes), frame)
        } else {
            if picture.width != 2 * picture.height {
                self.remark(entity, "an equirectangular image", "the image is neither square nor twice as wide as high");
            }
            (self.files.folder.described(path), frame * FROM_EQUIRECTANGULAR)
        };
        if self.description.environment.is_some() {
            self.remark(entity, "this image alone", "there is one sky, and the others are missing");
        }
        let transform = Transform::list_of(&DAffine3::from_mat3(frame));
        let sky = Image { path: image, scale: scale.clamp(1e-12, 1e12), transform, ..Image::default() };
        self.description.environment = Some(sky.into());
        Ok(())
    }
}

/// The rotation or mirroring of a transform; `None` if it shears or scales unevenly.
fn rotation(map: &DAffine3) -> Option<DMat3> {
    const ROUNDING: f64 = 1e-5;
    let scale = map.matrix3.determinant().abs().cbrt();
    let unit = map.matrix3 * (1.0 / scale);
    let is_rotation = scale > 0.0 && (unit * unit.transpose()).abs_diff_eq(DMat3::IDENTITY, ROUNDING);
    is_rotation.then_some(unit)
}

/// The illuminance of the upper hemisphere, as pbrt computes it.
fn illuminance_of(picture: &Texels) -> f64 {
    let size = picture.width as usize;
    let at = |i: usize| (i as f64 + 0.5) / size as f64;
    let sum: f64 = picture
        .radiance
        .iter()
        .enumerate()
        .map(|(index, pixel)| {
            let direction: DVec3 = octahedron::direction([at(index % size), at(index / size)]);
            let [r, g, b, _] = pixel.map(f64::from);
            luminance([r, g, b]) * direction.z.max(0.0)
        })
        .sum();
    (2.0 * PI * sum / (size * size) as f64).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_equirectangular_images_is_plus_z() {
        let map = FROM_EQUIRECTANGULAR;
        assert_eq!(map * DVec3::Y, DVec3::Z);
        // The left edge of the image, which is at +z here, is at +x in pbrt-v3; the middle at −x.
        assert_eq!((map * DVec3::Z, map * DVec3::NEG_Z), (DVec3::X, DVec3::NEG_X));
        // A quarter of the image further to the right of the left edge: φ = 90°.
        assert_eq!(map * DVec3::NEG_X, DVec3::Y);
    }

    #[test]
    fn transforms_of_skies_are_rotations_and_mirrorings() {
        let turn = DAffine3::from_rotation_x(1.0) * DAffine3::from_scale(DVec3::new(-3.0, 3.0, 3.0));
        assert!(rotation(&turn).is_some_and(|frame| (frame.determinant() + 1.0).abs() < 1e-9));
        assert!(rotation(&DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0))).is_none());
    }
}
