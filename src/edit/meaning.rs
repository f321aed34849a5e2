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
struct Found {
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
        // The colours of a texture are not known here.
        let is_texture = matches!(value, OwnedValue::Textured(Textured::Texture(_)));
        _ = set(&mut changed, path, if is_texture { &WHITE } else { value });
    }
    // A sheet scatters to both sides: half of a bright colour leaves room for the other side. A texture cannot be halved.
    if changed.kind.check().is_err() {
        all.retain(|(_, value)| !matches!(value, OwnedValue::Textured(Textured::Texture(_))));
        for (_, value) in &mut all {
            if let OwnedValue::Textured(Textured::Constant(rgb)) = value {
                *rgb = rgb.map(|x| 0.5 * x);
            }
        }
    }
    all
}

impl Found {
    /// The value of another one as this one stores it.
    fn takes(&self, other: &Found) -> Option<OwnedValue> {
        let is_alpha = |found: &Found| matches!(found.path.0.last(), Some(Step::Key(key)) if key == ALPHA);
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

const WHITE: OwnedValue = OwnedValue::Textured(Textured::Constant([1.0; 3]));

/// The key of the width of slopes, the square of a roughness.
const ALPHA: &str = "alpha";

/// The first value of a meaning.
fn first(material: &mut MaterialDescription, meaning: Meaning) -> Option<Found> {
    let mut finder = Finder { meaning, tables: vec![Path::default()], found: None };
    material.parameters(&mut finder);
    finder.found
}

struct Finder {
    meaning: Meaning,
    /// The paths of the tables around the current value.
    tables: Vec<Path>,
    found: Option<Found>,
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
            self.found.get_or_insert_with(|| Found { path: table.key(parameter.key), value: OwnedValue::of(&value), range });
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
