//! Materials with a clear coat.
use super::{metals::head_on, roughness::Facets};
use crate::import::pbrt::{import::Import, parameters::Entity, spectra::Role};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Plastic, Roughness, principled::Principled},
    scene::{SceneError, description::Material},
};

impl Import {
    /// Plastic: pbrt's walk between coat and base converges to it, if the coat is smooth and clear.
    pub(super) fn coated_diffuse(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let albedo = self.colour(entity, "reflectance", [0.5; 3], Role::Reflectance)?;
        let ior = self.index(entity, "eta", 1.5)?;
        let facets = self.facets(entity, "", 0.0)?;
        self.coat_medium(entity)?;
        if facets.anisotropy > 0.0 {
            self.remark(entity, "a coat with round highlights", "highlights are not stretched");
        }
        if facets.root() != Some(0.0) {
            let effect = "light that the rough coat refracts leaves the base evenly; the brightness differs by a few per cent";
            self.remark(entity, "plastic", effect);
        }
        Ok(Plastic { albedo, ior: ior.max(1.0), roughness: facets.roughness }.into())
    }

    /// OpenPBR: a metal under a coat.
    pub(super) fn coated_conductor(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let coat_ior = self.index(entity, "interface.eta", 1.5)?;
        let coat = self.facets(entity, "interface.", 0.0)?;
        let fresnel = self.fresnel(entity, "conductor.")?;
        let base = self.facets(entity, "conductor.", 0.0)?;
        self.coat_medium(entity)?;
        let effect = "OpenPBR computes reflections between coat and metal by a formula; colours at grazing angles differ";
        self.remark(entity, "principled: a metal under a coat", effect);
        let metal = Principled {
            base_color: head_on(&fresnel, coat_ior),
            base_metalness: Textured::Constant(1.0),
            coat_weight: Textured::Constant(1.0),
            coat_ior,
            specular_roughness: self.root(entity, &base),
            specular_roughness_anisotropy: Textured::Constant(base.anisotropy),
            tangent_rotation: base.tangent_rotation,
            coat_roughness: self.root(entity, &coat),
            ..Principled::default()
        };
        Ok(metal.into())
    }

    /// The square root of α. OpenPBR has no textures of α.
    fn root(&mut self, entity: &Entity, facets: &Facets) -> Textured<f64> {
        match (&facets.roughness, facets.root()) {
            (_, Some(root)) => Textured::Constant(root),
            (Roughness::Roughness(value), None) => value.clone(),
            (Roughness::Alpha(_), None) => {
                self.remark(entity, "a roughness of 0.3", "the roughness of the layer does not vary");
                Textured::Constant(0.3)
            }
        }
    }

    /// Checks the medium between coat and base.
    fn coat_medium(&mut self, entity: &Entity) -> Result<(), SceneError> {
        entity.ignore(&["thickness", "maxdepth", "nsamples", "g"]);
        let is_clear = match self.colour(entity, "albedo", [0.0; 3], Role::Reflectance)? {
            Textured::Constant(albedo) => albedo == [0.0; 3],
            Textured::Texture(_) => false,
        };
        if !is_clear {
            self.remark(entity, "a clear coat", "the coat does not scatter light");
        }
        Ok(())
    }
}
