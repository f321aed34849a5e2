//! Disney's BSDF as `principled`: it agrees in metal, in rough reflection and transmission, and in Fresnel's interface.
use crate::export::gltf::context::Export;
use noisefall_base::{declare::Textured, math::colour::LUMINANCE};
use noisefall_scene::material::{Disney, principled::Principled};

/// Disney's clear coat: its index, the fraction of its lobe at `clearcoat = 1`, and the widths of its facets without and with gloss.
const COAT_INDEX: f64 = 1.5;
const COAT_SHARE: f64 = 0.25;
const COAT_WIDTHS: [f64; 2] = [0.1, 0.001];
const NONE: Textured<f64> = Textured::Constant(0.0);

impl Export<'_> {
    /// The nearest principled material.
    pub(super) fn disney(&mut self, disney: &Disney) -> Principled {
        self.list_differences_of_disney(disney);
        let color = self.colors.mean(&disney.base_color);
        let [anisotropic, coat, gloss] =
            [&disney.anisotropic, &disney.clearcoat, &disney.clearcoat_gloss].map(|number| self.colors.mean_number(number));
        let [tint, sheen_tint] = [&disney.spec_tint, &disney.sheen_tint].map(|tint| toward(color, self.colors.mean_number(tint)));
        Principled {
            base_color: disney.base_color.clone(),
            base_metalness: disney.metallic.clone(),
            specular_color: tint,
            specular_roughness: widened(&disney.roughness, anisotropic),
            specular_roughness_anisotropy: Textured::Constant(0.9 * anisotropic),
            specular_ior: disney.ior.max(1.0),
            transmission_weight: disney.spec_trans.clone(),
            transmission_color: Textured::Constant(color.map(f64::sqrt)),
            coat_weight: Textured::Constant(COAT_SHARE * coat),
            coat_roughness: Textured::Constant((COAT_WIDTHS[0] + (COAT_WIDTHS[1] - COAT_WIDTHS[0]) * gloss).sqrt()),
            coat_ior: COAT_INDEX,
            coat_darkening: NONE,
            fuzz_weight: disney.sheen.clone(),
            fuzz_color: sheen_tint,
            ..Principled::default()
        }
    }

    /// Says which parts of the material the other model has in another way.
    fn list_differences_of_disney(&mut self, disney: &Disney) {
        let differs = [
            ("the diffuse lobe", true),
            ("flatness", disney.flatness != NONE),
            ("sheen", disney.sheen != NONE),
            ("the clear coat", disney.clearcoat != NONE),
            ("the tinted interface", disney.spec_tint != NONE),
        ];
        let names: Vec<&str> = differs.into_iter().filter_map(|(name, differs)| differs.then_some(name)).collect();
        self.remark("`disney`", "`principled`", format!("another model of {}", names.join(", ")));
        let numbers = [&disney.anisotropic, &disney.spec_tint, &disney.sheen_tint, &disney.clearcoat, &disney.clearcoat_gloss];
        if numbers.into_iter().any(|number| matches!(number, Textured::Texture(_))) {
            self.remark("textures of numbers of `disney`", "their means", "these numbers are the same everywhere");
        }
        if disney.ior < 1.0 {
            self.remark(format!("an index of refraction of {}", disney.ior), "1", "light passes without refraction");
        }
    }
}

/// Roughness that gives the widths r²/s and r² s with s² = 1 − 0.9 a by OpenPBR's formula, which keeps their mean square.
fn widened(roughness: &Textured<f64>, anisotropic: f64) -> Textured<f64> {
    let ratio = 1.0 - 0.9 * anisotropic;
    roughness.clone().map(|r| (r * ((1.0 + ratio * ratio) / (2.0 * ratio)).powf(0.25)).min(1.0))
}

/// White, or as far towards the hue of a colour as a tint says.
fn toward(color: [f64; 3], tint: f64) -> Textured {
    let luminance: f64 = color.iter().zip(LUMINANCE).map(|(x, weight)| x * f64::from(weight)).sum();
    let hue = if luminance > 0.0 { color.map(|x| x / luminance) } else { [1.0; 3] };
    Textured::Constant(hue.map(|x| (1.0 + (x - 1.0) * tint).clamp(0.0, 1.0)))
}
