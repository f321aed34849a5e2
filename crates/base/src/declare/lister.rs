//! The visitor that lists the parameters of a declaration.
use super::{
    outline::{Choice, Entry, Looks, Outline},
    parameter::Parameter,
    value::Value,
    visitor::{Form, Parameters},
};

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
