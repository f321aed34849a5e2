//! Lists of parameters: `"type name" [ values ]`.
use std::{cell::Cell, rc::Rc};

use glam::DVec3;

use super::{
    colour_spaces::ColourSpace,
    source::Place,
    tokens::{Token, Tokens, unquoted},
};
use crate::scene::SceneError;

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

/// A parameter of a file.
#[derive(Clone, Debug)]
pub struct Parameter {
    pub of_type: Type,
    pub name: String,
    pub values: Values,
    pub place: Place,
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
    pub place: Place,
    own: Vec<Parameter>,
    /// Parameters by `Attribute`, the first one last.
    inherited: Rc<[Parameter]>,
}

impl Entity {
    /// A directive with the parameters that follow it.
    pub fn new(directive: &'static str, kind: String, place: Place, own: Vec<Parameter>, inherited: Rc<[Parameter]>) -> Entity {
        Entity { directive, kind, place, own, inherited }
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
    /// The first text.
    pub fn text(&self) -> Option<&str> {
        match &self.values {
            Values::Texts(texts) => texts.first().map(String::as_str),
            _ => None,
        }
    }

    /// The numbers, if there are at least so many.
    pub fn numbers(&self, least: usize) -> Result<&[f64], SceneError> {
        match &self.values {
            Values::Numbers(numbers) if numbers.len() >= least => Ok(numbers),
            _ if least == 1 => Err(self.error("expected a number")),
            _ => Err(self.error(&format!("expected {least} numbers"))),
        }
    }

    /// An error at the parameter.
    pub fn error(&self, label: &str) -> SceneError {
        self.place.error(format!("`{}` has the wrong values", self.name), label)
    }
}

/// Reads the parameters up to the next directive.
pub fn parameters(tokens: &mut Tokens, space: ColourSpace) -> Result<Vec<Parameter>, SceneError> {
    let mut found = Vec::new();
    while tokens.peek()? == Some(Token::Quoted) {
        let Some((_, place)) = tokens.next()? else { break };
        let declaration = unquoted(tokens.text(&place));
        let mut words = declaration.split_whitespace();
        let (Some(of_type), Some(name), None) = (words.next(), words.next(), words.next()) else {
            return Err(place.error(format!("`{declaration}` declares no parameter"), "expected \"type name\""));
        };
        let Some(of_type) = type_named(of_type) else {
            return Err(place.error(format!("`{of_type}` is no type of parameters"), "such as \"float\" or \"point3\""));
        };
        let values = values(tokens, of_type, &place)?;
        found.push(Parameter { of_type, name: name.to_owned(), values, place, space, used: Cell::new(false) });
    }
    Ok(found)
}

fn type_named(name: &str) -> Option<Type> {
    Some(match name {
        "float" => Type::Float,
        "integer" => Type::Integer,
        "point2" | "vector2" => Type::Pair,
        "point3" | "vector3" | "normal3" | "point" | "vector" | "normal" => Type::Triple,
        "rgb" | "color" => Type::Rgb,
        "spectrum" => Type::Spectrum,
        "blackbody" => Type::Blackbody,
        "string" => Type::String,
        "texture" => Type::Texture,
        "bool" => Type::Bool,
        _ => return None,
    })
}

/// One value, or several in brackets. The type and the first value determine what they are.
fn values(tokens: &mut Tokens, of_type: Type, declaration: &Place) -> Result<Values, SceneError> {
    let mut values = match of_type {
        Type::Bool => Values::Flags(Vec::new()),
        Type::String | Type::Texture => Values::Texts(Vec::new()),
        _ => Values::Numbers(Vec::new()),
    };
    let missing = || declaration.error("the parameter has no value", "it must follow");
    let in_brackets = tokens.peek()? == Some(Token::Open);
    if in_brackets {
        tokens.next()?;
    }
    loop {
        let Some((token, place)) = tokens.next()? else { return Err(missing()) };
        match token {
            Token::Close if in_brackets => return Ok(values),
            Token::Open | Token::Close => return Err(place.error("a bracket stands in the wrong place", "expected a value")),
            _ => add(&mut values, of_type, token, tokens.text(&place), &place)?,
        }
        if !in_brackets {
            return Ok(values);
        }
    }
}

fn add(values: &mut Values, of_type: Type, token: Token, text: &str, place: &Place) -> Result<(), SceneError> {
    // A spectrum is a list of numbers or a name.
    if of_type == Type::Spectrum && token == Token::Quoted && *values == Values::Numbers(Vec::new()) {
        *values = Values::Texts(Vec::new());
    }
    match (values, token) {
        (Values::Numbers(numbers), Token::Word) => numbers.push(number(text, place)?),
        (Values::Texts(texts), Token::Quoted) => texts.push(unquoted(text)),
        (Values::Flags(flags), _) => match text.trim_matches('"') {
            "true" => flags.push(true),
            "false" => flags.push(false),
            _ => return Err(place.error(format!("`{text}` is not true or false"), "expected true or false")),
        },
        (Values::Numbers(_), _) => return Err(place.error(format!("{text} is not a number"), "expected a number")),
        (Values::Texts(_), _) => return Err(place.error(format!("`{text}` is not in quotes"), "expected a quoted string")),
    }
    Ok(())
}

/// A finite number.
pub fn number(text: &str, place: &Place) -> Result<f64, SceneError> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(place.error(format!("`{text}` is not finite"), "expected a finite number")),
        Err(_) => Err(place.error(format!("`{text}` is not a number"), "expected a number")),
    }
}
