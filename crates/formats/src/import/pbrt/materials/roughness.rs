//! Roughness: widths of the GGX distribution along u and v.
//!
//! Unless `remaproughness` is false, pbrt-v4 takes α = √roughness, and pbrt-v3 a polynomial of its logarithm.
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::Roughness,
    scene::SceneError,
    texture::ramp::{Ramp, Stop},
};

/// The facets of a rough surface.
pub struct Facets {
    pub roughness: Roughness,
    /// From 0, round, to 1.
    pub anisotropy: f64,
    /// Degrees.
    pub tangent_rotation: f64,
}

impl Facets {
    /// The square root of α, if it does not vary.
    pub fn root(&self) -> Option<f64> {
        match &self.roughness {
            Roughness::Alpha(Textured::Constant(alpha)) => Some(alpha.sqrt()),
            _ => None,
        }
    }
}

/// Map from a roughness to α.
#[derive(Clone, Copy)]
pub enum Remap {
    /// The roughness itself.
    None,
    /// Its root.
    Root,
    /// The fit of pbrt-v3.
    Old,
}

impl Remap {
    fn alpha(self, roughness: f64) -> f64 {
        match self {
            Remap::None => roughness,
            Remap::Root => roughness.max(0.0).sqrt(),
            Remap::Old => {
                let x = roughness.max(1e-3).ln();
                1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)))
            }
        }
    }
}

impl Import {
    /// The facets of an interface; `prefix` stands before the names of its parameters.
    pub(super) fn facets(&mut self, entity: &Entity, prefix: &str, default: f64) -> Result<Facets, SceneError> {
        self.facets_by(entity, prefix, default, Remap::Root)
    }

    /// The facets of an interface whose roughness `remap` converts to α.
    pub(super) fn facets_by(&mut self, entity: &Entity, prefix: &str, default: f64, remap: Remap) -> Result<Facets, SceneError> {
        let remap = if entity.flag("remaproughness", true)? { remap } else { Remap::None };
        let both = format!("{prefix}roughness");
        let [u, v] = ["u", "v"].map(|axis| format!("{prefix}{axis}roughness"));
        let [u, v] = [if entity.has(&u) { &u } else { &both }, if entity.has(&v) { &v } else { &both }];
        let widths = (self.number_or_texture(entity, u, default)?, self.number_or_texture(entity, v, default)?);
        match widths {
            (Textured::Constant(u), Textured::Constant(v)) => {
                let alpha = |roughness: f64| {
                    let width = remap.alpha(roughness);
                    // pbrt takes narrower distributions as smooth.
                    if width < 1e-3 { 0.0 } else { width.min(1.0) }
                };
                Ok(Facets::of(alpha(u), alpha(v)))
            }
            (Textured::Texture(texture), other) => {
                if other != Textured::Texture(texture.clone()) {
                    self.remark(entity, "the roughness along u in all directions", "highlights are round");
                }
                self.textured_facets(entity, texture, remap)
            }
            (_, Textured::Texture(texture)) => {
                self.remark(entity, "the roughness along v in all directions", "highlights are round");
                self.textured_facets(entity, texture, remap)
            }
        }
    }

    fn textured_facets(&mut self, entity: &Entity, texture: String, remap: Remap) -> Result<Facets, SceneError> {
        let alpha = match (self.part_of_whole(entity, Textured::Texture(texture)), remap) {
            (Textured::Texture(texture), Remap::Root | Remap::Old) => Textured::Texture(self.remapped(&texture, remap)),
            (alpha, _) => alpha,
        };
        Ok(Facets { roughness: Roughness::Alpha(alpha), anisotropy: 0.0, tangent_rotation: 0.0 })
    }

    /// A texture whose values are α for those of another.
    fn remapped(&mut self, texture: &str, remap: Remap) -> String {
        /// The error of the root is at most 1/256 near 0.
        const STOPS: u32 = 64;
        let stop = |i: u32| {
            let root = f64::from(i) / f64::from(STOPS);
            Stop { at: root * root, color: [remap.alpha(root * root).clamp(0.0, 1.0); 3] }
        };
        let ramp = Ramp { input: Textured::Texture(texture.to_owned()), stops: (0..=STOPS).map(stop).collect() };
        let kind = if matches!(remap, Remap::Root) { "root" } else { "alpha" };
        let key = format!("{kind} of {texture}");
        if let Some(Textured::Texture(known)) = self.known_textures.get(&key) {
            return known.clone();
        }
        let name = self.add_texture(&format!("{texture} {kind}"), ramp);
        self.known_textures.insert(key, Textured::Texture(name.clone()));
        name
    }
}

impl Facets {
    /// Widths along u and v as a width and an anisotropy a: α_u = α √(2/(1 + (1 − a)²)) and α_v = (1 − a) α_u.
    fn of(u: f64, v: f64) -> Facets {
        let (long, short) = (u.max(v), u.min(v));
        let anisotropy = if long > 0.0 { 1.0 - short / long } else { 0.0 };
        let alpha = if long == short { long } else { (0.5 * (long * long + short * short)).sqrt() };
        let tangent_rotation = if v > u { 90.0 } else { 0.0 };
        Facets { roughness: Roughness::Alpha(Textured::Constant(alpha)), anisotropy, tangent_rotation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_of_pbrt_3_are_those_of_its_fit() {
        // Its tabulated values; x is ln 0.1 and ln 1.
        assert!((Remap::Old.alpha(0.1) - 0.4622).abs() < 1e-3, "{}", Remap::Old.alpha(0.1));
        assert!(Remap::Old.alpha(1.0) == 1.62142 && Remap::Root.alpha(0.25) == 0.5 && Remap::None.alpha(0.25) == 0.25);
    }

    #[test]
    fn widths_come_back_from_their_anisotropy() {
        let Facets { roughness, anisotropy: a, tangent_rotation } = Facets::of(0.1, 0.4);
        let Roughness::Alpha(Textured::Constant(alpha)) = roughness else { panic!("a constant") };
        let long = alpha * (2.0 / (1.0 + (1.0 - a) * (1.0 - a))).sqrt();
        assert!((long - 0.4).abs() < 1e-12 && ((1.0 - a) * long - 0.1).abs() < 1e-12 && tangent_rotation == 90.0);
    }
}
