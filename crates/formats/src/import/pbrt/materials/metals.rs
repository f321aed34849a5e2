//! Metals.
use super::roughness::Facets;
use crate::import::pbrt::{
    import::Import,
    named_spectra,
    parameters::{Entity, Type},
    spectra::Role,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Conductor, Reflectance},
    scene::{SceneError, description::Material},
};

/// A metal is black without this index, and reflectances of 1 have none.
const MOST_REFLECTANCE: f64 = 0.9999;

impl Import {
    pub(super) fn conductor(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let fresnel = self.fresnel(entity, "")?;
        let Facets { roughness, anisotropy, tangent_rotation } = self.facets(entity, "", 0.0)?;
        Ok(Conductor { fresnel, roughness, anisotropy, tangent_rotation, energy_compensation: false, ..Conductor::default() }
            .into())
    }

    /// Copper, η and k, or the reflectance at normal incidence.
    pub(super) fn fresnel(&mut self, entity: &Entity, prefix: &str) -> Result<Reflectance, SceneError> {
        let reflectance = ["reflectance".to_owned(), format!("{prefix}reflectance")].into_iter().find(|name| entity.has(name));
        let [eta, k] = [
            self.spectrum(entity, &format!("{prefix}eta"), "metal-Cu-eta")?,
            self.spectrum(entity, &format!("{prefix}k"), "metal-Cu-k")?,
        ];
        let Some(reflectance) = reflectance else { return Ok(Reflectance::Index { eta, k, tint: Textured::grey(1.0) }) };
        match self.colour(entity, &reflectance, [0.5; 3], Role::Reflectance)? {
            // pbrt chooses the k that has this reflectance with η = 1.
            Textured::Constant(r) => {
                let k = r.map(|r| r.clamp(0.0, MOST_REFLECTANCE)).map(|r| 2.0 * r.sqrt() / (1.0 - r).sqrt());
                Ok(Reflectance::Index { eta: [1.0; 3], k, tint: Textured::grey(1.0) })
            }
            texture => {
                self.remark(entity, "Schlick's approximation of its textured reflectance", "it differs at grazing angles");
                Ok(Reflectance::Schlick(texture))
            }
        }
    }

    /// η or k per channel.
    fn spectrum(&mut self, entity: &Entity, name: &str, default: &str) -> Result<[f64; 3], SceneError> {
        let copper = named_spectra::metal(default).unwrap_or([1.0; 3]);
        if entity.find(&[Type::Texture], name).is_some() {
            let found = self.colour(entity, name, copper, Role::Unbounded)?;
            if let Textured::Constant(constant) = found {
                return Ok(constant.map(|x| x.clamp(0.0, 1e3)));
            }
            self.remark_parameter(entity, name, "that of copper", "the metal has the same colour everywhere");
            return Ok(copper);
        }
        let given = match entity.optional_float(name)? {
            Some(number) => Some([number; 3]),
            None => self.constant_colour(entity, name, Role::Unbounded)?,
        };
        Ok(given.unwrap_or(copper).map(|x| x.clamp(0.0, 1e3)))
    }
}

/// The reflectance at normal incidence, seen from a medium of an index.
pub fn head_on(fresnel: &Reflectance, outside: f64) -> Textured {
    match fresnel {
        Reflectance::Index { eta, k, .. } => Textured::Constant([0, 1, 2].map(|channel| {
            let (eta, square) = (eta[channel] / outside, (k[channel] / outside).powi(2));
            ((eta - 1.0).powi(2) + square) / ((eta + 1.0).powi(2) + square)
        })),
        Reflectance::Schlick(colour) | Reflectance::Constant(colour) => colour.clone(),
    }
}
