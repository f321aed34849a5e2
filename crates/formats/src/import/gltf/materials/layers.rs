//! Transmission, coat, sheen, thin film and anisotropy.
use super::MaterialImport;
use crate::import::gltf::{document::TextureInfo, extensions::Volume};
use noisefall_base::declare::Textured;
use noisefall_scene::{material::principled::Principled, texture::image::Channel};

/// Nanometres of a micrometre.
const NANOMETRES: f64 = 1000.0;
/// Index of refraction of the coat of glTF: it reflects 4 % head-on.
const COAT_IOR: f64 = 1.5;

impl MaterialImport<'_, '_> {
    /// Light that passes: through a thin sheet, or into a volume.
    pub(super) fn transmission(&mut self, principled: &mut Principled) {
        if self.extensions.dispersion.as_ref().is_some_and(|described| described.dispersion > 0.0) {
            self.remark("KHR_materials_dispersion", "one index of refraction", "refracted light has no coloured fringes");
        }
        let Some(described) = self.extensions.transmission.as_deref() else { return };
        principled.transmission_weight = self.number(
            "transmissionFactor",
            described.transmission_factor,
            described.transmission_texture.as_ref(),
            Channel::Red,
        );
        if principled.transmission_weight == Textured::Constant(0.0) {
            return;
        }
        principled.transmission_color = principled.base_color.clone();
        match self.extensions.volume.as_deref().filter(|volume| volume.thickness_factor > 0.0) {
            Some(volume) => self.volume(volume, principled),
            None if self.is_of_blender => {
                // Blender knows no thin sheets, and tints by the root at each of two interfaces.
                if let Textured::Constant(colour) = &mut principled.transmission_color {
                    *colour = colour.map(f64::sqrt);
                }
                let found = "KHR_materials_transmission without a volume, written by Blender";
                self.remark(found, "a solid that refracts, as in Cycles", "other viewers show a thin sheet");
            }
            None => principled.thin_walled = true,
        }
    }

    fn volume(&mut self, volume: &Volume, principled: &mut Principled) {
        let distance = volume.attenuation_distance.filter(|distance| *distance > 0.0 && distance.is_finite());
        let colour = self.units("attenuationColor", volume.attenuation_color);
        let Some(distance) = distance.filter(|_| colour != [1.0; 3]) else { return };
        if principled.base_color != Textured::grey(1.0) {
            self.remark(
                "a base colour besides `attenuationColor`",
                "`attenuationColor`",
                "the interface does not tint the light",
            );
        }
        principled.transmission_color = Textured::Constant(colour);
        principled.transmission_depth = distance;
    }

    /// The clear coat, which does not darken the base.
    pub(super) fn coat(&mut self, principled: &mut Principled) {
        let Some(described) = self.extensions.clearcoat.as_deref().filter(|coat| coat.clearcoat_factor > 0.0) else { return };
        principled.coat_weight =
            self.number("clearcoatFactor", described.clearcoat_factor, described.clearcoat_texture.as_ref(), Channel::Red);
        let map = described.clearcoat_roughness_texture.as_ref();
        principled.coat_roughness =
            self.number("clearcoatRoughnessFactor", described.clearcoat_roughness_factor, map, Channel::Green);
        principled.coat_ior = COAT_IOR;
        principled.coat_darkening = Textured::Constant(0.0);
        let same = |a: &TextureInfo, b: Option<&TextureInfo>| b.is_some_and(|b| a.index == b.index);
        let base = self.material.normal_texture.as_deref();
        match (&described.clearcoat_normal_texture, base) {
            (Some(coat), base) if !same(coat, base) => {
                self.remark("`clearcoatNormalTexture`", "the normals of the base", "the coat has other bumps");
            }
            (None, Some(_)) => {
                self.remark("a smooth coat over a normal map", "the normals of the base", "the coat has bumps too");
            }
            _ => {}
        }
    }

    pub(super) fn sheen(&mut self, principled: &mut Principled) {
        let Some(described) = self.extensions.sheen.as_deref() else { return };
        let factor = self.units("sheenColorFactor", described.sheen_color_factor);
        let strongest = factor.iter().fold(0.0, |a: f64, b| a.max(*b));
        if strongest == 0.0 {
            return;
        }
        principled.fuzz_weight = Textured::Constant(strongest);
        principled.fuzz_color = self.colour(factor.map(|x| x / strongest), described.sheen_color_texture.as_ref());
        let map = described.sheen_roughness_texture.as_ref();
        principled.fuzz_roughness = self.number("sheenRoughnessFactor", described.sheen_roughness_factor, map, Channel::Alpha);
        self.remark("KHR_materials_sheen (Charlie)", "the fuzz of OpenPBR", "the sheen has a similar strength and another shape");
    }

    pub(super) fn iridescence(&mut self, principled: &mut Principled) {
        let Some(described) = self.extensions.iridescence.as_deref().filter(|film| film.iridescence_factor > 0.0) else { return };
        principled.thin_film_weight =
            self.number("iridescenceFactor", described.iridescence_factor, described.iridescence_texture.as_ref(), Channel::Red);
        principled.thin_film_ior = self.within("iridescenceIor", described.iridescence_ior, [1.0, 20.0]);
        let ends = [described.iridescence_thickness_minimum, described.iridescence_thickness_maximum];
        let [least, most] = ends.map(|thickness| (thickness / NANOMETRES).clamp(0.0, 10.0));
        principled.thin_film_thickness =
            match self.number("", 1.0, described.iridescence_thickness_texture.as_ref(), Channel::Green) {
                Textured::Constant(_) => Textured::Constant(most),
                texture => self.textures.ramp(self.to, texture, [0.0, 1.0], [least, most]),
            };
    }

    /// Widths α_t = mix(α, 1, s²) and α_b = α of glTF; α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t of OpenPBR.
    pub(super) fn anisotropy(&mut self, principled: &mut Principled) {
        let Some(described) = self.extensions.anisotropy.as_deref().filter(|found| found.anisotropy_strength > 0.0) else {
            return;
        };
        if described.anisotropy_texture.is_some() {
            self.remark(
                "`anisotropyTexture`",
                "`anisotropyStrength` along the tangent",
                "highlights do not turn with the texture",
            );
        }
        principled.tangent_rotation = described.anisotropy_rotation.to_degrees();
        let stretch = self.within("anisotropyStrength", described.anisotropy_strength, [0.0, 1.0]).powi(2);
        let Textured::Constant(roughness) = principled.specular_roughness else {
            principled.specular_roughness_anisotropy = Textured::Constant(stretch);
            self.remark(
                "anisotropy with a texture of roughness",
                format!("anisotropy {stretch:.3}"),
                "highlights are of another length",
            );
            return;
        };
        let across = roughness * roughness;
        let along = across + (1.0 - across) * stretch;
        let ratio = across / along;
        let alpha = along / (2.0 / (1.0 + ratio * ratio)).sqrt();
        principled.specular_roughness_anisotropy = Textured::Constant(1.0 - ratio);
        principled.specular_roughness = Textured::Constant(alpha.sqrt());
    }
}
