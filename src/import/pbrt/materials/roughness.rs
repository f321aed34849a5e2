//! Roughness: widths of the GGX distribution along u and v.
//!
//! Unless `remaproughness` is false, pbrt takes α = √roughness.
use crate::{
    declare::Textured,
    import::pbrt::{import::Import, parameters::Entity},
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

impl Import {
    /// The facets of an interface; `prefix` stands before the names of its parameters.
    pub(super) fn facets(&mut self, entity: &Entity, prefix: &str, default: f64) -> Result<Facets, SceneError> {
        let remap = entity.flag("remaproughness", true)?;
        let both = format!("{prefix}roughness");
        let [u, v] = ["u", "v"].map(|axis| format!("{prefix}{axis}roughness"));
        let [u, v] = [if entity.has(&u) { &u } else { &both }, if entity.has(&v) { &v } else { &both }];
        let widths = (self.number_or_texture(entity, u, default)?, self.number_or_texture(entity, v, default)?);
        match widths {
            (Textured::Constant(u), Textured::Constant(v)) => {
                let alpha = |roughness: f64| {
                    let width = if remap { roughness.max(0.0).sqrt() } else { roughness };
                    // pbrt takes narrower distributions as smooth.
                    if width < 1e-3 { 0.0 } else { width.min(1.0) }
                };
                Ok(Facets::of(alpha(u), alpha(v)))
            }
            (Textured::Texture(texture), other) => {
                if other != Textured::Texture(texture.clone()) {
                    self.remark(entity, "the roughness along u in all directions", "highlights are round");
                }
                self.textured_facets(texture, remap)
            }
            (_, Textured::Texture(texture)) => {
                self.remark(entity, "the roughness along v in all directions", "highlights are round");
                self.textured_facets(texture, remap)
            }
        }
    }

    fn textured_facets(&mut self, texture: String, remap: bool) -> Result<Facets, SceneError> {
        let alpha = if remap { self.root_of(&texture) } else { texture };
        Ok(Facets { roughness: Roughness::Alpha(Textured::Texture(alpha)), anisotropy: 0.0, tangent_rotation: 0.0 })
    }

    /// A texture whose values are the square roots of those of another.
    fn root_of(&mut self, texture: &str) -> String {
        /// The error of the root is at most 1/256 near 0.
        const STOPS: u32 = 64;
        let stop = |i: u32| {
            let root = f64::from(i) / f64::from(STOPS);
            Stop { at: root * root, color: [root; 3] }
        };
        let ramp = Ramp { input: Textured::Texture(texture.to_owned()), stops: (0..=STOPS).map(stop).collect() };
        let key = format!("root of {texture}");
        if let Some(Textured::Texture(known)) = self.known_textures.get(&key) {
            return known.clone();
        }
        let name = self.add_texture(&format!("{texture} root"), ramp);
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
    fn widths_come_back_from_their_anisotropy() {
        let Facets { roughness, anisotropy: a, tangent_rotation } = Facets::of(0.1, 0.4);
        let Roughness::Alpha(Textured::Constant(alpha)) = roughness else { panic!("a constant") };
        let long = alpha * (2.0 / (1.0 + (1.0 - a) * (1.0 - a))).sqrt();
        assert!((long - 0.4).abs() < 1e-12 && ((1.0 - a) * long - 0.1).abs() < 1e-12 && tangent_rotation == 90.0);
    }
}
