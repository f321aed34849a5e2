//! Materials of pbrt-v3.
//!
//! M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", third edition, 2016, chapters 8 and 9.
//!
//! | pbrt-v3 | ours |
//! |---|---|
//! | `matte`, `mirror`, `glass`, `metal`, `mix` | `lambertian`, `mirror`, `dielectric`, `conductor`, `blend` |
//! | `plastic`, `substrate`, `uber` | `plastic`, or `lambertian` without a specular part |
//! | `translucent` | `diffuse_transmission` |
//! | `disney` | `disney` |
//! | `kdsubsurface`, `fourier` | `plastic`, grey |
use std::rc::Rc;

use super::{kind_of, plain, roughness::Remap};
use crate::import::pbrt::{
    import::Import,
    parameters::{Entity, Type},
    records::MaterialRef,
    spectra::{Role, luminance},
    textures::number,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Conductor, Dielectric, Lambertian, Mirror, Plastic, Roughness, blend::Blend, disney::Disney},
    scene::{SceneError, description::Material},
};

type Found<T> = Result<T, SceneError>;

impl Import {
    /// A material by its kind; `None` if pbrt-v3 does not have it either.
    pub(super) fn old_material(&mut self, entity: &Entity, kind: &str) -> Option<Found<Material>> {
        const KINDS: [&str; 11] = [
            "matte",
            "mirror",
            "glass",
            "metal",
            "plastic",
            "substrate",
            "uber",
            "translucent",
            "disney",
            "kdsubsurface",
            "fourier",
        ];
        if !KINDS.contains(&kind) {
            return None;
        }
        self.remark_old(&entity.place, &format!("the material `{kind}`"));
        Some(match kind {
            "matte" => self.matte(entity),
            "mirror" => self.reflectance(entity, "Kr", 0.9).map(|reflectance| Mirror { reflectance }.into()),
            "glass" => self.old_glass(entity),
            "metal" => self.old_metal(entity),
            "plastic" => self.old_plastic(entity, [0.25; 2]),
            "substrate" => self.old_plastic(entity, [0.5; 2]),
            "uber" => self.uber(entity),
            "translucent" => self.translucent(entity),
            "disney" => self.old_disney(entity),
            "kdsubsurface" => {
                entity.ignore(&["mfp", "Kr", "Kt", "g", "scale"]);
                self.remark(entity, "plastic", "light does not enter below the surface");
                self.old_plastic(entity, [0.5, 1.0])
            }
            _ => {
                entity.ignore(&["bsdffile"]);
                self.remark(entity, "a grey diffuse surface", "the measured reflectance is not shown");
                Ok(plain::grey(0.5))
            }
        })
    }

    /// The opacity of `uber`, whose other part lets light pass.
    pub(super) fn old_opacity(&mut self, entity: &Entity, kind: &str) -> Found<Option<Textured<f64>>> {
        if kind != "uber" {
            return Ok(None);
        }
        let opacity = self.reflectance(entity, "opacity", 1.0)?;
        if matches!(opacity, Textured::Constant([r, g, b]) if r != g || g != b) {
            self.remark(entity, "its mean opacity", "light that passes has no colour");
        }
        let opacity = self.part_of_whole(entity, number(opacity));
        Ok((opacity != Textured::Constant(1.0)).then_some(opacity))
    }

    /// A mixture whose amount is that of the first material.
    pub(super) fn old_mix(&mut self, entity: &Entity) -> Found<Material> {
        self.remark_old(&entity.place, "the material `mix`");
        let missing = || entity.error("a mix has two materials", "`string namedmaterial1` and `namedmaterial2` hold their names");
        let part = |import: &mut Import, name: &str| {
            let named = entity.text(name).ok_or_else(missing)?;
            import.material(&MaterialRef::Named(Rc::from(named)), None, &entity.place)
        };
        let [one, two] = [part(self, "namedmaterial1")?, part(self, "namedmaterial2")?];
        let amount = self.reflectance(entity, "amount", 0.5)?;
        if matches!(amount, Textured::Constant([r, g, b]) if r != g || g != b) {
            self.remark(entity, "its mean amount", "colours of the mixture differ");
        }
        let weight = self.part_of_whole(entity, number(amount));
        Ok(Blend { first: two, second: one, weight, ..Blend::default() }.into())
    }

