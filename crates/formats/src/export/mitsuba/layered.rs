//! Disney's principled BSDF, and OpenPBR as that.
use super::{bsdfs::Base, context::Export, markup::Element};
use noisefall_base::declare::Textured;
use noisefall_scene::material::{Disney, principled::Principled};

/// The fraction of Disney's clear coat at `clearcoat = 1`.
const COAT_SHARE: f64 = 0.25;
/// The widths of its facets at `clearcoat_gloss` 0 and 1.
const COAT_WIDTHS: [f64; 2] = [0.1, 0.001];

impl Export<'_> {
    /// Mitsuba's own.
    pub fn disney(&mut self, disney: &Disney) -> Base {
        const NONE: &Textured<f64> = &Textured::Constant(0.0);
        let color = self.color("base_color", &disney.base_color);
        let roughness = self.number("roughness", &disney.roughness);
        let mut element = Element::plugin("bsdf", "principled").with_all([color, roughness]).float("eta", disney.ior);
        for (name, number) in [
            ("metallic", &disney.metallic),
            ("anisotropic", &disney.anisotropic),
            ("spec_tint", &disney.spec_tint),
            ("spec_trans", &disney.spec_trans),
            ("flatness", &disney.flatness),
            ("sheen", &disney.sheen),
            ("sheen_tint", &disney.sheen_tint),
            ("clearcoat", &disney.clearcoat),
            ("clearcoat_gloss", &disney.clearcoat_gloss),
        ] {
            if number != NONE {
                element = element.with(self.number(name, number));
            }
        }
        self.uses_coordinates |= disney.anisotropic != *NONE;
        if disney.spec_trans == *NONE { Base::opaque(element) } else { Base::transparent(element) }
    }

    pub fn principled(&mut self, material: &Principled) -> Base {
        let transmits = material.transmission_weight != Textured::Constant(0.0);
        let is_thin = material.thin_walled && transmits;
        let element = Element::plugin("bsdf", if is_thin { "principledthin" } else { "principled" });
        let is_clear = transmits && material.transmission_depth == 0.0;
        let base = if is_clear && material.transmission_color != Textured::grey(1.0) {
            let tint = self.colors.mean(&material.transmission_color);
            // Disney tints by the root of the base colour at each interface.
            Textured::Constant(if is_thin { tint } else { tint.map(|x| x * x) })
        } else if transmits && material.base_color == Principled::default().base_color {
            Textured::grey(1.0)
        } else {
            material.base_color.clone()
        };
        let parts = [
            self.color("base_color", &base),
            self.number("roughness", &material.specular_roughness),
            self.number("spec_trans", &material.transmission_weight),
            self.number("sheen", &material.fuzz_weight),
        ];
        let mut element = element.with_all(parts).float("eta", material.specular_ior.max(1.001));
        let anisotropy = self.constant("specular_roughness_anisotropy", &material.specular_roughness_anisotropy);
        if anisotropy > 0.0 {
            self.uses_coordinates = true;
            element = element.float("anisotropic", (anisotropy / 0.9).min(1.0));
        }
        if !is_thin {
            element = self.metal_and_coat(element, material);
        }
        self.list_differences(material);
        if transmits { Base::transparent(element) } else { Base::opaque(element) }
    }

    fn metal_and_coat(&mut self, element: Element, material: &Principled) -> Element {
        let metal = self.number("metallic", &material.base_metalness);
        let element = element.with(metal);
        let coat = self.constant("coat_weight", &material.coat_weight);
        if coat == 0.0 {
            return element;
        }
        let width = self.constant("coat_roughness", &material.coat_roughness).powi(2);
        let gloss = (COAT_WIDTHS[0] - width) / (COAT_WIDTHS[0] - COAT_WIDTHS[1]);
        element.float("clearcoat", (coat / COAT_SHARE).min(1.0)).float("clearcoat_gloss", gloss.clamp(0.0, 1.0))
    }

    /// Says which parts of the material Disney's model does not have, or has in another way.
    fn list_differences(&mut self, material: &Principled) {
        let usual = Principled::default();
        let has = |weight: &Textured<f64>| *weight != Textured::Constant(0.0);
        let differs = [
            ("the diffuse lobe", true),
            ("`base_weight`", material.base_weight != usual.base_weight),
            ("`base_diffuse_roughness`", has(&material.base_diffuse_roughness)),
            ("`specular_weight`", material.specular_weight != usual.specular_weight),
            ("`specular_color`", material.specular_color != usual.specular_color),
            ("the coat", has(&material.coat_weight)),
            ("the fuzz", has(&material.fuzz_weight)),
            ("the thin film", has(&material.thin_film_weight)),
            ("absorption over a depth", has(&material.transmission_weight) && material.transmission_depth > 0.0),
            ("`tangent_rotation`", material.tangent_rotation != 0.0),
        ];
        let names: Vec<&str> = differs.into_iter().filter_map(|(name, differs)| differs.then_some(name)).collect();
        self.remark("`principled`, OpenPBR", "Disney's principled BSDF", format!("another model of {}", names.join(", ")));
    }
}
