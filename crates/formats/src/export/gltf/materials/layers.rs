//! Transmission, coat, sheen, thin film and anisotropy.
use serde_json::{Map, Value, json};

use super::MaterialParts;
use crate::export::{ExportError, gltf::context::Export};
use noisefall_base::declare::Textured;
use noisefall_scene::{material::principled::Principled, texture::image::Channel};

/// Nanometres of a micrometre.
const NANOMETRES: f64 = 1000.0;
/// Thickness of solids for programs that do not trace rays through them, metres.
const THICKNESS: f64 = 1.0;
/// Index of refraction of the coat of the format.
const COAT_IOR: f64 = 1.5;
const NONE: &Textured<f64> = &Textured::Constant(0.0);

impl Export<'_> {
    /// Writes the extensions of a material. The normal map holds for the coat too.
    pub(super) fn layers(
        &mut self,
        parts: &mut MaterialParts,
        of: &Principled,
        normals: Option<Value>,
    ) -> Result<(), ExportError> {
        if of.transmission_weight != *NONE {
            self.transmission(parts, of)?;
        }
        if of.coat_weight != *NONE {
            let mut coat = self.numbers([
                ("clearcoat", &of.coat_weight, Channel::Red),
                ("clearcoatRoughness", &of.coat_roughness, Channel::Green),
            ])?;
            MaterialParts::set(&mut coat, "clearcoatNormalTexture", normals);
            self.document.extend(&mut parts.material, "KHR_materials_clearcoat", coat.into());
        }
        if of.fuzz_weight != *NONE {
            self.sheen(parts, of)?;
        }
        if of.thin_film_weight != *NONE {
            self.film(parts, of)?;
        }
        if of.specular_roughness_anisotropy != *NONE {
            let anisotropy = self.mean("specular_roughness_anisotropy", &of.specular_roughness_anisotropy);
            let stretch = self.stretch(of, anisotropy);
            let content = json!({ "anisotropyStrength": stretch.sqrt(), "anisotropyRotation": of.tangent_rotation.to_radians() });
            self.document.extend(&mut parts.material, "KHR_materials_anisotropy", content);
        }
        Ok(())
    }

    /// Factors and textures of numbers, by the name without these words.
    fn numbers<const N: usize>(
        &mut self,
        members: [(&str, &Textured<f64>, Channel); N],
    ) -> Result<Map<String, Value>, ExportError> {
        let mut content = Map::new();
        for (name, number, channel) in members {
            let mut part = [self.number(number, channel)];
            MaterialParts::set(&mut content, &format!("{name}Texture"), self.map(&mut part)?);
            content.insert(format!("{name}Factor"), json!(part[0].number()));
        }
        Ok(content)
    }

    fn mean(&mut self, name: &str, number: &Textured<f64>) -> f64 {
        if let Textured::Texture(texture) = number {
            self.remark(format!("the texture `{texture}` of `{name}`"), "its mean", "the surface is the same everywhere");
        }
        self.colors.mean_number(number)
    }

    fn transmission(&mut self, parts: &mut MaterialParts, of: &Principled) -> Result<(), ExportError> {
        let content = self.numbers([("transmission", &of.transmission_weight, Channel::Red)])?;
        self.document.extend(&mut parts.material, "KHR_materials_transmission", content.into());
        let is_tinted = of.transmission_depth == 0.0 || of.thin_walled;
        let is_clear = of.transmission_weight == Textured::Constant(1.0) && of.base_metalness == *NONE;
        let tint = if is_tinted { of.transmission_color.clone() } else { Textured::grey(1.0) };
        if !is_clear && tint != of.base_color {
            let found = "a `transmission_color` of the interface besides `base_color`";
            self.remark(found, "`base_color`", "what passes has another tint");
        }
        if of.thin_walled {
            return Ok(());
        }
        let mut volume = Map::new();
        volume.insert("thicknessFactor".to_owned(), json!(THICKNESS));
        if !is_tinted {
            if let Textured::Texture(name) = &of.transmission_color {
                self.remark(format!("the texture `{name}` of the inside"), "its mean", "the inside has one colour");
            }
            volume.insert("attenuationColor".to_owned(), json!(self.colors.mean(&of.transmission_color)));
            volume.insert("attenuationDistance".to_owned(), json!(of.transmission_depth));
        }
        self.document.extend(&mut parts.material, "KHR_materials_volume", volume.into());
        Ok(())
    }

    fn sheen(&mut self, parts: &mut MaterialParts, of: &Principled) -> Result<(), ExportError> {
        let weight = self.mean("fuzz_weight", &of.fuzz_weight);
        let mut color = [self.color(&of.fuzz_color)];
        let mut content = self.numbers([("sheenRoughness", &of.fuzz_roughness, Channel::Alpha)])?;
        MaterialParts::set(&mut content, "sheenColorTexture", self.map(&mut color)?);
        content.insert("sheenColorFactor".to_owned(), json!(color[0].factor.map(|x| (x * weight).min(1.0))));
        self.document.extend(&mut parts.material, "KHR_materials_sheen", content.into());
        Ok(())
    }

    fn film(&mut self, parts: &mut MaterialParts, of: &Principled) -> Result<(), ExportError> {
        let mut content = self.numbers([("iridescence", &of.thin_film_weight, Channel::Red)])?;
        let mut thickness = [self.number(&of.thin_film_thickness, Channel::Green)];
        if let Some(map) = self.map(&mut thickness)? {
            content.insert("iridescenceThicknessTexture".to_owned(), map);
            content.insert("iridescenceThicknessMinimum".to_owned(), json!(0.0));
        }
        content.insert("iridescenceThicknessMaximum".to_owned(), json!(thickness[0].number() * NANOMETRES));
        content.insert("iridescenceIor".to_owned(), json!(of.thin_film_ior));
        self.document.extend(&mut parts.material, "KHR_materials_iridescence", content.into());
        Ok(())
    }

    /// The roughness of the format: across the tangent, where facets are the narrowest.
    pub(super) fn across(&self, of: &Principled) -> Textured<f64> {
        match (&of.specular_roughness, &of.specular_roughness_anisotropy) {
            (Textured::Constant(roughness), anisotropy) if anisotropy != NONE => {
                let anisotropy = self.colors.mean_number(anisotropy);
                Textured::Constant(widths(*roughness, anisotropy)[1].sqrt())
            }
            (roughness, _) => roughness.clone(),
        }
    }

    /// The square of the strength of anisotropy: α_t = mix(α, 1, s²) and α_b = α.
    fn stretch(&mut self, of: &Principled, anisotropy: f64) -> f64 {
        let Textured::Constant(roughness) = of.specular_roughness else {
            let found = "anisotropy with a texture of roughness";
            self.remark(found, format!("strength {:.3}", anisotropy.sqrt()), "highlights are of another length");
            return anisotropy;
        };
        let [along, across] = widths(roughness, anisotropy);
        if along > 1.0 {
            self.remark("facets wider than 1 along the tangent", "1", "highlights are shorter");
        }
        if across < 1.0 { ((along - across) / (1.0 - across)).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Says which parts of the material the format does not have, or has in another way.
    pub(super) fn list_differences(&mut self, of: &Principled) {
        let usual = Principled::default();
        let (has_coat, has_fuzz) = (of.coat_weight != *NONE, of.fuzz_weight != *NONE);
        let differs = [
            ("`base_diffuse_roughness`", of.base_diffuse_roughness != *NONE),
            ("`coat_color`", has_coat && of.coat_color != usual.coat_color),
            ("`coat_roughness_anisotropy`", has_coat && of.coat_roughness_anisotropy != *NONE),
            ("`coat_ior`", has_coat && of.coat_ior != COAT_IOR),
            ("`coat_darkening`", has_coat && of.coat_darkening != *NONE),
            ("the fuzz", has_fuzz),
        ];
        let names: Vec<&str> = differs.into_iter().filter_map(|(name, differs)| differs.then_some(name)).collect();
        if !names.is_empty() {
            let used = "the layers of the format";
            self.remark(
                names.join(", "),
                used,
                "the coat is clear, of index 1.5 and does not darken; the sheen has another shape",
            );
        }
    }
}

/// The widths α of facets along the tangent and across: α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t.
fn widths(roughness: f64, anisotropy: f64) -> [f64; 2] {
    let ratio = 1.0 - anisotropy;
    let along = roughness * roughness * (2.0 / (1.0 + ratio * ratio)).sqrt();
    [along, ratio * along]
}
