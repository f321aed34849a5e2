//! Parameters, declared once.
//!
//! A kind (of material, shape, sampler, …) visits its parameters in the order in which a person reads them: key, meaning, symbol, unit,
//! range. Reader, writer, range check, manual, JSON Schema, stress dice and property tests are visitors of that one declaration.
//!
//! | file | holds |
//! |---|---|
//! | `mod.rs` | the traits of visitors and of the visited types |
//! | `parameter.rs` | description of a parameter: words, ranges |
//! | `value.rs` | the types of values |
//! | `catalogue.rs` | families of kinds with parameters: the macro that makes an enum of them |
//! | `choices.rs` | the same for families of kinds that may have none |
//! | `words.rs` | the same for families of kinds that are a word and code |
//! | `owned.rs` | owned values |
//! | `path.rs` | the path of a parameter in a description |
//! | `problem.rs` | an error in a value, with its path |
//! | `outline.rs` | the parameters of a kind as a list |
//! | `precision.rs` | how exactly a changed scene is compiled |
//! | `resources.rs`, `memo.rs` | files, memory and the slow parts of the previous compile, for kinds that are compiled |
//! | `dice.rs` | the visitor that draws random values within their ranges |
//! | `manual.rs`, `schema.rs` | the visitors that document a format, for people and for editors |
//! | `write.rs` | the visitor that writes a description as TOML |
//! | `lines.rs` | the visitor that lists values as text |
//! | `check.rs` | the visitor that compares values with their ranges |
mod catalogue;
mod check;
mod choices;
#[cfg(feature = "reports")]
mod dice;
mod lines;
mod manual;
mod memo;
mod outline;
mod owned;
mod parameter;
mod path;
mod precision;
mod problem;
mod resources;
mod schema;
mod value;
mod words;
mod write;

#[cfg(feature = "reports")]
pub use self::dice::Dice;
pub use self::{
    check::{check, check_value},
    lines::lines_of,
    manual::manual,
    memo::{Memo, PartReport},
    outline::{Entry, Looks, Outline, outline},
    owned::OwnedValue,
    parameter::{CountRange, Parameter, Range, Scale},
    path::{Path, Step},
    precision::Precision,
    problem::{Problem, nearest, short},
    resources::{Leftovers, Resources, key_of_file},
    schema::schema,
    value::{Family, Textured, Value, Word, Words},
    write::write,
};

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

/// Something with parameters.
pub trait Declare {
    /// Visits every parameter, in reading order.
    fn parameters(&mut self, p: &mut dyn Parameters);
}

/// A kind of a family: a table of its own at the key of its name.
pub trait Kind: Declare + Default {
    /// Name and description of the kind.
    const KIND: Parameter;

    /// The kind as its family's choice sees it: its parameters, in a table that must be given at the key of its name.
    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND.required(), self);
    }
}

/// Mutually exclusive alternatives, distinguished by their keys.
pub trait OneOf: Sized {
    /// Name of the choice: "material", "background".
    const WHAT: &'static str;

    /// Every alternative with its default values, in the order of the catalogue.
    fn alternatives() -> Vec<Self>;

    /// The place of this one among the alternatives.
    fn place(&self) -> usize;

    /// Name of this alternative in scene files and messages.
    fn name(&self) -> &'static str;

    /// Its name, with its title and description in the window.
    fn about(&self) -> Parameter {
        Parameter::new(self.name(), "")
    }

    /// The parameters of this alternative.
    fn chosen(&mut self, p: &mut dyn Parameters);
}

/// The alternatives of a choice as a visitor sees them.
pub struct Choice {
    /// Name of the choice: "material", "background".
    pub what: &'static str,
    /// All alternatives, in the order of the catalogue.
    pub alternatives: Vec<Alternative>,
}

/// One alternative of a choice.
pub struct Alternative {
    /// Its name in scene files.
    pub name: &'static str,
    /// Its parameters, at the level of the choice.
    pub outline: Outline,
}

