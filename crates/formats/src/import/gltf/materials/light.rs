//! Emission and opacity.
use super::MaterialImport;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::emission::{radiance::Radiance, texture::Texture},
    material::{Lambertian, Material},
    scene::description::{EmissionDescription, EmissionSource},
    texture::image::Channel,
};

/// Width of the step of `MASK` in opacity: a texture has no threshold, so a steep ramp stands for it.
pub const STEP: f64 = 1e-3;

impl MaterialImport<'_, '_> {
    /// Radiance: factor × texture × strength, W/(m² sr) where the file has no unit. A surface that is not seen from behind does not
    /// shine there.
    pub(super) fn emission(&mut self) -> Option<EmissionDescription> {
        let factor = self.material.emissive_factor.map(|x| x.max(0.0));
        let strength = self.extensions.emissive_strength.as_ref().map_or(1.0, |described| described.emissive_strength);
        let map = self.material.emissive_texture.as_deref();
        if factor == [0.0; 3] || strength <= 0.0 {
            return None;
        }
        let colour = self.colour(factor, map);
        Some(self.emitting(colour, strength))
    }

    /// A surface that shows its colour whatever the light: it reflects nothing and emits the color.
    pub(super) fn unlit(&mut self) -> (Material, Option<EmissionDescription>) {
        let black = Lambertian { albedo: Textured::grey(0.0) }.into();
        let colour = self.base_colour();
        if colour == Textured::grey(0.0) {
            return (black, None);
        }
        let emission = EmissionDescription { two_sided: true, ..self.emitting(colour, 1.0) };
        self.remark("KHR_materials_unlit", "emission of the colour, without reflection", "the surface also lights others");
        (black, Some(emission))
    }

    fn emitting(&self, colour: Textured, scale: f64) -> EmissionDescription {
        let source: EmissionSource = match colour {
            Textured::Constant(radiance) => Radiance { radiance }.into(),
            Textured::Texture(name) => Texture { name }.into(),
        };
        EmissionDescription { source, two_sided: self.material.double_sided, scale: scale.clamp(0.0, 1e12) }
    }

    /// The opacity by the alpha mode; `None` is 1.
    pub(super) fn opacity(&mut self) -> Option<Textured<f64>> {
        let is_mask = match self.material.alpha_mode.as_str() {
            "" | "OPAQUE" => return None,
            "MASK" => true,
            "BLEND" => false,
            other => {
                self.remark(format!("`alphaMode` \"{other}\""), "\"OPAQUE\"", "the surface hides what is behind it");
                return None;
            }
        };
        let alpha = match self.extensions.specular_glossiness.as_deref() {
            Some(described) => {
                self.number("diffuseFactor", described.diffuse_factor[3], described.diffuse_texture.as_ref(), Channel::Alpha)
            }
            None => {
                let described = self.described();
                self.number(
                    "baseColorFactor",
                    described.base_color_factor[3],
                    described.base_color_texture.as_ref(),
                    Channel::Alpha,
                )
            }
        };
        let alpha = self.with_vertex_alpha(alpha);
        let opacity = if is_mask { self.masked(alpha) } else { alpha };
        (opacity != Textured::Constant(1.0)).then_some(opacity)
    }

    /// 1 where alpha reaches the cutoff, and 0 elsewhere.
    fn masked(&mut self, alpha: Textured<f64>) -> Textured<f64> {
        let cutoff = self.material.alpha_cutoff;
        match alpha {
            Textured::Constant(alpha) => Textured::Constant(if alpha >= cutoff { 1.0 } else { 0.0 }),
            Textured::Texture(_) if cutoff > 1.0 => Textured::Constant(0.0),
            Textured::Texture(_) if cutoff <= STEP => Textured::Constant(1.0),
            texture => self.textures.ramp(self.to, texture, [cutoff - STEP, cutoff], [0.0, 1.0]),
        }
    }
}
