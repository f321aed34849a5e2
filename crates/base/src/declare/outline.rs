//! The parameters of a kind as a list: what a reader suggests, and what tells the alternatives of a choice apart.
use super::{parameter::Parameter, value::Value};

/// The parameters at one level.
pub type Outline = Vec<Entry>;

/// A parameter and the form of its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The parameter.
    pub parameter: Parameter,
    /// The form of its value.
    pub looks: Looks,
}

/// The form of a value in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looks {
    /// A number.
    Number,
    /// A list, or a number for grey.
    Colour,
    /// A text between quotes.
    Text,
    /// A list.
    List,
    /// True or false.
    Flag,
    /// A table.
    Table,
}

impl Looks {
    /// The form of a value.
    pub fn of(value: &Value) -> Looks {
        match value {
            Value::Number(..) | Value::Count(..) | Value::TexturedNumber(..) => Looks::Number,
            Value::Flag(_) => Looks::Flag,
            Value::Text(_) | Value::File(_) | Value::Name(..) | Value::Word(..) => Looks::Text,
            Value::Colour(..) | Value::Textured(..) => Looks::Colour,
            _ => Looks::List,
        }
    }
}

/// The alternatives of a choice as a visitor sees them.
pub struct Choice {
    /// Name of the choice: "material", "environment".
    pub what: &'static str,
    /// All alternatives, in the order of the catalogue.
    pub alternatives: Vec<Alternative>,
}

/// One alternative of a choice.
pub struct Alternative {
    /// Its name in scene files.
    pub name: &'static str,
    /// Its title in the window; may be empty.
    pub title: &'static str,
    /// Its parameters, at the level of the choice.
    pub outline: Outline,
}
