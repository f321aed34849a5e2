//! Parameters of directives, and lookups by their names.
use std::{cell::Cell, collections::HashSet, rc::Rc};

use glam::DVec3;

use super::{colour_spaces::ColourSpace, source::TextSpan};
use noisefall_scene::scene::SceneError;

/// The type of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Float,
    Integer,
    /// Two numbers: `point2`, `vector2`.
    Pair,
    /// Three numbers: `point3`, `vector3`, `normal`.
    Triple,
    Rgb,
    Spectrum,
    Blackbody,
    String,
    Texture,
    Bool,
}

/// The values of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    Numbers(Vec<f64>),
    Texts(Vec<String>),
    Flags(Vec<bool>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Values::Numbers(numbers) => numbers.len(),
            Values::Texts(texts) => texts.len(),
            Values::Flags(flags) => flags.len(),
        }
    }
}

/// A parameter of a file.
#[derive(Clone, Debug)]
pub struct Parameter {
    pub of_type: Type,
    pub name: String,
    pub values: Values,
    pub place: TextSpan,
    /// The colour space of the file at this place.
    pub space: ColourSpace,
    used: Cell<bool>,
}

/// A directive with its parameters, such as a shape.
#[derive(Clone, Debug)]
pub struct Entity {
    /// The directive: `Shape`.
    pub directive: &'static str,
    /// The kind: `sphere`.
    pub kind: String,
    pub place: TextSpan,
    own: Vec<Parameter>,
    /// Parameters by `Attribute`, the first one last.
    inherited: Rc<[Parameter]>,
}

impl Entity {
    /// A directive with the parameters that follow it, each with a name of its own.
    pub fn new(
        directive: &'static str,
        kind: String,
        place: TextSpan,
        own: Vec<Parameter>,
        inherited: Rc<[Parameter]>,
    ) -> Entity {
        Entity { directive, kind, place, own, inherited }
    }

    /// The first of these names that a parameter has, or else the first name: names change from version to version.
    pub fn named<'n>(&self, names: &[&'n str]) -> &'n str {
        names.iter().find(|name| self.has(name)).unwrap_or(&names[0])
    }

    /// The directive and its kind, as in the file.
    pub fn shown(&self) -> String {
        format!("{} \"{}\"", self.directive, self.kind)
    }

    /// The parameter with one of these types, which is used now.
    pub fn find(&self, types: &[Type], name: &str) -> Option<&Parameter> {
        let fits = |parameter: &&Parameter| parameter.name == name && types.contains(&parameter.of_type);
        let found = self.own.iter().find(fits).or_else(|| self.inherited.iter().rev().find(fits))?;
        found.used.set(true);
        Some(found)
    }

    /// Whether there is a parameter with this name.
    pub fn has(&self, name: &str) -> bool {
        self.own.iter().chain(self.inherited.iter()).any(|parameter| parameter.name == name)
    }

    /// Marks parameters that do not change what the image converges to.
    pub fn ignore(&self, names: &[&str]) {
        self.own
            .iter()
            .filter(|parameter| names.contains(&parameter.name.as_str()))
            .for_each(|parameter| parameter.used.set(true));
    }

    /// The parameters of its own that nothing has used.
    pub fn unused(&self) -> impl Iterator<Item = &Parameter> {
        self.own.iter().filter(|parameter| !parameter.used.get())
    }

    /// A number, or the default.
    pub fn float(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        self.optional_float(name).map(|number| number.unwrap_or(default))
    }

    /// A number, if it is given.
    pub fn optional_float(&self, name: &str) -> Result<Option<f64>, SceneError> {
        self.find(&[Type::Float, Type::Integer], name).map(|parameter| parameter.numbers(1).map(|numbers| numbers[0])).transpose()
    }

    /// A whole number, or the default.
    pub fn integer(&self, name: &str, default: i64) -> Result<i64, SceneError> {
        let Some(parameter) = self.find(&[Type::Integer, Type::Float], name) else { return Ok(default) };
        parameter.numbers(1).map(|numbers| numbers[0] as i64)
    }

    /// A flag, or the default.
    pub fn flag(&self, name: &str, default: bool) -> Result<bool, SceneError> {
        match self.find(&[Type::Bool], name).map(|parameter| (&parameter.values, parameter)) {
            None => Ok(default),
            Some((Values::Flags(flags), _)) if !flags.is_empty() => Ok(flags[0]),
            Some((_, parameter)) => Err(parameter.error("expected true or false")),
        }
    }

    /// A text, if it is given.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.find(&[Type::String], name)?.text()
    }

    /// Numbers of any count, if they are given.
    pub fn list(&self, name: &str) -> Option<&[f64]> {
        let parameter = self.find(&[Type::Float, Type::Integer, Type::Pair, Type::Triple], name)?;
        match &parameter.values {
            Values::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }

    /// A point or a direction, or the default.
    pub fn triple(&self, name: &str, default: DVec3) -> Result<DVec3, SceneError> {
        let Some(parameter) = self.find(&[Type::Triple], name) else { return Ok(default) };
        parameter.numbers(3).map(|n| DVec3::new(n[0], n[1], n[2]))
    }

    /// An error at the directive.
    pub fn error(&self, message: impl Into<String>, label: impl Into<String>) -> SceneError {
        self.place.error(message, label)
    }
}

impl Parameter {
    /// A parameter that nothing has used yet.
    pub fn new(of_type: Type, name: &str, values: Values, place: TextSpan, space: ColourSpace) -> Parameter {
        Parameter { of_type, name: name.to_owned(), values, place, space, used: Cell::new(false) }
    }

    /// The first text.
    pub fn text(&self) -> Option<&str> {
        match &self.values {
            Values::Texts(texts) => texts.first().map(String::as_str),
            _ => None,
        }
    }

    /// The numbers, if there are at least this many.
    pub fn numbers(&self, least: usize) -> Result<&[f64], SceneError> {
        match &self.values {
            Values::Numbers(numbers) if numbers.len() >= least => Ok(numbers),
            _ if least == 1 => Err(self.error("expected a number")),
            _ => Err(self.error(&format!("expected {least} numbers"))),
        }
    }

    /// Keeps the last parameter of each name, as pbrt does, and returns the others.
    pub fn keep_last(parameters: &mut Vec<Parameter>) -> Vec<Parameter> {
        let mut names = HashSet::new();
        let is_last: Vec<bool> = parameters.iter().rev().map(|parameter| names.insert(parameter.name.clone())).collect();
        let mut is_last = is_last.into_iter().rev();
        parameters.extract_if(.., |_| is_last.next() == Some(false)).collect()
    }

    /// An error at the parameter.
    pub fn error(&self, label: &str) -> SceneError {
        self.place.error(format!("`{}` has the wrong values", self.name), label)
    }
}
