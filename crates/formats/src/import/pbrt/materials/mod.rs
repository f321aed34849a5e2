//! Materials.
//!
//! | materials | file |
//! |---|---|
//! | `diffuse`, `diffusetransmission`, `dielectric`, `thindielectric`, `interface`, `mix` | `plain.rs` |
//! | `conductor` | `metals.rs` |
//! | `coateddiffuse`, `coatedconductor` | `coated.rs` |
//! | `subsurface`, `hair`, `measured` | `substitutes.rs` |
//! | those of pbrt-v3 | `old.rs` |
mod coated;
mod metals;
mod old;
mod plain;
mod roughness;
mod substitutes;

use std::rc::Rc;

use super::{
    import::Import,
    parameters::{Entity, Type},
    records::MaterialRef,
    source::TextSpan,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::null::Null,
    scene::{
        SceneError,
        description::{Bump, Material, MaterialDescription},
    },
};

impl Import {
    /// `Material`.
    pub fn declare_material(&mut self, entity: Rc<Entity>) -> MaterialRef {
        self.materials.push(entity);
        MaterialRef::Numbered(self.materials.len() - 1)
    }

    /// `MakeNamedMaterial`.
    pub fn declare_named_material(&mut self, entity: Rc<Entity>) {
        self.named_materials.insert(entity.kind.clone(), self.materials.len());
        self.materials.push(entity);
    }

    /// The name of a material in the description; it is translated when it is used first.
    pub fn material(
        &mut self,
        material: &MaterialRef,
        opacity: Option<&Textured<f64>>,
        place: &TextSpan,
    ) -> Result<String, SceneError> {
        let number = match material {
            MaterialRef::Default => None,
            MaterialRef::Numbered(number) => Some(*number),
            MaterialRef::Named(name) => {
                let unknown = || place.error(format!("`{name}` is not a material"), "define it by MakeNamedMaterial");
                Some(*self.named_materials.get(&**name).ok_or_else(unknown)?)
            }
        };
        let key = (number.map_or(0, |number| number + 1), format!("{opacity:?}"));
        if let Some(known) = self.known_materials.get(&key) {
            return Ok(known.clone());
        }
        let entity = number.map(|number| self.materials[number].clone());
        let (wanted, description) = match &entity {
            None => ("default".to_owned(), MaterialDescription { kind: plain::grey(0.5), ..MaterialDescription::default() }),
            Some(entity) => {
                let is_named = entity.directive == "MakeNamedMaterial";
                let kind = kind_of(entity);
                let name = if is_named { entity.kind.clone() } else { kind.clone() };
                let key = format!("material `{name}` of line {}", entity.place.line);
                (name, self.nested(&key, &entity.place, |import| import.translated(entity, &kind))?)
            }
        };
        let name = self.material_names.unique(&wanted, "material");
        let description = match description.kind {
            Material::Null(_) => description,
            _ => MaterialDescription { opacity: opacity.cloned().or(description.opacity), ..description },
        };
        self.description.materials.insert(name.clone(), description);
        self.known_materials.insert(key, name.clone());
        Ok(name)
    }

    fn translated(&mut self, entity: &Entity, kind: &str) -> Result<MaterialDescription, SceneError> {
        entity.ignore(&["type"]);
        let kind_name = kind;
        let kind = match kind {
            "diffuse" => self.diffuse(entity),
            "conductor" => self.conductor(entity),
            "dielectric" => self.dielectric(entity),
            "thindielectric" => self.thin_dielectric(entity),
            "coateddiffuse" => self.coated_diffuse(entity),
            "coatedconductor" => self.coated_conductor(entity),
            "diffusetransmission" => self.diffuse_transmission(entity),
            "mix" => self.mix(entity),
            "interface" | "none" | "" => Ok(Null.into()),
            "subsurface" => self.subsurface(entity),
            "hair" => self.hair(entity),
            "measured" => self.measured(entity),
            other => match self.old_material(entity, other) {
                Some(kind) => kind,
                None => {
                    let label = "such as diffuse, conductor or dielectric";
                    return Err(entity.error(format!("`{other}` is not a material of pbrt-v4 or pbrt-v3"), label));
                }
            },
        }?;
        let opacity = self.old_opacity(entity, kind_name)?;
        let bump = self.bump(entity)?;
        let normal_map = self.part(|import| import.file(entity, "normalmap"))?.flatten();
        let normal_map = normal_map.map(|path| self.files.folder.described(&path));
        self.remark_unused(entity);
        Ok(MaterialDescription { kind, bump, normal_map, opacity, ..MaterialDescription::default() })
    }

    /// `displacement`, which tilts normals in pbrt too; `bumpmap` in pbrt-v3.
    fn bump(&mut self, entity: &Entity) -> Result<Option<Bump>, SceneError> {
        let name = entity.named(&["displacement", "bumpmap"]);
        if !entity.has(name) {
            return Ok(None);
        }
        Ok(match self.number_or_texture(entity, name, 0.0)? {
            Textured::Constant(_) => None,
            Textured::Texture(texture) => Some(Bump { texture, height: 1.0 }),
        })
    }
}

/// The kind of a material, which named ones have as a parameter.
fn kind_of(entity: &Entity) -> String {
    match entity.directive {
        "MakeNamedMaterial" => entity.find(&[Type::String], "type").and_then(|t| t.text()).unwrap_or_default().to_owned(),
        _ => entity.kind.clone(),
    }
}
