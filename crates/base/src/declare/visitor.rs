//! The trait of visitors of parameters.
use super::{outline::Choice, parameter::Parameter, value::Value};

/// A visitor of parameters. It reads or replaces their values. The default methods change nothing.
pub trait Parameters {
    /// Visits a value at a key of the current table.
    fn value(&mut self, parameter: &Parameter, value: Value<'_>);

    /// Enters the table at a key. All visits up to [`Parameters::leave`] are inside it. A [`Form::NameOrTable`] may be the name of a kind
    /// in place of a table.
    fn enter(&mut self, _parameter: &Parameter, _form: Form) {}

    /// Leaves a table.
    fn leave(&mut self) {}

    /// Whether an optional value or table is present. If it is, it is visited next.
    fn present(&mut self, _parameter: &Parameter, now: bool) -> bool {
        now
    }

    /// Whether to visit a table that keeps its defaults if its key is absent.
    fn given(&mut self, _parameter: &Parameter) -> bool {
        true
    }

    /// Whether to skip the content of the table that was just entered. [`Parameters::leave`] is still called.
    fn skips(&self) -> bool {
        false
    }

    /// Selects the alternative of a choice in the current table.
    fn choose(&mut self, _choice: &Choice, now: usize) -> usize {
        now
    }

    /// The change of the list at a key, if any, before [`Parameters::items`] counts its tables.
    fn rearrange(&mut self, _parameter: &Parameter, _length: usize) -> Option<Rearrangement> {
        None
    }

    /// Number of tables in the list at a key. Each is visited next, between [`Parameters::item`] and [`Parameters::leave`].
    fn items(&mut self, _parameter: &Parameter, now: usize) -> usize {
        now
    }

    /// Enters an item of the list that [`Parameters::items`] counted.
    fn item(&mut self, _parameter: &Parameter, _index: usize) {}

    /// The keys of a table of named tables; each is visited next, between [`Parameters::named`] and [`Parameters::leave`].
    fn names(&mut self, _parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        now
    }

    /// Enters one of the tables that [`Parameters::names`] listed.
    fn named(&mut self, _parameter: &Parameter, _name: &str) {}

    /// Whether the visitor reads the outlines of alternatives, which take time to make.
    fn reads_outlines(&self) -> bool {
        true
    }

    /// Whether the visitor visits every alternative of a choice in turn, rather than the chosen one.
    fn sees_all(&self) -> bool {
        false
    }

    /// The next alternative for a visitor that visits all; `None` after the last.
    fn alternative(&mut self, _name: Option<&'static str>) {}
}

/// Forms of a choice in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A table with the key of an alternative.
    Table,
    /// The name of an alternative, or a table.
    NameOrTable,
}

/// A change of a list. Places count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rearrangement {
    /// Inserts a table with its defaults at a place, which is at most the length.
    Insert(usize),
    /// Removes the table at a place.
    Remove(usize),
    /// Moves the table at the first place to the second.
    Move(usize, usize),
}
