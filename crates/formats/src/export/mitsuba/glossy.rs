//! Metals, glass and plastics.
use super::{context::Export, markup::Element};
use crate::import::mitsuba::coat;
use noisefall_base::declare::Textured;
use noisefall_scene::material::{
    Conductor, Dielectric, Distribution, Plastic, Reflectance, RoughPlastic, Roughness, ggx, thin_dielectric::ThinDielectric,
};

impl Export<'_> {
    pub fn mirror(&mut self, reflectance: &Textured) -> Element {
        let reflectance = self.color("specular_reflectance", reflectance);
        Element::plugin("bsdf", "conductor").text("material", "none").with(reflectance)
    }

    pub fn metal(&mut self, metal: &Conductor) -> Element {
        if let Reflectance::Schlick(color) = &metal.fresnel {
            return self.schlick(color, metal);
        }
        let is_smooth = is_smooth(&metal.roughness);
        let element = Element::plugin("bsdf", if is_smooth { "conductor" } else { "roughconductor" });
        let element = match &metal.fresnel {
            Reflectance::Index { eta, k, tint } => {
                let element = element.with(Element::color("eta", *eta)).with(Element::color("k", *k));
                self.tint(element, "specular_reflectance", tint)
            }
            Reflectance::Constant(color) | Reflectance::Schlick(color) => {
                let color = self.color("specular_reflectance", color);
                element.text("material", "none").with(color)
            }
        };
        if is_smooth {
            return element;
        }
        self.compensation(metal.energy_compensation, metal.distribution);
        let element = element.text("distribution", word(metal.distribution));
        self.facets(element, &metal.roughness, metal.anisotropy, metal.tangent_rotation)
    }

    /// Schlick's metal is that of Disney's model.
    fn schlick(&mut self, color: &Textured, metal: &Conductor) -> Element {
        let color = self.color("base_color", color);
        let element = Element::plugin("bsdf", "principled").with(color).float("metallic", 1.0);
        if is_smooth(&metal.roughness) {
            self.remark(
                "a smooth metal by Schlick's approximation",
                "a width of facets of 0.001",
                "reflections are slightly soft",
            );
            return element.float("roughness", 0.0);
        }
        self.compensation(metal.energy_compensation, metal.distribution);
        if metal.distribution == Distribution::Beckmann {
            self.remark("Beckmann facets of a metal by Schlick's approximation", "GGX facets", "highlights have a wide glow");
        }
        if metal.anisotropy > 0.0 {
            self.remark("anisotropy of a metal by Schlick's approximation", "none", "highlights are round");
        }
        let roughness = match &metal.roughness {
            Roughness::Roughness(roughness) => self.number("roughness", roughness),
            Roughness::Alpha(Textured::Constant(alpha)) => Element::number("roughness", alpha.sqrt()),
            Roughness::Alpha(alpha) => Element::number("roughness", self.constant("alpha", alpha).sqrt()),
        };
        element.with(roughness)
    }

    pub fn glass(&mut self, glass: &Dielectric) -> Element {
        let is_smooth = is_smooth(&glass.roughness);
        let element = Element::plugin("bsdf", if is_smooth { "dielectric" } else { "roughdielectric" })
            .float("int_ior", glass.ior)
            .float("ext_ior", glass.ior_outside);
        if glass.transmittance != [1.0; 3] {
            self.remark("`transmittance` of the interior", "1, clear glass", "the glass has no tint");
        }
        let element = self.tint(element, "specular_reflectance", &glass.specular_reflectance);
        let element = self.tint(element, "specular_transmittance", &glass.specular_transmittance);
        if is_smooth {
            return element;
        }
        self.compensation(glass.energy_compensation, glass.distribution);
        let element = element.text("distribution", word(glass.distribution));
        self.facets(element, &glass.roughness, glass.anisotropy, glass.tangent_rotation)
    }

    pub fn pane(&mut self, pane: &ThinDielectric) -> Element {
        let element = Element::plugin("bsdf", "thindielectric").float("int_ior", pane.ior).float("ext_ior", 1.0);
        let element = self.tint(element, "specular_reflectance", &Textured::Constant(pane.specular_reflectance));
        if pane.transmittance != [1.0; 3] {
            let effect = "oblique paths and internal reflections have the tint of a perpendicular path";
            self.remark("`transmittance` of a pane", "`specular_transmittance`", effect);
        }
        let passed = [0, 1, 2].map(|i| pane.transmittance[i] * pane.specular_transmittance[i]);
        self.tint(element, "specular_transmittance", &Textured::Constant(passed))
    }

    /// A factor of reflected or transmitted light, left out if it is 1.
    fn tint(&mut self, element: Element, name: &str, tint: &Textured) -> Element {
        if *tint == Textured::grey(1.0) {
            return element;
        }
        let tint = self.color(name, tint);
        element.with(tint)
    }

    /// Ours is that of Mitsuba with `nonlinear` if its coat is smooth. Otherwise the colour of the base is another one.
    pub fn plastic(&mut self, plastic: &Plastic) -> Element {
        let is_smooth = is_smooth(&plastic.roughness);
        let element = Element::plugin("bsdf", if is_smooth { "plastic" } else { "roughplastic" })
            .float("int_ior", plastic.ior)
            .float("ext_ior", 1.0)
            .flag("nonlinear", true);
        if is_smooth {
            let albedo = self.color("diffuse_reflectance", &plastic.albedo);
            return element.with(albedo);
        }
        let alpha = match &plastic.roughness {
            Roughness::Roughness(root) => self.constant("roughness", root).powi(2),
            Roughness::Alpha(alpha) => self.constant("alpha", alpha),
        };
        self.remark("a plastic with a rough coat", "`roughplastic`", "light that scatters more than once in the coat is lost");
        let albedo = match &plastic.albedo {
            Textured::Constant(albedo) => Textured::Constant(albedo.map(|x| nonlinear(x, plastic.ior, alpha))),
            textured @ Textured::Texture(_) => {
                self.remark("a textured base under a rough coat", "the same texture", "the base is up to 2 % brighter or darker");
                textured.clone()
            }
        };
        let albedo = self.color("diffuse_reflectance", &albedo);
        element.text("distribution", "ggx").float("alpha", alpha).with(albedo)
    }

    /// Mitsuba's own; it finds the internal reflectance by itself.
    pub fn rough_plastic(&mut self, plastic: &RoughPlastic) -> Element {
        let is_smooth = is_smooth(&plastic.roughness);
        let element = Element::plugin("bsdf", if is_smooth { "plastic" } else { "roughplastic" })
            .float("int_ior", plastic.ior)
            .float("ext_ior", 1.0)
            .flag("nonlinear", plastic.nonlinear);
        let element = self.tint(element, "specular_reflectance", &Textured::Constant(plastic.specular_reflectance));
        let albedo = self.color("diffuse_reflectance", &plastic.albedo);
        let element = element.with(albedo);
        let (element, expected) = if is_smooth {
            (element, 1.0)
        } else {
            let alpha = match &plastic.roughness {
                Roughness::Roughness(root) => self.constant("roughness", root).powi(2),
                Roughness::Alpha(alpha) => self.constant("alpha", alpha),
            };
            let expected = coat::internal_reflectance(plastic.ior, alpha, plastic.distribution);
            (element.text("distribution", word(plastic.distribution)).float("alpha", alpha), expected)
        };
        if (plastic.internal_reflectance - expected).abs() > 0.01 {
            let found = format!("`internal_reflectance` {}", plastic.internal_reflectance);
            self.remark(found, format!("{expected:.3}"), "the base has another brightness");
        }
        element
    }

    /// Widths of facets along u and v: α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t.
    fn facets(&mut self, element: Element, roughness: &Roughness, anisotropy: f64, rotation: f64) -> Element {
        if anisotropy == 0.0 {
            let alpha = match roughness {
                Roughness::Alpha(alpha) => self.number("alpha", alpha),
                Roughness::Roughness(Textured::Constant(root)) => Element::number("alpha", root * root),
                Roughness::Roughness(Textured::Texture(name)) => self.squared("alpha", name),
            };
            return element.with(alpha);
        }
        self.uses_coordinates = true;
        let alpha = match roughness {
            Roughness::Alpha(alpha) => self.constant("alpha", alpha),
            Roughness::Roughness(root) => self.constant("roughness", root).powi(2),
        };
        let long = alpha * (2.0 / (1.0 + (1.0 - anisotropy).powi(2))).sqrt();
        let turns = rotation / 90.0;
        if turns != turns.round() {
            self.remark(
                format!("`tangent_rotation` {rotation}"),
                "the nearest multiple of 90°",
                "highlights have another direction",
            );
        }
        let is_turned = turns.round().rem_euclid(2.0) == 1.0;
        // Facets of width 0 are a mirror.
        let short = ((1.0 - anisotropy) * long).max(1e-4);
        let [u, v] = if is_turned { [short, long] } else { [long, short] };
        element.float("alpha_u", u).float("alpha_v", v)
    }

    fn compensation(&mut self, is_on: bool, distribution: Distribution) {
        if is_on && distribution == Distribution::Ggx {
            self.remark("`energy_compensation`", "single scattering", "rough metal and glass are darker");
        }
    }
}

