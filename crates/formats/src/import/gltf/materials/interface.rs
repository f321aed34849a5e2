//! The interface of the base: its index of refraction, or its reflectance head-on, F₀.
use super::MaterialImport;
use crate::import::gltf::{
    document::TextureInfo,
    extensions::{Specular, SpecularGlossiness},
    reflectances::Reflectances,
    textures::Use,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{material::principled::Principled, texture::image::Channel};

/// Range of indices of refraction.
const LEAST_IOR: f64 = 1.0;
const GREATEST_IOR: f64 = 20.0;
/// From this reflectance on, metal is nearer than a dielectric of the greatest index, which reflects 82 %.
const METALLIC: f64 = 0.91;

/// F₀ = ((η − 1)/(η + 1))²
fn reflectance(ior: f64) -> f64 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

fn index(reflectance: f64) -> f64 {
    let root = reflectance.sqrt();
    if root < 1.0 { ((1.0 + root) / (1.0 - root)).clamp(LEAST_IOR, GREATEST_IOR) } else { GREATEST_IOR }
}

impl MaterialImport<'_, '_> {
    /// Index, strength and colour of the reflection off the interface.
    pub(super) fn interface(&mut self, principled: &mut Principled) {
        let usual = Specular::default();
        let specular = self.extensions.specular.as_deref().unwrap_or(&usual);
        let ior = self.extensions.ior.as_ref().map_or(1.5, |described| described.ior);
        if ior == 0.0 {
            // By the extension, 0 stands for an interface that reflects everything: the colour is F₀ itself.
            let factor = specular.specular_color_factor.map(|x| x.clamp(0.0, 1.0));
            self.head_on(principled, factor, specular.specular_color_texture.as_ref());
            let weight =
                self.number("specularFactor", specular.specular_factor, specular.specular_texture.as_ref(), Channel::Alpha);
            if weight != Textured::Constant(1.0) {
                principled.specular_weight = self.product(principled.specular_weight.clone(), weight);
            }
            return;
        }
        principled.specular_ior = self.within("ior", ior, [LEAST_IOR, GREATEST_IOR]);
        if self.extensions.specular.is_some() {
            self.specular(specular, principled);
        }
    }

    /// Strength and colour of the reflection off the interface. Metals of glTF do not know them, those of OpenPBR do.
    fn specular(&mut self, described: &Specular, principled: &mut Principled) {
        let strongest = described.specular_color_factor.iter().fold(1.0, |a: f64, b| a.max(*b));
        if strongest > 1.0 {
            principled.specular_ior = index((reflectance(principled.specular_ior) * strongest).min(1.0));
            let used = format!("an index of refraction of {:.3}", principled.specular_ior);
            self.remark("`specularColorFactor` above 1", used, "what passes is refracted more");
        }
        let colour = described.specular_color_factor.map(|x| (x / strongest).clamp(0.0, 1.0));
        let weight =
            self.number("specularFactor", described.specular_factor, described.specular_texture.as_ref(), Channel::Alpha);
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

    /// An interface by its reflectance head-on: the index is that of the greatest one, the weight takes the others down to theirs, and the
    /// rest is a tint.
    fn head_on(&mut self, principled: &mut Principled, factor: [f64; 3], map: Option<&TextureInfo>) {
        let of = Use { map, surface: self.surface, place: self.place };
        let Reflectances { greatest, weight, tint } = self.textures.reflectances(self.to, factor, &of);
        if greatest >= METALLIC && principled.base_metalness == Textured::Constant(0.0) {
            let is_even = weight == Textured::Constant(1.0);
            if is_even && let Textured::Constant(tint) = &tint {
                principled.base_metalness = Textured::Constant(1.0);
                principled.base_color = Textured::Constant(tint.map(|x| x * greatest));
                return;
            }
        }
        principled.specular_ior = index(greatest);
        if greatest > reflectance(GREATEST_IOR) {
            let found = format!("a reflectance of {greatest:.2} head-on");
            self.remark(found, format!("an index of refraction of {GREATEST_IOR}"), "the surface reflects up to 82 % head-on");
        }
        (principled.specular_weight, principled.specular_color) = (weight, tint);
    }

    /// The older model: diffuse and specular colour with glossiness. The specular colour is F₀.
    pub(super) fn specular_glossiness(&mut self, described: &SpecularGlossiness) -> Principled {
        let [r, g, b, _] = described.diffuse_factor;
        let diffuse = self.unit_colour("diffuseFactor", [r, g, b], described.diffuse_texture.as_ref());
        let map = described.specular_glossiness_texture.as_ref();
        let glossiness = self.within("glossinessFactor", described.glossiness_factor, [0.0, 1.0]);
        let specular_roughness = match self.number("", 1.0, map, Channel::Alpha) {
            Textured::Constant(_) => Textured::Constant(1.0 - glossiness),
            gloss => self.textures.ramp(self.to, gloss, [0.0, 1.0], [1.0, 1.0 - glossiness]),
        };
        let base_color = self.with_vertices(diffuse);
        let mut principled = Principled { base_color, specular_roughness, ..Principled::default() };
        self.head_on(&mut principled, described.specular_factor.map(|x| x.clamp(0.0, 1.0)), map);
        let used = format!("a dielectric of index {:.3} with a tinted reflection", principled.specular_ior);
        self.remark("KHR_materials_pbrSpecularGlossiness", used, "reflections at grazing angles differ");
        principled
    }
}
