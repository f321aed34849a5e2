//! Parameters, declared once.
//!
//! A kind (of material, shape, sampler, …) visits its parameters in the order in which a person reads them: key, meaning, symbol, unit,
//! range. Reader, writer, range check, manual, JSON Schema, stress dice and property tests are visitors of that one declaration.
//!
//! | file | holds |
//! |---|---|
//! | `visitor.rs` | the trait of visitors |
//! | `declared.rs` | the traits of what is visited: tables, kinds, choices |
//! | `visit.rs` | visits of values, tables, choices and lists |
//! | `parameter.rs` | description of a parameter: words, ranges |
//! | `value.rs` | the types of values |
//! | `setting_value.rs` | values of settings, as one word each |
//! | `catalogue.rs` | families of kinds with parameters: the macro that makes an enum of them |
//! | `choices.rs` | the same for families of kinds that may have none |
//! | `words.rs` | the same for families of kinds that are a word and code |
//! | `owned.rs` | owned values |
//! | `path.rs` | the path of a parameter in a description |
//! | `problem.rs` | an error in a value, with its path |
//! | `outline.rs` | the parameters of a kind as a list, and a choice of kinds |
//! | `lister.rs` | the visitor that makes such a list |
//! | `precision.rs` | how exactly a changed scene is compiled |
//! | `resources.rs`, `memo.rs` | memory and the slow parts of the previous compile, for kinds that are compiled |
//! | `assets.rs`, `named_file.rs` | files in memory, and files that a description names |
//! | `dice.rs` | the visitor that draws random values within their ranges |
//! | `manual.rs`, `schema.rs` | the visitors that document a format, for people and for editors |
//! | `write.rs` | the visitor that writes a description as TOML |
//! | `lines.rs` | the visitor that lists values as text |
//! | `files.rs` | the visitor of the files that a description names |
//! | `check.rs` | the visitor that compares values with their ranges |
mod assets;
mod catalogue;
mod check;
mod choices;
mod declared;
mod dice;
mod files;
mod lister;
mod manual;
mod memo;
mod named_file;
mod outline;
mod owned;
mod parameter;
mod path;
mod precision;
mod problem;
mod resources;
mod schema;
mod setting_value;
mod value;
mod visit;
mod visitor;
mod words;
mod write;

pub use self::dice::Dice;
pub use self::{
    assets::Assets,
    check::{check, check_value},
    declared::{Declare, Kind, OneOf},
    files::for_each_file,
    lister::outline,
    manual::manual,
    memo::{Memo, PartReport},
    named_file::{NamedFile, key_of_file},
    outline::{Alternative, Choice, Entry, Looks, Outline},
    owned::OwnedValue,
    parameter::{CountRange, Meaning, Parameter, Range, SliderScale, capitalised, key_in_words},
    path::{Path, Step},
    precision::Precision,
    problem::{Problem, nearest, short},
    resources::{Leftovers, Resources},
    schema::schema,
    setting_value::{Accepted, Datum, SettingValue},
    value::{Family, Textured, Value, Word, Words},
    visitor::{Form, Parameters, Rearrangement},
    write::write,
};
pub use self::{
    catalogue::catalogue,
    choices::{choices, kind_of},
    value::words,
    words::word_kinds,
};
