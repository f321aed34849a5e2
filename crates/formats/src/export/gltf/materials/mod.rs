//! Materials: everything becomes `principled`, which is written as the metallic-roughness model with extensions.
//!
//! | file | holds |
//! |---|---|
//! | `kinds.rs`, `disney.rs` | each kind as `principled` |
//! | `base.rs` | colour, opacity, metal, roughness and interface |
//! | `layers.rs` | transmission, coat, sheen, thin film and anisotropy |
//! | `light.rs` | emission, sides, bumps |
mod base;
mod disney;
mod kinds;
mod layers;
mod light;

use serde_json::{Map, Value, json};

use super::{super::ExportError, context::Export, known::Made};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Lambertian, Material},
    scene::description::{EmissionDescription, MaterialDescription, ObjectDescription},
};

/// Blends within blends.
const DEEPEST: usize = 16;

/// The parts of a material of the file.
#[derive(Default)]
struct MaterialParts {
    material: Map<String, Value>,
    pbr: Map<String, Value>,
}

impl MaterialParts {
    /// Sets a member of a table, unless it is absent.
    fn set(table: &mut Map<String, Value>, key: &str, value: Option<Value>) {
        table.extend(value.map(|value| (key.to_owned(), value)));
    }
}

impl Export<'_> {
    /// The material of an object with its emission; black without one. The back of a closed shape cannot be seen.
    pub fn surface(&mut self, object: &ObjectDescription, is_closed: bool) -> Result<Made, ExportError> {
        let name = object.material.as_deref();
        let emission = object.emission.as_ref().filter(|emission| !light::is_dark(emission));
        let (description, name) = match name.and_then(|name| Some((self.description.materials.get(name)?, name))) {
            Some((description, name)) => (self.unblended(description), name),
            None => {
                let black = Lambertian { albedo: Textured::grey(0.0) };
                (MaterialDescription { kind: black.into(), ..MaterialDescription::default() }, "")
            }
        };
        let key = format!("{name} {emission:?}");
        let sides = emission.map(|emission| self.sides(&description, emission, is_closed || name.is_empty()));
        if let Some(made) = self.materials.get(&key) {
            return Ok(*made);
        }
        let made = self.at(format!("materials.{name}"), |export| export.material(name, &description, emission, sides))?;
        self.materials.insert(key, made);
        Ok(made)
    }

    /// The material that stands for a blend: the one that is met more often.
    fn unblended(&self, description: &MaterialDescription) -> MaterialDescription {
        let mut found = description.clone();
        for _ in 0..DEEPEST {
            let Material::Blend(blend) = &found.kind else { break };
            let weight = self.colors.mean_number(&blend.weight);
            let chosen = if weight > 0.5 && !blend.by_side { &blend.second } else { &blend.first };
            let part = self.description.materials.get(chosen).cloned().unwrap_or_default();
            found = MaterialDescription {
                two_sided: found.two_sided.filter(|two_sided| !two_sided).or(part.two_sided),
                opacity: found.opacity.or(part.opacity),
                ..part
            };
        }
        found
    }

    fn material(
        &mut self,
        name: &str,
        description: &MaterialDescription,
        emission: Option<&EmissionDescription>,
        sides: Option<bool>,
    ) -> Result<Made, ExportError> {
        let mut parts = MaterialParts::default();
        self.uses_coordinates = false;
        if self.description.materials.get(name).is_some_and(|material| matches!(material.kind, Material::Blend(_))) {
            self.remark("a `blend`", "the material that is met more often", "the other one is missing");
        }
        let name = self.names.unique(name, "no material");
        parts.material.insert("name".to_owned(), json!(name));
        let principled = self.principled(&description.kind);
        let colors = self.base(&mut parts, description, &principled)?;
        let normals = self.bumps(&mut parts, description)?;
        self.layers(&mut parts, &principled, normals)?;
        self.list_differences(&principled);
        if let Some(emission) = emission {
            self.emission(&mut parts, emission)?;
        }
        if sides.unwrap_or(description.two_sided != Some(false)) {
            parts.material.insert("doubleSided".to_owned(), json!(true));
        }
        let MaterialParts { mut material, pbr } = parts;
        material.insert("pbrMetallicRoughness".to_owned(), Value::Object(pbr));
        let index = self.document.add("materials", Value::Object(material));
        Ok(Made { index, colors, uses_coordinates: self.uses_coordinates })
    }
}