/// Mitsuba's name of a distribution.
fn word(distribution: Distribution) -> &'static str {
    match distribution {
        Distribution::Ggx => "ggx",
        Distribution::Beckmann => "beckmann",
    }
}

/// The colour of a nonlinear `roughplastic` whose base reflects as much as ours of an albedo ρ.
///
/// Ours is f = b T T/π with b = ρ/(η² (1 − ρ) + ρ T̄), Mitsuba's has b = ρ'/(η² (1 − ρ' R)).
fn nonlinear(albedo: f64, eta: f64, alpha: f64) -> f64 {
    let square = eta * eta;
    let passes = 1.0 - coat::mean_reflectance(eta, alpha, Distribution::Ggx);
    let returns = coat::internal_reflectance(eta, alpha, Distribution::Ggx);
    let base = square * albedo / (square * (1.0 - albedo) + albedo * passes);
    (base / (1.0 + base * returns)).clamp(0.0, 1.0)
}

fn is_smooth(roughness: &Roughness) -> bool {
    match roughness {
        Roughness::Roughness(Textured::Constant(root)) => root * root < f64::from(ggx::SMOOTH),
        Roughness::Alpha(Textured::Constant(alpha)) => *alpha < f64::from(ggx::SMOOTH),
        Roughness::Roughness(Textured::Texture(_)) | Roughness::Alpha(Textured::Texture(_)) => false,
    }
}
