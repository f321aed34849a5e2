//! Values of a material by their meaning, whatever its kind calls them.
use super::{choose::choose, set::set};
use crate::{
    declare::{Declare, Form, OneOf, OwnedValue, Parameter, Parameters, Path, Range, Step, Textured, Value},
    material::Material,
    scene::description::MaterialDescription,
};

/// A value that several kinds have under different keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    /// The first colour that can be a texture.
    Colour,
    Roughness,
    IndexOfRefraction,
}

/// A value, its path in the material, and its range.
struct FoundValue {
    path: Path,
    value: OwnedValue,
    range: Range,
}

/// The path of the first colour of a material that can be a texture. `None` if it has none.
pub fn colour(material: &MaterialDescription) -> Option<Path> {
    first(&mut material.clone(), Meaning::Colour).map(|found| found.path)
}

/// What a material had before a change of kind that would lose it because the new kind has another key for it, and the new paths.
pub fn kept_by_kind(material: &MaterialDescription, kind: &str) -> Vec<(Path, OwnedValue)> {
    let mut changed = material.clone();
    choose(&mut changed, &Path::default(), Material::WHAT, kind);
    let kept = |meaning| {
        let (before, after) = (first(&mut material.clone(), meaning)?, first(&mut changed.clone(), meaning)?);
        let has_other_key = before.path.0.last() != after.path.0.last();
        has_other_key.then(|| after.takes(&before)).flatten().map(|value| (after.path, value))
    };
    let mut all: Vec<_> =
        [Meaning::Colour, Meaning::Roughness, Meaning::IndexOfRefraction].into_iter().filter_map(kept).collect();
    for (path, value) in &all {
        _ = set(&mut changed, path, value);
    }
    if let Some((path, value)) = halved_colour(&mut changed) {
        all.retain(|(other, _)| *other != path);
        all.push((path, value));
    }
    all
}

/// Half of the colour, if the kind cannot have all of it: a sheet scatters to both sides. A texture, whose colours are not known here,
/// counts as white.
fn halved_colour(material: &mut MaterialDescription) -> Option<(Path, OwnedValue)> {
    let FoundValue { path, value, .. } = first(material, Meaning::Colour)?;
    let rgb = if let OwnedValue::Textured(Textured::Constant(rgb)) = value { rgb } else { [1.0; 3] };
    let constant = |rgb| OwnedValue::Textured(Textured::Constant(rgb));
    _ = set(material, &path, &constant(rgb));
    material.kind.check().is_err().then(|| (path, constant(rgb.map(|x| 0.5 * x))))
}

impl FoundValue {
    /// The value of another one as this one stores it.
    fn takes(&self, other: &FoundValue) -> Option<OwnedValue> {
        let is_alpha = |found: &FoundValue| matches!(found.path.0.last(), Some(Step::Key(key)) if key == ALPHA);
        let within = |x: f64| x.clamp(self.range.least, self.range.most);
        match (&other.value, &self.value) {
            (OwnedValue::TexturedNumber(Textured::Constant(x)), OwnedValue::TexturedNumber(_)) => {
                let x = match (is_alpha(other), is_alpha(self)) {
                    (true, false) => x.sqrt(),
                    (false, true) => x * x,
                    _ => *x,
                };
                Some(OwnedValue::TexturedNumber(Textured::Constant(within(x))))
            }
            (OwnedValue::TexturedNumber(_), OwnedValue::TexturedNumber(_)) => {
                (is_alpha(other) == is_alpha(self)).then(|| other.value.clone())
            }
            (OwnedValue::Number(x), OwnedValue::Number(_)) => Some(OwnedValue::Number(within(*x))),
            (OwnedValue::Textured(_), OwnedValue::Textured(_)) => Some(other.value.clone()),
            _ => None,
        }
    }
}

/// The key of the width of slopes, the square of a roughness.
const ALPHA: &str = "alpha";

/// The first value of a meaning.
fn first(material: &mut MaterialDescription, meaning: Meaning) -> Option<FoundValue> {
    let mut finder = Finder { meaning, tables: vec![Path::default()], found: None };
    material.parameters(&mut finder);
    finder.found
}

struct Finder {
    meaning: Meaning,
    /// The paths of the tables around the current value.
    tables: Vec<Path>,
    found: Option<FoundValue>,
}

impl Finder {
    fn is_meant(&self, key: &str, value: &Value<'_>) -> bool {
        match self.meaning {
            Meaning::Colour => matches!(value, Value::Textured(..)),
            Meaning::Roughness => {
                matches!(value, Value::TexturedNumber(..)) && ["roughness", ALPHA, "specular_roughness"].contains(&key)
            }
            Meaning::IndexOfRefraction => matches!(value, Value::Number(..)) && ["ior", "specular_ior"].contains(&key),
        }
    }
}

impl Parameters for Finder {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let range = match &value {
            Value::Textured(_, range) | Value::TexturedNumber(_, range) | Value::Number(_, range) => *range,
            _ => return,
        };
        if self.is_meant(parameter.key, &value)
            && let Some(table) = self.tables.last()
        {
            self.found.get_or_insert_with(|| FoundValue { path: table.key(parameter.key), value: OwnedValue::of(&value), range });
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
