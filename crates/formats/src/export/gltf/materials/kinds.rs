//! Each kind of material as `principled`, OpenPBR Surface.
use crate::export::gltf::context::Export;
use noisefall_base::declare::Textured;
use noisefall_scene::material::{
    Conductor, Dielectric, Distribution, Material, Reflectance, Roughness, principled::Principled,
    thin_dielectric::ThinDielectric,
};

/// Transmittances are those of this distance, metres.
const DISTANCE: f64 = 1.0;

impl Export<'_> {
    /// The principled material that stands for a kind.
    pub(super) fn principled(&mut self, kind: &Material) -> Principled {
        match kind {
            Material::Principled(principled) => principled.clone(),
            Material::Disney(disney) => self.disney(disney),
            Material::Lambertian(diffuse) => diffuse_of(&diffuse.albedo),
            Material::Mirror(mirror) => {
                self.grazing(&mirror.reflectance);
                metal_of(&mirror.reflectance)
            }
            Material::Conductor(metal) => self.metal_like(metal),
            Material::Dielectric(glass) => self.glass(glass),
            Material::ThinDielectric(pane) => self.pane(pane),
            Material::Plastic(plastic) => self.plastic(&plastic.albedo, plastic.ior, &plastic.roughness),
            Material::RoughPlastic(plastic) => self.plastic(&plastic.albedo, plastic.ior, &plastic.roughness),
            Material::DiffuseTransmission(sheet) => {
                self.remark("`diffuse_transmission`", "its reflection alone", "no light passes");
                diffuse_of(&sheet.reflectance)
            }
            // Its opacity is 0. A blend of blends without end is black.
            Material::Null(_) | Material::Blend(_) => diffuse_of(&Textured::grey(0.0)),
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            other => diffuse_of(&Textured::Constant(self.colors.diffuse_substitute(other, &mut self.notes))),
        }
    }

    /// The format has Schlick's approximation, which reflects everything at grazing angles.
    fn grazing(&mut self, reflectance: &Textured) {
        if *reflectance != Textured::grey(1.0) {
            let used = "Schlick's approximation";
            self.remark("a constant reflectance", used, "reflections at grazing angles are brighter");
        }
    }

    fn metal_like(&mut self, metal: &Conductor) -> Principled {
        let color = match &metal.fresnel {
            Reflectance::Schlick(color) => color.clone(),
            Reflectance::Constant(color) => {
                self.grazing(color);
                color.clone()
            }
            Reflectance::Index { eta, k, tint } => {
                let effect = "the colour at grazing angles is slightly different";
                self.remark("a metal with `eta` and `k`", "Schlick's approximation", effect);
                tint.clone().map(|tint| std::array::from_fn(|i| tint[i] * head_on(eta[i], k[i])))
            }
        };
        let specular_roughness = self.facets(&metal.roughness, metal.distribution, metal.energy_compensation);
        Principled {
            specular_roughness,
            specular_roughness_anisotropy: Textured::Constant(metal.anisotropy),
            tangent_rotation: metal.tangent_rotation,
            ..metal_of(&color)
        }
    }

    fn glass(&mut self, glass: &Dielectric) -> Principled {
        let ior = glass.ior / glass.ior_outside;
        if ior < 1.0 {
            self.remark(format!("an index of refraction of {ior:.3}"), "1", "light passes without refraction");
        }
        if glass.specular_reflectance != Textured::grey(1.0) {
            self.remark("`specular_reflectance` of glass", "a tint head-on", "reflections at grazing angles have no tint");
        }
        let is_clear = glass.transmittance == [1.0; 3];
        if !is_clear && glass.specular_transmittance != Textured::grey(1.0) {
            self.remark("`specular_transmittance`", "the colour of the inside alone", "the interface does not tint the light");
        }
        Principled {
            specular_roughness: self.facets(&glass.roughness, glass.distribution, glass.energy_compensation),
            specular_roughness_anisotropy: Textured::Constant(glass.anisotropy),
            tangent_rotation: glass.tangent_rotation,
            specular_color: glass.specular_reflectance.clone(),
            specular_ior: ior.max(1.0),
            transmission_weight: Textured::Constant(1.0),
            transmission_color: match is_clear {
                true => glass.specular_transmittance.clone(),
                false => Textured::Constant(glass.transmittance),
            },
            transmission_depth: if is_clear { 0.0 } else { DISTANCE },
            ..Principled::default()
        }
    }

    fn pane(&mut self, pane: &ThinDielectric) -> Principled {
        let effect = "oblique paths and internal reflections have the tint of a perpendicular path";
        self.remark("a thin pane", "a thin sheet that is tinted once", effect);
        if pane.ior < 1.0 {
            self.remark(format!("an index of refraction of {}", pane.ior), "1", "the pane reflects nothing");
        }
        let passed = std::array::from_fn(|i| pane.transmittance[i] * pane.specular_transmittance[i]);
        Principled {
            specular_roughness: Textured::Constant(0.0),
            specular_color: Textured::Constant(pane.specular_reflectance),
            specular_ior: pane.ior.max(1.0),
            transmission_weight: Textured::Constant(1.0),
            transmission_color: Textured::Constant(passed),
            thin_walled: true,
            ..Principled::default()
        }
    }

    fn plastic(&mut self, albedo: &Textured, ior: f64, roughness: &Roughness) -> Principled {
        let effect = "the base has another brightness and saturation, because reflections inside of the coat are left out";
        self.remark("a plastic", "a diffuse base under an interface", effect);
        Principled {
            base_color: albedo.clone(),
            specular_ior: ior,
            specular_roughness: self.facets(roughness, Distribution::Ggx, true),
            ..Principled::default()
        }
    }

    /// The square root of the width of facets.
    fn facets(&mut self, roughness: &Roughness, distribution: Distribution, compensates: bool) -> Textured<f64> {
        let root = match roughness {
            Roughness::Roughness(root) => root.clone(),
            Roughness::Alpha(Textured::Constant(alpha)) => Textured::Constant(alpha.sqrt()),
            Roughness::Alpha(Textured::Texture(name)) => {
                self.remark(format!("the texture `{name}` of `alpha`"), "its mean", "the roughness is the same everywhere");
                Textured::Constant(self.colors.mean_number(&Textured::Texture(name.clone())).sqrt())
            }
        };
        if root != Textured::Constant(0.0) {
            if distribution == Distribution::Beckmann {
                self.remark("Beckmann facets", "GGX facets", "highlights have a wide glow");
            } else if !compensates {
                self.remark("single scattering between facets", "what the program does", "rough metal and glass may be brighter");
            }
        }
        root
    }
}

/// A diffuse surface without an interface.
fn diffuse_of(albedo: &Textured) -> Principled {
    Principled {
        base_color: albedo.clone(),
        specular_weight: Textured::Constant(0.0),
        specular_roughness: Textured::Constant(1.0),
        ..Principled::default()
    }
}

/// A smooth metal by its colour head-on.
fn metal_of(color: &Textured) -> Principled {
    Principled {
        base_color: color.clone(),
        base_metalness: Textured::Constant(1.0),
        specular_roughness: Textured::Constant(0.0),
        ..Principled::default()
    }
}

/// Fresnel's reflectance at normal incidence of a complex index.
fn head_on(eta: f64, k: f64) -> f64 {
    ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k)
}
