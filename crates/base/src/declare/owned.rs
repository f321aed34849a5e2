//! Values that own what they hold: what an edit sets, and what a recording keeps.
use glam::DVec3;

use super::{Textured, Value};

/// The content of a [`Value`].
#[derive(Clone, Debug, PartialEq)]
pub enum OwnedValue {
    /// A number.
    Number(f64),
    /// A whole number.
    Count(u32),
    /// True or false.
    Flag(bool),
    /// A text, a path or a name.
    Text(String),
    /// A colour.
    Colour([f64; 3]),
    /// A colour that may be a texture.
    Textured(Textured),
    /// A number that may be a texture.
    TexturedNumber(Textured<f64>),
    /// A position, a vector or three factors.
    Vector(DVec3),
    /// Two numbers.
    Pair([f64; 2]),
    /// Two whole numbers.
    Counts([u32; 2]),
    /// Row by row.
    Matrix([[f64; 4]; 4]),
    /// A list of positions.
    Points(Vec<[f64; 3]>),
    /// A list of triangles.
    Triangles(Vec<[u32; 3]>),
    /// One of a few words.
    Word(&'static str),
}

impl OwnedValue {
    /// A copy of what a value holds.
    pub fn of(value: &Value) -> OwnedValue {
        match value {
            Value::Number(number, _) => OwnedValue::Number(**number),
            Value::Count(count, _) => OwnedValue::Count(**count),
            Value::Flag(flag) => OwnedValue::Flag(**flag),
            Value::Text(text) | Value::File(text) | Value::Name(text, _) => OwnedValue::Text((*text).clone()),
            Value::Colour(rgb, _) => OwnedValue::Colour(**rgb),
            Value::Textured(textured, _) => OwnedValue::Textured((*textured).clone()),
            Value::TexturedNumber(textured, _) => OwnedValue::TexturedNumber((*textured).clone()),
            Value::Point(v) | Value::Vector(v) | Value::Factors(v) => OwnedValue::Vector(**v),
            Value::Pair(pair) => OwnedValue::Pair(**pair),
            Value::Counts(counts) => OwnedValue::Counts(**counts),
            Value::Matrix(rows) => OwnedValue::Matrix(**rows),
            Value::Points(points) => OwnedValue::Points((*points).clone()),
            Value::Triangles(triangles) => OwnedValue::Triangles((*triangles).clone()),
            Value::Word(place, words) => OwnedValue::Word(words[**place].name),
        }
    }

    /// Assigns this content to a value. Returns false and changes nothing if the value has another type.
    pub fn assign(&self, value: &mut Value) -> bool {
        match (self, value) {
            (OwnedValue::Number(from), Value::Number(to, _)) => **to = *from,
            (OwnedValue::Count(from), Value::Count(to, _)) => **to = *from,
            (OwnedValue::Flag(from), Value::Flag(to)) => **to = *from,
            (OwnedValue::Text(from), Value::Text(to) | Value::File(to) | Value::Name(to, _)) => to.clone_from(from),
            (OwnedValue::Colour(from), Value::Colour(to, _)) => **to = *from,
            (OwnedValue::Textured(from), Value::Textured(to, _)) => to.clone_from(from),
            (OwnedValue::TexturedNumber(from), Value::TexturedNumber(to, _)) => to.clone_from(from),
            (OwnedValue::Vector(from), Value::Point(to) | Value::Vector(to) | Value::Factors(to)) => **to = *from,
            (OwnedValue::Pair(from), Value::Pair(to)) => **to = *from,
            (OwnedValue::Counts(from), Value::Counts(to)) => **to = *from,
            (OwnedValue::Matrix(from), Value::Matrix(to)) => **to = *from,
            (OwnedValue::Points(from), Value::Points(to)) => to.clone_from(from),
            (OwnedValue::Triangles(from), Value::Triangles(to)) => to.clone_from(from),
            (OwnedValue::Word(from), Value::Word(to, words)) => match words.iter().position(|word| word.name == *from) {
                Some(place) => **to = place,
                None => return false,
            },
            _ => return false,
        }
        true
    }

    /// Whether both hold the same bits: −0 differs from 0, and NaN equals itself.
    pub fn is_identical(&self, other: &OwnedValue) -> bool {
        let same = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        match (self, other) {
            (OwnedValue::Number(a), OwnedValue::Number(b))
            | (OwnedValue::TexturedNumber(Textured::Constant(a)), OwnedValue::TexturedNumber(Textured::Constant(b))) => {
                same(&[*a], &[*b])
            }
            (OwnedValue::Colour(a), OwnedValue::Colour(b))
            | (OwnedValue::Textured(Textured::Constant(a)), OwnedValue::Textured(Textured::Constant(b))) => same(a, b),
            (OwnedValue::Vector(a), OwnedValue::Vector(b)) => same(&a.to_array(), &b.to_array()),
            (OwnedValue::Pair(a), OwnedValue::Pair(b)) => same(a, b),
            (OwnedValue::Matrix(a), OwnedValue::Matrix(b)) => same(a.as_flattened(), b.as_flattened()),
            (OwnedValue::Points(a), OwnedValue::Points(b)) => same(a.as_flattened(), b.as_flattened()),
            _ => self == other,
        }
    }
}