    fn reflectance(&mut self, entity: &Entity, name: &str, default: f64) -> Found<Textured> {
        self.colour(entity, name, [default; 3], Role::Reflectance)
    }

    fn matte(&mut self, entity: &Entity) -> Found<Material> {
        let albedo = self.reflectance(entity, "Kd", 0.5)?;
        if entity.optional_float("sigma")? != Some(0.0) {
            self.remark_parameter(entity, "sigma", "a Lambertian surface", "it is a little darker at grazing angles");
        }
        Ok(Lambertian { albedo }.into())
    }

    fn old_glass(&mut self, entity: &Entity) -> Found<Material> {
        let [specular_reflectance, specular_transmittance] =
            [self.reflectance(entity, "Kr", 1.0)?, self.reflectance(entity, "Kt", 1.0)?];
        let ior = self.index(entity, entity.named(&["eta", "index"]), 1.5)?;
        let is_smooth = |name| entity.optional_float(name).map(|roughness| roughness.unwrap_or(0.0) == 0.0);
        let smooth =
            Dielectric { ior, specular_reflectance, specular_transmittance, energy_compensation: false, ..Dielectric::default() };
        let varies = ["uroughness", "vroughness"].iter().any(|name| entity.find(&[Type::Texture], name).is_some());
        if !varies && is_smooth("uroughness")? && is_smooth("vroughness")? {
            entity.ignore(&["roughness", "remaproughness"]);
            return Ok(smooth.into());
        }
        let facets = self.facets_by(entity, "", 0.0, Remap::Old)?;
        let (anisotropy, tangent_rotation) = (facets.anisotropy, facets.tangent_rotation);
        Ok(Dielectric { roughness: facets.roughness, anisotropy, tangent_rotation, ..smooth }.into())
    }

    fn old_metal(&mut self, entity: &Entity) -> Found<Material> {
        let fresnel = self.fresnel(entity, "")?;
        let facets = self.facets_by(entity, "", 0.01, Remap::Old)?;
        let (anisotropy, tangent_rotation) = (facets.anisotropy, facets.tangent_rotation);
        let roughness = facets.roughness;
        Ok(Conductor { fresnel, roughness, anisotropy, tangent_rotation, energy_compensation: false, ..Conductor::default() }
            .into())
    }

    /// A diffuse surface with highlights. `defaults`: `Kd` and `Ks`.
    fn old_plastic(&mut self, entity: &Entity, [kd, ks]: [f64; 2]) -> Found<Material> {
        let albedo = self.reflectance(entity, "Kd", kd)?;
        let specular = self.reflectance(entity, "Ks", ks)?;
        // Substrates have a reflectance, and plastic a factor of that of glass.
        let head_on = if kind_of(entity) == "substrate" { 1.0 } else { 0.04 };
        self.coated(entity, albedo, &specular, head_on)
    }

    /// A diffuse surface under a coat whose reflectance head-on is `head_on` times a colour.
    fn coated(&mut self, entity: &Entity, albedo: Textured, specular: &Textured, head_on: f64) -> Found<Material> {
        let facets = self.facets_by(entity, "", 0.1, Remap::Old)?;
        let head_on = head_on * self.mean(entity, specular);
        if head_on == 0.0 {
            return Ok(Lambertian { albedo }.into());
        }
        if facets.anisotropy > 0.0 {
            self.remark(entity, "a coat with round highlights", "highlights are not stretched");
        }
        let effect = "highlights are white, and as strong head-on; the brightness differs by a few per cent";
        self.remark(entity, "plastic", effect);
        let root = head_on.min(0.9).sqrt();
        Ok(Plastic { albedo, ior: (1.0 + root) / (1.0 - root), roughness: facets.roughness }.into())
    }

