//! Colour, opacity, metal, roughness and interface.
use serde_json::json;

use super::MaterialParts;
use crate::{
    export::{
        ExportError,
        gltf::{context::Export, known::VertexColors, textures::Part},
    },
    import::gltf::STEP,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Material, principled::Principled},
    scene::description::{MaterialDescription, TextureKind},
    texture::image::Channel,
};

impl Export<'_> {
    /// Writes the base, and returns what it uses of the colours of vertices.
    pub(super) fn base(
        &mut self,
        parts: &mut MaterialParts,
        material: &MaterialDescription,
        principled: &Principled,
    ) -> Result<VertexColors, ExportError> {
        let color = self.part(base_color(principled), Channel::Rgb, Some(Channel::Rgb));
        let mut base = vec![self.weighted(color, &principled.base_weight)];
        let mut colors = if base[0].has_vertices { VertexColors::Rgb } else { VertexColors::None };
        let opacity = match material.kind {
            Material::Null(_) => Some(&Textured::Constant(0.0)),
            _ => material.opacity.as_ref().filter(|opacity| **opacity != Textured::Constant(1.0)),
        };
        if let Some(opacity) = opacity {
            let (opacity, cutoff) = self.cutoff(opacity);
            let vertices = base[0].has_vertices.then_some(Channel::Alpha);
            let opacity = self.part(&opacity.map(|opacity| [opacity; 3]), Channel::Alpha, vertices);
            if opacity.has_vertices {
                colors = VertexColors::Rgba;
            }
            base.push(opacity);
            parts.material.insert("alphaMode".to_owned(), json!(if cutoff.is_some() { "MASK" } else { "BLEND" }));
            MaterialParts::set(&mut parts.material, "alphaCutoff", cutoff.map(|cutoff| json!(cutoff)));
        }
        MaterialParts::set(&mut parts.pbr, "baseColorTexture", self.map(&mut base)?);
        let [r, g, b] = base[0].factor.map(|x| x.clamp(0.0, 1.0));
        let alpha = base.get(1).map_or(1.0, Part::number).clamp(0.0, 1.0);
        parts.pbr.insert("baseColorFactor".to_owned(), json!([r, g, b, alpha]));
        self.metal(parts, principled)?;
        self.interface(parts, principled)?;
        Ok(colors)
    }

    /// A colour times the weight of the base.
    fn weighted(&mut self, mut color: Part, weight: &Textured<f64>) -> Part {
        if let Textured::Texture(name) = weight {
            self.remark(format!("the texture `{name}` of `base_weight`"), "its mean", "the base is equally bright everywhere");
        }
        let weight = self.colors.mean_number(weight);
        color.factor = color.factor.map(|x| x * weight);
        color
    }

    /// Undoes the ramp that the reader makes of `MASK`: its input, and the place of its step.
    fn cutoff(&self, opacity: &Textured<f64>) -> (Textured<f64>, Option<f64>) {
        if let Textured::Texture(name) = opacity
            && let Some(TextureKind::Ramp(ramp)) = self.colors.kind(name)
            && let [low, high] = &ramp.stops[..]
            && (low.color, high.color) == ([0.0; 3], [1.0; 3])
            && high.at - low.at <= 1.001 * STEP
        {
            return (ramp.input.clone(), Some(high.at));
        }
        (opacity.clone(), None)
    }

    fn metal(&mut self, parts: &mut MaterialParts, principled: &Principled) -> Result<(), ExportError> {
        let roughness = self.across(principled);
        let mut both = [self.number(&roughness, Channel::Green), self.number(&principled.base_metalness, Channel::Blue)];
        MaterialParts::set(&mut parts.pbr, "metallicRoughnessTexture", self.map(&mut both)?);
        parts.pbr.insert("roughnessFactor".to_owned(), json!(both[0].number()));
        parts.pbr.insert("metallicFactor".to_owned(), json!(both[1].number()));
        Ok(())
    }

    fn interface(&mut self, parts: &mut MaterialParts, principled: &Principled) -> Result<(), ExportError> {
        if principled.specular_ior != 1.5 {
            let content = json!({ "ior": principled.specular_ior });
            self.document.extend(&mut parts.material, "KHR_materials_ior", content);
        }
        let (weight, color) = (&principled.specular_weight, &principled.specular_color);
        if (weight, color) == (&Textured::Constant(1.0), &Textured::grey(1.0)) {
            return Ok(());
        }
        if principled.base_metalness != Textured::Constant(0.0) {
            let found = "`specular_weight` and `specular_color` of metal";
            self.remark(found, "those of the rest of the surface", "metal reflects more");
        }
        let mut weight = [self.number(weight, Channel::Alpha)];
        let mut color = [self.color(color)];
        let mut content = serde_json::Map::new();
        MaterialParts::set(&mut content, "specularTexture", self.map(&mut weight)?);
        MaterialParts::set(&mut content, "specularColorTexture", self.map(&mut color)?);
        content.insert("specularFactor".to_owned(), json!(weight[0].number()));
        content.insert("specularColorFactor".to_owned(), json!(color[0].factor));
        self.document.extend(&mut parts.material, "KHR_materials_specular", content.into());
        Ok(())
    }
}

/// The format tints what passes by the base colour, unless a volume does.
fn base_color(principled: &Principled) -> &Textured {
    const WHITE: &Textured = &Textured::grey(1.0);
    let is_clear =
        principled.transmission_weight == Textured::Constant(1.0) && principled.base_metalness == Textured::Constant(0.0);
    let is_tinted = principled.transmission_depth == 0.0 || principled.thin_walled;
    match (is_clear, is_tinted) {
        (true, true) => &principled.transmission_color,
        (true, false) => WHITE,
        (false, _) => &principled.base_color,
    }
}
