//! Values of a material by their declared meaning, whatever its kind calls them.
use super::{choose::choose, set::set};
use noisefall_base::declare::{Declare, Form, Meaning, OneOf, OwnedValue, Parameter, Parameters, Path, Range, Textured, Value};
use noisefall_scene::{material::Material, scene::description::MaterialDescription};

/// Meanings of which a kind has one at most.
const COLOUR: &[Meaning] = &[Meaning::Colour];
const ROUGHNESS: &[Meaning] = &[Meaning::Roughness, Meaning::SlopeWidth];
const INDEX: &[Meaning] = &[Meaning::IndexOfRefraction];

/// A value, its path in the material, its parameter, and its range.
struct FoundValue {
    path: Path,
    value: OwnedValue,
    parameter: Parameter,
    range: Range,
}

/// The path of the colour of a material, or else of the first colour that can be a texture, such as that of a pane. `None` if it has none.
pub fn colour(material: &MaterialDescription) -> Option<Path> {
    let mut material = material.clone();
    let is_meant = |parameter: &Parameter, _: &Value<'_>| parameter.meaning == Some(Meaning::Colour);
    let is_colour = |_: &Parameter, value: &Value<'_>| matches!(value, Value::Textured(..));
    let found = found(&mut material, &is_meant).or_else(|| found(&mut material, &is_colour));
    found.map(|found| found.path)
}

/// Returns the values that a material would lose by a change of type since the new type has other keys for them, and the new paths.
pub fn kept_by_kind(material: &MaterialDescription, kind: &str) -> Vec<(Path, OwnedValue)> {
    let mut changed = material.clone();
    choose(&mut changed, &Path::default(), Material::WHAT, kind);
    let kept = |meanings| {
        let (before, after) = (of_meaning(&mut material.clone(), meanings)?, of_meaning(&mut changed.clone(), meanings)?);
        let has_other_key = before.parameter.key != after.parameter.key;
        has_other_key.then(|| after.takes(&before)).flatten().map(|value| (after.path, value))
    };
    let mut all: Vec<_> = [COLOUR, ROUGHNESS, INDEX].into_iter().filter_map(kept).collect();
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
    let FoundValue { path, value, .. } = of_meaning(material, COLOUR)?;
    let rgb = if let OwnedValue::Textured(Textured::Constant(rgb)) = value { rgb } else { [1.0; 3] };
    let constant = |rgb| OwnedValue::Textured(Textured::Constant(rgb));
    _ = set(material, &path, &constant(rgb));
    material.kind.check().is_err().then(|| (path, constant(rgb.map(|x| 0.5 * x))))
}

impl FoundValue {
    /// The value of another one as this one stores it.
    fn takes(&self, other: &FoundValue) -> Option<OwnedValue> {
        let is_alpha = |found: &FoundValue| found.parameter.meaning == Some(Meaning::SlopeWidth);
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

/// The first value of one of these meanings.
fn of_meaning(material: &mut MaterialDescription, meanings: &[Meaning]) -> Option<FoundValue> {
    found(material, &|parameter, _| parameter.meaning.is_some_and(|meaning| meanings.contains(&meaning)))
}

type IsMeant<'a> = dyn Fn(&Parameter, &Value<'_>) -> bool + 'a;

/// The first value that is meant.
fn found(material: &mut MaterialDescription, is_meant: &IsMeant<'_>) -> Option<FoundValue> {
    let mut finder = Finder { is_meant, tables: vec![Path::default()], found: None };
    material.parameters(&mut finder);
    finder.found
}

struct Finder<'a> {
    is_meant: &'a IsMeant<'a>,
    /// The paths of the tables around the current value.
    tables: Vec<Path>,
    found: Option<FoundValue>,
}

impl Parameters for Finder<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let range = match &value {
            Value::Textured(_, range) | Value::TexturedNumber(_, range) | Value::Number(_, range) => *range,
            _ => return,
        };
        if self.found.is_none()
            && (self.is_meant)(parameter, &value)
            && let Some(table) = self.tables.last()
        {
            let (path, value) = (table.key(parameter.key), OwnedValue::of(&value));
            self.found = Some(FoundValue { path, value, parameter: *parameter, range });
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
