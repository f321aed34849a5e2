//! The parameters of a kind as a list: what a reader suggests, and what tells alternatives apart.
use super::{Choice, Form, Parameter, Parameters, Value};

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

/// The parameters that `declaration` visits, without those within tables.
pub fn outline(declaration: impl FnOnce(&mut dyn Parameters)) -> Outline {
    let mut lister = Lister { entries: Vec::new(), depth: 0 };
    declaration(&mut lister);
    lister.entries
}

struct Lister {
    entries: Outline,
    depth: usize,
}

impl Lister {
    fn note(&mut self, parameter: &Parameter, looks: Looks) {
        // An optional value is asked for first and visited then.
        let is_known = self.entries.iter().any(|entry| entry.parameter.key == parameter.key);
        if self.depth == 0 && !is_known {
            self.entries.push(Entry { parameter: *parameter, looks });
        }
    }
}

impl Parameters for Lister {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.note(parameter, Looks::of(&value));
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.note(parameter, Looks::Table);
        self.depth += 1;
    }

    fn leave(&mut self) {
        self.depth -= 1;
    }

    fn present(&mut self, _: &Parameter, _: bool) -> bool {
        true
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        for entry in choice.alternatives.iter().flat_map(|alternative| &alternative.outline) {
            self.note(&entry.parameter, entry.looks);
        }
        now
    }

    fn items(&mut self, parameter: &Parameter, _: usize) -> usize {
        self.note(parameter, Looks::List);
        0
    }

    fn item(&mut self, _: &Parameter, _: usize) {
        self.depth += 1;
    }

    fn names(&mut self, parameter: &Parameter, _: Vec<String>) -> Vec<String> {
        self.note(parameter, Looks::Table);
        Vec::new()
    }

    fn named(&mut self, _: &Parameter, _: &str) {
        self.depth += 1;
    }
}