impl dyn Parameters + '_ {
    /// Visits the parameters of `table` in a table at a key.
    pub fn table(&mut self, parameter: &Parameter, table: &mut dyn Declare) {
        self.enter(parameter, Form::Table);
        if !self.skips() {
            table.parameters(self);
        }
        self.leave();
    }

    /// Visits a value that may be absent. `fresh` makes it when it is added.
    pub fn optional<T>(
        &mut self,
        parameter: &Parameter,
        slot: &mut Option<T>,
        fresh: impl FnOnce() -> T,
        visit: impl FnOnce(&mut dyn Parameters, &mut T),
    ) {
        if !self.present(parameter, slot.is_some()) {
            *slot = None;
            return;
        }
        visit(self, slot.get_or_insert_with(fresh));
    }

    /// Visits a table that may be absent.
    pub fn optional_table<T: Declare + Default>(&mut self, parameter: &Parameter, slot: &mut Option<T>) {
        self.optional(parameter, slot, T::default, |p, table| p.table(parameter, table));
    }

    /// Visits a table that keeps its defaults if its key is absent.
    pub fn optional_part<T: Declare>(&mut self, parameter: &Parameter, table: &mut T) {
        if self.given(parameter) {
            self.table(parameter, table);
        }
    }

    /// Visits one of several alternatives, whose keys are in the current table.
    pub fn one_of<T: OneOf>(&mut self, value: &mut T) {
        let mut alternatives = T::alternatives();
        let reads = self.reads_outlines();
        let seen = |alternative: &mut T| {
            let outline = if reads { outline(|p| alternative.chosen(p)) } else { Outline::new() };
            Alternative { name: alternative.name(), outline }
        };
        let choice = Choice { what: T::WHAT, alternatives: alternatives.iter_mut().map(seen).collect() };
        if self.sees_all() {
            self.choose(&choice, value.place());
            for alternative in &mut alternatives {
                self.alternative(Some(alternative.name()));
                alternative.chosen(self);
            }
            return self.alternative(None);
        }
        let place = self.choose(&choice, value.place());
        if place != value.place() {
            *value = alternatives.swap_remove(place);
        }
        value.chosen(self);
    }

    /// Visits one of several alternatives in a table at a key, or its name if it needs no values.
    pub fn choice<T: OneOf>(&mut self, parameter: &Parameter, form: Form, value: &mut T) {
        self.enter(parameter, form);
        if !self.skips() {
            self.one_of(value);
        }
        self.leave();
    }

    /// Visits a choice that keeps its default if its key is absent.
    pub fn optional_choice<T: OneOf>(&mut self, parameter: &Parameter, form: Form, value: &mut T) {
        if self.given(parameter) {
            self.choice(parameter, form, value);
        }
    }

    /// A list of tables at a key.
    pub fn list<T: Declare + Default>(&mut self, parameter: &Parameter, list: &mut Vec<T>) {
        match self.rearrange(parameter, list.len()) {
            Some(Rearrangement::Insert(place)) => list.insert(place, T::default()),
            Some(Rearrangement::Remove(place)) => drop(list.remove(place)),
            Some(Rearrangement::Move(from, to)) => {
                let item = list.remove(from);
                list.insert(to, item);
            }
            None => {}
        }
        let count = self.items(parameter, list.len());
        list.resize_with(count, T::default);
        for (index, item) in list.iter_mut().enumerate() {
            self.item(parameter, index);
            if !self.skips() {
                item.parameters(self);
            }
            self.leave();
        }
    }

    /// A table of named tables at a key.
    pub fn map<T: Declare + Default>(&mut self, parameter: &Parameter, map: &mut std::collections::BTreeMap<String, T>) {
        let names = self.names(parameter, map.keys().cloned().collect());
        let mut known = std::mem::take(map);
        for name in names {
            self.named(parameter, &name);
            let mut table = known.remove(&name).unwrap_or_default();
            if !self.skips() {
                table.parameters(self);
            }
            map.insert(name, table);
            self.leave();
        }
    }

    /// A number in a range.
    pub fn number(&mut self, parameter: &Parameter, value: &mut f64, range: Range) {
        self.value(parameter, Value::Number(value, range));
    }

    /// A number that is kept in single precision: it reads as it is written.
    pub fn single(&mut self, parameter: &Parameter, value: &mut f32, range: Range) {
        let mut number = value.to_string().parse().unwrap_or(f64::from(*value));
        self.number(parameter, &mut number, range);
        *value = number as f32;
    }

    /// A whole number in a range.
    pub fn count(&mut self, parameter: &Parameter, value: &mut u32, range: CountRange) {
        self.value(parameter, Value::Count(value, range));
    }

    /// True or false.
    pub fn flag(&mut self, parameter: &Parameter, value: &mut bool) {
        self.value(parameter, Value::Flag(value));
    }

    /// A colour or the name of a texture.
    pub fn textured(&mut self, parameter: &Parameter, value: &mut Textured, range: Range) {
        self.value(parameter, Value::Textured(value, range));
    }

    /// A number or the name of a texture whose luminance it is.
    pub fn textured_number(&mut self, parameter: &Parameter, value: &mut Textured<f64>, range: Range) {
        self.value(parameter, Value::TexturedNumber(value, range));
    }

    /// A colour, linear Rec. 709.
    pub fn colour(&mut self, parameter: &Parameter, value: &mut [f64; 3], range: Range) {
        self.value(parameter, Value::Colour(value, range));
    }

    /// A position or a direction, in metres.
    pub fn point(&mut self, parameter: &Parameter, value: &mut glam::DVec3) {
        self.value(parameter, Value::Point(value));
    }

    /// One of a few words.
    pub fn word<T: Words>(&mut self, parameter: &Parameter, value: &mut T) {
        let words = T::words();
        let mut place = words.iter().position(|(_, word)| word == value).unwrap_or(0);
        let list: Vec<Word> = words.iter().map(|(word, _)| *word).collect();
        self.value(parameter, Value::Word(&mut place, &list));
        *value = words[place].1;
    }
}
