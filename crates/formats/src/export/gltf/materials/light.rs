//! Emission, sides and bumps.
use serde_json::{Value, json};

use super::MaterialParts;
use crate::export::{ExportError, gltf::context::Export};
use noisefall_scene::{
    light::emission::EmissionSource,
    scene::description::{EmissionDescription, MaterialDescription},
    texture::image::Image,
};

/// Whether nothing is emitted.
pub fn is_dark(emission: &EmissionDescription) -> bool {
    let is_black = matches!(&emission.source, EmissionSource::Radiance(radiance) if radiance.radiance == [0.0; 3]);
    is_black || emission.scale == 0.0
}

impl Export<'_> {
    /// Whether a surface that emits has two sides. The format has one word for emission and reflection.
    pub(super) fn sides(&mut self, material: &MaterialDescription, emission: &EmissionDescription, is_hidden: bool) -> bool {
        let reflects = material.two_sided != Some(false);
        match (emission.two_sided, reflects) {
            (false, true) if !is_hidden => {
                self.remark("a light whose back reflects", "`doubleSided` false", "its back is black");
            }
            (true, false) => self.remark("a light whose back does not reflect", "`doubleSided` true", "its back reflects too"),
            _ => {}
        }
        emission.two_sided
    }

    /// Radiance as factor × texture × strength.
    pub(super) fn emission(&mut self, parts: &mut MaterialParts, emission: &EmissionDescription) -> Result<(), ExportError> {
        let radiance = self.colors.radiance(&emission.source, &mut self.notes);
        let mut part = [self.color(&radiance)];
        MaterialParts::set(&mut parts.material, "emissiveTexture", self.map(&mut part)?);
        let [part] = part;
        let strongest = part.factor.iter().fold(1.0, |a: f64, b| a.max(*b));
        parts.material.insert("emissiveFactor".to_owned(), json!(part.factor.map(|x| x / strongest)));
        let strength = emission.scale * strongest;
        if strength != 1.0 {
            let content = json!({ "emissiveStrength": strength });
            self.document.extend(&mut parts.material, "KHR_materials_emissive_strength", content);
        }
        Ok(())
    }

    /// The use of the normal map, if there is one.
    pub(super) fn bumps(
        &mut self,
        parts: &mut MaterialParts,
        material: &MaterialDescription,
    ) -> Result<Option<Value>, ExportError> {
        if let Some(bump) = &material.bump {
            self.remark(format!("the heights `{}`", bump.texture), "no bump map", "the surface is smooth");
        }
        let Some(path) = &material.normal_map else { return Ok(None) };
        if material.normal_shadowing == Some(true) {
            self.remark("`normal_shadowing`", "no shadowing", "light that grazes the relief is brighter");
        }
        if material.two_sided_relief == Some(true) {
            self.remark("`two_sided_relief`", "the normal map as it is", "bumps of the front are dents of the back");
        }
        if material.mirrored_normals == Some(true) {
            self.remark("`mirrored_normals`", "the normal map as it is", "steep relief may be darker");
        }
        let stem = path.rsplit(['/', '\\']).next().and_then(|file| file.split('.').next()).unwrap_or_default();
        let file = match self.is_web_image(path)? {
            true => self.new.name(path),
            false => self.linear_copy(path, stem)?,
        };
        self.uses_coordinates = true;
        let info = self.texture(file, stem, &Image::default());
        parts.material.insert("normalTexture".to_owned(), info.clone());
        Ok(Some(info))
    }
}
