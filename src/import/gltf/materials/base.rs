//! The base of a material: colour, metal, roughness and interface.
use super::MaterialImport;
use crate::{
    declare::Textured,
    import::gltf::{
        document::MetallicRoughness,
        extensions::{Specular, SpecularGlossiness},
    },
    material::principled::Principled,
    texture::image::Channel,
};

/// Range of indices of refraction.
const LEAST_IOR: f64 = 1.0;
const GREATEST_IOR: f64 = 20.0;

impl MaterialImport<'_, '_> {
    /// The whole of what reflects and transmits.
    pub(super) fn principled(&mut self) -> Principled {
        let mut principled = match self.extensions.specular_glossiness.as_deref() {
            Some(described) => self.specular_glossiness(described),
            None => self.metallic_roughness(),
        };
        self.transmission(&mut principled);
        self.coat(&mut principled);
        self.sheen(&mut principled);
        self.iridescence(&mut principled);
        self.anisotropy(&mut principled);
        principled
    }

    pub(super) fn described(&self) -> MetallicRoughness {
        self.material.pbr_metallic_roughness.as_deref().cloned().unwrap_or_default()
    }

    fn metallic_roughness(&mut self) -> Principled {
        let described = self.described();
        let map = described.metallic_roughness_texture.as_ref();
        let base_color = self.base_colour();
        let mut principled = Principled {
            base_color,
            base_metalness: self.number(described.metallic_factor, map, Channel::Blue),
            // Both are the square root of the width of the microfacet distribution.
            specular_roughness: self.number(described.roughness_factor, map, Channel::Green),
            specular_ior: self.ior(),
            ..Principled::default()
        };
        if let Some(specular) = self.extensions.specular.as_deref() {
            self.specular(specular, &mut principled);
        }
        principled
    }

    /// The colour without its opacity, times that of the vertices.
    pub(super) fn base_colour(&mut self) -> Textured {
        let described = self.described();
        let [r, g, b, _] = described.base_color_factor;
        let colour = self.colour([r, g, b].map(|x| x.clamp(0.0, 1.0)), described.base_color_texture.as_ref());
        self.with_vertices(colour)
    }

    fn ior(&mut self) -> f64 {
        let ior = self.extensions.ior.as_ref().map_or(1.5, |described| described.ior);
        match ior {
            // By the extension, 0 stands for an interface that reflects everything.
            0.0 => {
                self.remark("`ior` 0", format!("an index of refraction of {GREATEST_IOR}"), "the surface reflects 82 % head-on");
                GREATEST_IOR
            }
            _ => ior.clamp(LEAST_IOR, GREATEST_IOR),
        }
    }

    /// Strength and colour of the reflection off the interface. Metals of glTF do not know them, those of OpenPBR do.
    fn specular(&mut self, described: &Specular, principled: &mut Principled) {
        let strongest = described.specular_color_factor.iter().fold(0.0, |a: f64, b| a.max(*b));
        if strongest > 1.0 {
            self.remark("`specularColorFactor` above 1", "1", "reflections head-on are weaker");
        }
        let colour = described.specular_color_factor.map(|x| x.clamp(0.0, 1.0));
        let weight = self.number(described.specular_factor, described.specular_texture.as_ref(), Channel::Alpha);
        let color = self.colour(colour, described.specular_color_texture.as_ref());
        if weight == Textured::Constant(1.0) && color == Textured::grey(1.0) {
            return;
        }
        match &principled.base_metalness {
            Textured::Constant(1.0) => return,
            Textured::Constant(0.0) => {}
            _ => {
                let used = "`specular_weight` and `specular_color` of the whole surface";
                self.remark("KHR_materials_specular on a partly metallic surface", used, "metal reflects less");
            }
        }
        (principled.specular_weight, principled.specular_color) = (weight, color);
    }

    /// The older model: diffuse and specular colour with glossiness. The specular colour is that head-on.
    fn specular_glossiness(&mut self, described: &SpecularGlossiness) -> Principled {
        let [r, g, b, _] = described.diffuse_factor;
        let diffuse = self.colour([r, g, b].map(|x| x.clamp(0.0, 1.0)), described.diffuse_texture.as_ref());
        let base_color = self.with_vertices(diffuse);
        let specular = described.specular_factor.map(|x| x.clamp(0.0, 1.0));
        let strongest = specular.iter().fold(0.0, |a: f64, b| a.max(*b));
        // F₀ = ((η − 1)/(η + 1))²
        let root = strongest.sqrt();
        let ior = if root < 1.0 { ((1.0 + root) / (1.0 - root)).clamp(LEAST_IOR, GREATEST_IOR) } else { GREATEST_IOR };
        let map = described.specular_glossiness_texture.as_ref();
        let tint = specular.map(|x| if strongest > 0.0 { x / strongest } else { 1.0 });
        let specular_color = self.colour(tint, map);
        let glossiness = described.glossiness_factor.clamp(0.0, 1.0);
        let gloss = self.number(1.0, map, Channel::Alpha);
        let specular_roughness = match gloss {
            Textured::Constant(_) => Textured::Constant(1.0 - glossiness),
            gloss => self.textures.ramp(self.to, gloss, [0.0, 1.0], [1.0, 1.0 - glossiness]),
        };
        self.remark(
            "KHR_materials_pbrSpecularGlossiness",
            format!("a dielectric of index {ior:.3} with a tinted reflection"),
            "reflections at grazing angles differ; none exceeds 82 % head-on",
        );
        Principled { base_color, specular_color, specular_roughness, specular_ior: ior, ..Principled::default() }
    }
}
