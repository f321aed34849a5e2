//! Parameters, declared once.
//!
//! A kind (of material, shape, sampler, …) visits its parameters in the order in which a person reads them: key, meaning, symbol, unit,
//! range. Reader, writer, range check, manual, JSON Schema, stress dice and property tests are visitors of that one declaration.
//!
//! | file | holds |
//! |---|---|
//! | `mod.rs` | the traits of visitors and of what they visit |
//! | `parameter.rs` | what is known of a parameter: words, ranges |
//! | `value.rs` | the types of values |
//! | `catalogue.rs` | families of kinds with parameters: the macro that makes an enum of them |
//! | `choices.rs` | families of kinds that may have none |
//! | `words.rs` | families of kinds that are a word and code |
//! | `owned.rs` | values that own what they hold |
//! | `path.rs` | where in a description a parameter stands |
//! | `problem.rs` | what is wrong with a value, and where |
//! | `outline.rs` | the parameters of a kind as a list |
//! | `precision.rs` | how exactly a changed scene is compiled |
//! | `resources.rs`, `memo.rs` | files, memory and the slow parts of the previous compile, for kinds that are compiled |
//! | `dice.rs` | the visitor that draws random values within their ranges |
//! | `manual.rs`, `schema.rs` | the visitors that document a format, for people and for editors |
//! | `write.rs` | the visitor that writes a description as TOML |
//! | `lines.rs` | the visitor that writes values down for people |
//! | `check.rs` | the visitor that holds values against their ranges |
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

/// A visitor of parameters. It reads or replaces their values. What it does not say leaves everything as it is.
pub trait Parameters {
    /// A value at a key of the current table.
    fn value(&mut self, parameter: &Parameter, value: Value<'_>);

    /// Enters the table at a key; what follows, up to [`Parameters::leave`], stands in it. A [`Form::NameOrTable`] may be the name of a
    /// kind in place of a table.
    fn enter(&mut self, _parameter: &Parameter, _form: Form) {}

    /// Leaves a table.
    fn leave(&mut self) {}

    /// Whether an optional value or table is given, which is visited next if it is.
    fn present(&mut self, _parameter: &Parameter, now: bool) -> bool {
        now
    }

    /// Whether a table is visited that stays as it is where its key is absent.
    fn given(&mut self, _parameter: &Parameter) -> bool {
        true
    }

    /// Whether the visitor passes over the table that it has just entered. It leaves it all the same.
    fn skips(&self) -> bool {
        false
    }

    /// Which of the alternatives of a choice the current table holds.
    fn choose(&mut self, _choice: &Choice, now: usize) -> usize {
        now
    }

    /// What is done to the list at a key before [`Parameters::items`] counts its tables.
    fn rearrange(&mut self, _parameter: &Parameter, _length: usize) -> Option<Rearrangement> {
        None
    }

    /// How many tables the list at a key has; each is visited next, between [`Parameters::item`] and [`Parameters::leave`].
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

    /// Whether the visitor wants to see every alternative of a choice, one after the other, and not the one that is chosen.
    fn sees_all(&self) -> bool {
        false
    }

    /// The alternative that is visited next, of a visitor that sees all; `None` after the last.
    fn alternative(&mut self, _name: Option<&'static str>) {}
}

/// How a choice may be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A table with the key of an alternative.
    Table,
    /// The name of an alternative, or a table.
    NameOrTable,
}

/// What is done to a list. Places are from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rearrangement {
    /// A table with its defaults comes to stand at a place, which is at most the length.
    Insert(usize),
    /// The table at a place goes.
    Remove(usize),
    /// The table at the first place comes to stand at the second.
    Move(usize, usize),
}

/// Something with parameters.
pub trait Declare {
    /// Visits every parameter, in the order of a reader.
    fn parameters(&mut self, p: &mut dyn Parameters);
}

/// A kind of a family: a table of its own at the key of its name.
pub trait Kind: Declare + Default {
    /// The name of the kind, and what it is.
    const KIND: Parameter;

    /// The kind as its family's choice sees it: its parameters, in a table that must be given at the key of its name.
    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND.required(), self);
    }
}

/// Alternatives that exclude each other, told apart by their keys.
pub trait OneOf: Sized {
    /// What is chosen: "material", "background".
    const WHAT: &'static str;

    /// Every alternative with its default values, in the order of the catalogue.
    fn alternatives() -> Vec<Self>;

    /// The place of this one among the alternatives.
    fn place(&self) -> usize;

    /// What a scene file and a person call this alternative.
    fn name(&self) -> &'static str;

    /// Its name with what the window says of it.
    fn about(&self) -> Parameter {
        Parameter::new(self.name(), "")
    }

    /// The parameters of this alternative.
    fn chosen(&mut self, p: &mut dyn Parameters);
}

/// The alternatives of a choice as a visitor sees them.
pub struct Choice {
    /// What is chosen: "material", "background".
    pub what: &'static str,
    /// All alternatives, in the order of the catalogue.
    pub alternatives: Vec<Alternative>,
}

/// One alternative of a choice.
pub struct Alternative {
    /// What a scene file calls it.
    pub name: &'static str,
    /// Its parameters, at the level of the choice.
    pub outline: Outline,
}

impl dyn Parameters + '_ {
    /// The parameters of `table` in a table at a key.
    pub fn table(&mut self, parameter: &Parameter, table: &mut dyn Declare) {
        self.enter(parameter, Form::Table);
        if !self.skips() {
            table.parameters(self);
        }
        self.leave();
    }

    /// A value that may be absent; what appears has `fresh` as its default.
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

    /// A table that may be absent.
    pub fn optional_table<T: Declare + Default>(&mut self, parameter: &Parameter, slot: &mut Option<T>) {
        self.optional(parameter, slot, T::default, |p, table| p.table(parameter, table));
    }

    /// A table that is as it is where its key is absent.
    pub fn optional_part<T: Declare>(&mut self, parameter: &Parameter, table: &mut T) {
        if self.given(parameter) {
            self.table(parameter, table);
        }
    }

    /// One of several alternatives, whose keys stand in the current table.
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

    /// One of several alternatives in a table at a key, or, where it needs no values, by its name.
    pub fn choice<T: OneOf>(&mut self, parameter: &Parameter, form: Form, value: &mut T) {
        self.enter(parameter, form);
        if !self.skips() {
            self.one_of(value);
        }
        self.leave();
    }

    /// A choice that keeps what it is where the key is absent.
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
