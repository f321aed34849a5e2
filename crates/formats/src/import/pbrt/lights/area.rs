//! Light of surfaces.
use std::f64::consts::PI;

use glam::{DAffine3, DVec3, Vec3};

use super::{power, times};
use crate::import::pbrt::{
    import::Import,
    parameters::Entity,
    shapes::{Areas, Built},
};
use noisefall_scene::{
    image::{Encoding, PictureError, read_light},
    light::emission::{radiance::Radiance, texture::Texture},
    scene::{SceneError, description::EmissionDescription},
    texture::image::{Image, TexelFilter, Wrap},
};

/// Parts whose areas differ by less are equal.
const EQUAL: f64 = 1e-3;

impl Import {
    /// The emission of a shape.
    pub fn emission(&mut self, light: &Entity, built: &Built, map: &DAffine3) -> Result<Option<EmissionDescription>, SceneError> {
        // The name in pbrt-v3.
        if light.kind == "area" {
            self.remark_old(&light.place, &light.shown());
        } else if light.kind != "diffuse" {
            return Err(light.error(format!("`{}` is not an area light of pbrt-v4", light.kind), "it must be diffuse"));
        }
        let colour = self.light_colour(light, "L")?;
        let two_sided = light.flag("twosided", false)?;
        let sides = if two_sided { 2.0 } else { 1.0 };
        let factor = match self.area(light, built, map)? {
            Some(area) => power(light, PI * area * sides)?,
            None => 1.0,
        };
        let image = self.file(light, "filename")?;
        light.ignore(&["samples", "nsamples"]);
        self.remark_unused(light);
        let Some(path) = image else {
            let radiance = times(colour, factor);
            if radiance == [0.0; 3] {
                self.remark_black(light);
                return Ok(None);
            }
            return Ok(Some(EmissionDescription { source: Radiance { radiance }.into(), two_sided, scale: 1.0 }));
        };
        self.remark_parameter(light, "power", "the radiance of the image", "the light has another power");
        let texture = Image {
            path: self.files.folder.described(&path),
            encoding: Encoding::Srgb,
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            filter: TexelFilter::Nearest,
            ..Image::default()
        };
        let name = self.add_texture("area light", texture);
        let scale = self.image_scale(light, "L")?;
        let wrong = |error: PictureError| light.error(error.to_string(), "this image cannot be used");
        if scale == 0.0 || read_light(&path, Encoding::Srgb).map_err(wrong)?.is_black() {
            self.remark_black(light);
            return Ok(None);
        }
        Ok(Some(EmissionDescription { source: Texture { name }.into(), two_sided, scale }))
    }

    /// The area that emits the power of a light, m²; `None` if it has no power. In pbrt, each triangle or patch of a mesh is a light
    /// of its own.
    fn area(&mut self, light: &Entity, built: &Built, map: &DAffine3) -> Result<Option<f64>, SceneError> {
        if light.float("power", -1.0)? <= 0.0 {
            return Ok(None);
        }
        let parts: Vec<f64> = match &built.areas {
            Areas::Whole(area) => {
                let factors = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| map.transform_vector3(axis).length());
                if factors.iter().any(|factor| (factor / factors[0] - 1.0).abs() > EQUAL) {
                    self.remark(light, "the power of a shape that is scaled evenly", "the light has another power");
                }
                vec![area * map.matrix3.determinant().abs().cbrt().powi(2)]
            }
            Areas::Faces { triangles, each } => {
                let area = |triangle: &[[f32; 3]; 3]| {
                    let [a, b, c] = triangle.map(|point| map.transform_point3(Vec3::from(point).as_dvec3()));
                    0.5 * (b - a).cross(c - a).length()
                };
                triangles.chunks(*each).map(|part| part.iter().map(area).sum()).collect()
            }
            Areas::Unknown => {
                self.remark(light, "its radiance without `power`", "the light has another power");
                return Ok(None);
            }
        };
        let mean = parts.iter().sum::<f64>() / parts.len().max(1) as f64;
        if parts.iter().any(|part| (part / mean - 1.0).abs() > EQUAL) {
            self.remark(
                light,
                "the same radiance everywhere",
                "in pbrt each triangle emits the same power, small ones are brighter",
            );
        }
        Ok(Some(mean))
    }
}
