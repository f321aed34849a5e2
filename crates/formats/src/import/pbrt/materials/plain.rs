//! Materials with an exact counterpart.
use std::rc::Rc;

use crate::import::{
    pbrt::{
        import::Import,
        parameters::{Entity, Type, Values},
        records::MaterialRef,
        spectra::{COLOURS, Role, luminance},
    },
    unit,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{
        Dielectric, Lambertian, blend::Blend, diffuse_transmission::DiffuseTransmission, thin_dielectric::ThinDielectric,
    },
    scene::{SceneError, description::Material},
};

/// By what a sheet of textures is darker, so that numbers of 32 bits stay below 1.
const ROUNDING: f64 = 1e-6;

/// A diffuse surface with the same albedo everywhere.
pub fn grey(albedo: f64) -> Material {
    Lambertian { albedo: Textured::grey(albedo) }.into()
}

impl Import {
    pub(super) fn diffuse(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let albedo = self.colour(entity, "reflectance", [0.5; 3], Role::Reflectance)?;
        self.remark_parameter(entity, "sigma", "a Lambertian surface", "it is a little darker at grazing angles");
        Ok(Lambertian { albedo }.into())
    }

    pub(super) fn diffuse_transmission(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let scale = entity.float("scale", 1.0)?;
        let part = |import: &mut Import, name: &str| {
            let colour = import.colour(entity, name, [0.25; 3], Role::Reflectance)?;
            import.scaled(&colour, scale, name)
        };
        let [reflectance, transmittance] = [part(self, "reflectance")?, part(self, "transmittance")?];
        self.sheet(entity, reflectance, transmittance)
    }

    /// A sheet that reflects and transmits diffusely, not more than it gets.
    pub(super) fn sheet(
        &mut self,
        entity: &Entity,
        reflectance: Textured,
        transmittance: Textured,
    ) -> Result<Material, SceneError> {
        let (description, assets, root) = (&self.description, &self.new_files.assets, self.files.folder.root());
        let [r, t] = [&reflectance, &transmittance].map(|part| match part {
            Textured::Constant(colour) => *colour,
            Textured::Texture(name) => unit::channels(description, assets, root, name),
        });
        let most = [0, 1, 2].map(|channel| r[channel] + t[channel]).into_iter().fold(0.0, f64::max);
        if most <= 1.0 {
            return Ok(DiffuseTransmission { reflectance, transmittance }.into());
        }
        self.remark(entity, "the same sheet without gain", "it is darker: it would reflect and transmit more than it gets");
        let part = |import: &mut Import, part: Textured| match part {
            Textured::Constant(colour) => Ok(Textured::Constant(colour.map(|x| x / most))),
            texture => import.scaled(&texture, (1.0 - ROUNDING) / most, "sheet"),
        };
        let (reflectance, transmittance) = (part(self, reflectance)?, part(self, transmittance)?);
        Ok(DiffuseTransmission { reflectance, transmittance }.into())
    }

    pub(super) fn dielectric(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        let ior = self.index(entity, "eta", 1.5)?;
        let facets = self.facets(entity, "", 0.0)?;
        let (anisotropy, tangent_rotation) = (facets.anisotropy, facets.tangent_rotation);
        let roughness = facets.roughness;
        Ok(Dielectric { ior, roughness, anisotropy, tangent_rotation, energy_compensation: false, ..Dielectric::default() }
            .into())
    }

    pub(super) fn thin_dielectric(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        Ok(ThinDielectric { ior: self.index(entity, "eta", 1.5)?, ..ThinDielectric::default() }.into())
    }

    /// An index of refraction that is the same for all wavelengths.
    pub(super) fn index(&mut self, entity: &Entity, name: &str, default: f64) -> Result<f64, SceneError> {
        let index = match entity.find(&COLOURS, name) {
            None if entity.find(&[Type::Texture], name).is_some() => {
                self.remark(entity, &format!("an index of {default}"), "the index does not vary");
                default
            }
            None => entity.float(name, default)?,
            Some(parameter) => {
                self.remark_parameter(entity, name, "its mean index", "light is not split into its colours");
                luminance(self.colour_of(parameter, Role::Unbounded)?)
            }
        };
        // An index of 0 is one of 1 in pbrt.
        let index = if index == 0.0 { 1.0 } else { index };
        Ok(index.clamp(0.05, 20.0))
    }

    /// A choice between two named materials.
    pub(super) fn mix(&mut self, entity: &Entity) -> Result<Material, SceneError> {
        if entity.has("namedmaterial1") {
            return self.old_mix(entity);
        }
        let names = entity.find(&[Type::String], "materials").map(|parameter| &parameter.values);
        let Some(Values::Texts(names)) = names.filter(|names| matches!(names, Values::Texts(names) if names.len() == 2)) else {
            return Err(entity.error("a mix has two materials", "`string materials` holds their names"));
        };
        let part = |import: &mut Import, name: &String| {
            let material = match name.as_str() {
                "interface" if !import.named_materials.contains_key(name) => return import.null_material(),
                _ => MaterialRef::Named(Rc::from(name.as_str())),
            };
            import.material(&material, None, &entity.place)
        };
        let [first, second] = [part(self, &names[0])?, part(self, &names[1])?];
        let weight = self.number_or_texture(entity, "amount", 0.5)?;
        let weight = self.part_of_whole(entity, weight);
        Ok(Blend { first, second, weight, ..Blend::default() }.into())
    }

    fn null_material(&mut self) -> Result<String, SceneError> {
        let name = self.material_names.unique("interface", "interface");
        let null = noisefall_scene::material::null::Null.into();
        self.description
            .materials
            .insert(name.clone(), noisefall_scene::scene::description::MaterialDescription { kind: null, ..Default::default() });
        Ok(name)
    }
}
