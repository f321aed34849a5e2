//! Materials without counterpart, and their substitutes.
use super::plain::grey;
use crate::import::pbrt::{import::Import, parameters::Entity, spectra::Role};
use noisefall_scene::{
    material::{Lambertian, Plastic},
    scene::{SceneError, description::Material},
};

/// Brown hair.
const HAIR: [f64; 3] = [0.17, 0.09, 0.045];

impl Import {
    pub(super) fn subsurface(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let albedo = self.colour(entity, "reflectance", [0.8; 3], Role::Reflectance)?;
        let ior = self.index(entity, "eta", 1.33)?;
        let roughness = self.facets(entity, "", 0.0)?.roughness;
        entity.ignore(&["sigma_a", "sigma_s", "mfp", "g", "scale", "name"]);
        self.remark(entity, "plastic", "light does not enter below the surface");
        Ok(Plastic { albedo, ior: ior.max(1.0), roughness }.into())
    }

    pub(super) fn hair(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let name = if entity.has("color") { "color" } else { "reflectance" };
        let albedo = self.colour(entity, name, HAIR, Role::Reflectance)?;
        entity.ignore(&["sigma_a", "eumelanin", "pheomelanin", "eta", "beta_m", "beta_n", "alpha", "reflectance"]);
        self.remark(entity, "a diffuse surface", "hair has no highlights and does not let light through");
        Ok(Lambertian { albedo }.into())
    }

    pub(super) fn measured(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        entity.ignore(&["filename"]);
        self.remark(entity, "a grey diffuse surface", "the measured reflectance is not shown");
        Ok(grey(0.5))
    }
}