    /// The grey value of a colour; 0.5 of a texture.
    fn mean(&mut self, entity: &Entity, colour: &Textured) -> f64 {
        match colour {
            Textured::Constant(colour) => luminance(*colour),
            Textured::Texture(_) => {
                self.remark(entity, "a reflectance of 0.5", "highlights do not vary");
                0.5
            }
        }
    }

    fn uber(&mut self, entity: &Entity) -> Found<Material> {
        let [albedo, specular] = [self.reflectance(entity, "Kd", 0.25)?, self.reflectance(entity, "Ks", 0.25)?];
        let [mirror, passes] = [self.reflectance(entity, "Kr", 0.0)?, self.reflectance(entity, "Kt", 0.0)?];
        let ior = self.index(entity, entity.named(&["eta", "index"]), 1.5)?;
        let black = Textured::grey(0.0);
        if passes != black {
            entity.ignore(&["roughness", "uroughness", "vroughness", "remaproughness"]);
            self.remark(entity, "glass", "its diffuse part is missing");
            let specular_reflectance = if mirror == black { specular } else { mirror };
            return Ok(Dielectric { ior, specular_reflectance, specular_transmittance: passes, ..Dielectric::default() }.into());
        }
        let head_on = ((ior - 1.0) / (ior + 1.0)).powi(2);
        if mirror == black {
            return self.coated(entity, albedo, &specular, head_on);
        }
        entity.ignore(&["roughness", "uroughness", "vroughness", "remaproughness"]);
        self.remark(entity, "smooth plastic", "its rough highlights are missing");
        let root = (head_on * self.mean(entity, &mirror)).min(0.9).sqrt();
        Ok(Plastic { albedo, ior: (1.0 + root) / (1.0 - root), roughness: Roughness::alpha(0.0) }.into())
    }

    fn translucent(&mut self, entity: &Entity) -> Found<Material> {
        let albedo = self.reflectance(entity, "Kd", 0.25)?;
        let [reflect, transmit] = [self.reflectance(entity, "reflect", 0.5)?, self.reflectance(entity, "transmit", 0.5)?];
        entity.ignore(&["Ks", "roughness", "remaproughness"]);
        self.remark(entity, "its diffuse part", "there are no highlights");
        let parts = [reflect, transmit].map(|part| self.times(&albedo, part, "translucent"));
        let [reflectance, transmittance] = parts;
        self.sheet(entity, reflectance, transmittance)
    }

    fn old_disney(&mut self, entity: &Entity) -> Found<Material> {
        for (name, effect) in
            [("difftrans", "no light is transmitted diffusely"), ("scatterdistance", "light does not enter below the surface")]
        {
            self.remark_parameter(entity, name, "nothing", effect);
        }
        if entity.flag("thin", false)? {
            self.remark(entity, "a solid", "the surface is not thin");
        }
        let mut unit = |name: &str, default: f64| {
            let number = self.number_or_texture(entity, name, default)?;
            Ok::<_, SceneError>(self.part_of_whole(entity, number))
        };
        let disney = Disney {
            metallic: unit("metallic", 0.0)?,
            roughness: unit("roughness", 0.5)?,
            anisotropic: unit("anisotropic", 0.0)?,
            spec_tint: unit("speculartint", 0.0)?,
            spec_trans: unit("spectrans", 0.0)?,
            flatness: unit("flatness", 0.0)?,
            sheen: unit("sheen", 0.0)?,
            sheen_tint: unit("sheentint", 0.5)?,
            clearcoat: unit("clearcoat", 0.0)?,
            clearcoat_gloss: unit("clearcoatgloss", 1.0)?,
            ..Disney::default()
        };
        let (base_color, ior) = (self.reflectance(entity, "color", 0.5)?, self.index(entity, "eta", 1.5)?);
        Ok(Disney { base_color, ior, ..disney }.into())
    }
}
