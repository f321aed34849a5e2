//! The colour of a material, whatever its kind calls it.
use super::{Document, choose::choose};
use crate::{
    declare::{Declare, Form, OneOf, OwnedValue, Parameter, Parameters, Path, Value},
    material::Material,
    scene::description::MaterialDescription,
};

impl Document {
    /// The path of the first colour of a material that can be a texture, such as its albedo. `None` if it has none.
    pub fn colour_of_material(&self, name: &str) -> Option<Path> {
        let (colour, _) = first_colour(&mut self.description().materials.get(name)?.clone())?;
        Some(Path(Path::of("materials").key(name).0.into_iter().chain(colour.0).collect()))
    }
}

/// Where a material keeps its colour, and the colour, after a change of kind that would lose it because the new kind has another key.
pub fn colour_of_kind(material: &MaterialDescription, kind: &str) -> Option<(Path, OwnedValue)> {
    let (before, colour) = first_colour(&mut material.clone())?;
    let mut changed = material.clone();
    choose(&mut changed, &Path::default(), Material::WHAT, kind);
    let (after, _) = first_colour(&mut changed)?;
    (before.0.last() != after.0.last()).then_some((after, colour))
}

/// The first colour that can be a texture, and its path in the material.
fn first_colour(material: &mut MaterialDescription) -> Option<(Path, OwnedValue)> {
    let mut finder = Finder { tables: vec![Path::default()], found: None };
    material.parameters(&mut finder);
    finder.found
}

struct Finder {
    /// The paths of the tables around the current value.
    tables: Vec<Path>,
    found: Option<(Path, OwnedValue)>,
}

impl Parameters for Finder {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        if let (Value::Textured(..), Some(table)) = (&value, self.tables.last()) {
            self.found.get_or_insert_with(|| (table.key(parameter.key), OwnedValue::of(&value)));
        }
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        let inner = self.tables.last().map(|table| table.key(parameter.key));
        self.tables.extend(inner);
    }

    fn leave(&mut self) {
        self.tables.pop();
    }
}
