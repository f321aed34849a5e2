//! From the tables of a file to its description, with every error on the way.
//!
//! The reader stops at the first value that it cannot take. That value is left out then, and the rest is read again. What is missing for
//! this reason is no error of its own: [`Damage`] knows.
use std::ops::Range;

use serde::Deserialize;
use toml::{
    Spanned,
    de::{DeArray, DeTable, DeValue},
};

use super::{
    desc::SceneDesc,
    diagnostic::{SceneError, SourceText},
    meant::is_known_by_one_value,
    wording::{expected_table, in_plain_words},
};

/// In longer texts the first error is all that is looked for: reading again takes time and memory.
const LONGEST_TEXT: usize = 1 << 18;

/// What was left out of a description.
#[derive(Default)]
pub struct Damage {
    /// The tables that something was left out of, or that were left out themselves.
    tables: Vec<Range<usize>>,
    /// The keys that were left out, behind the key of their table.
    keys: Vec<[String; 2]>,
}

impl Damage {
    /// Whether something was left out of a table, or of a table in it.
    pub fn reaches(&self, table: &Range<usize>) -> bool {
        self.tables.contains(table)
    }

    /// The keys of a table that were left out.
    pub fn left_out(&self, table: &str) -> impl Iterator<Item = &str> {
        self.keys.iter().filter(move |[of, _]| of == table).map(|[_, key]| key.as_str())
    }
}

/// What a file says: all of it that can be understood, what was left out, and why.
pub struct Described {
    /// None where nothing can be made of the file.
    pub desc: Option<SceneDesc>,
    pub damage: Damage,
    pub errors: Vec<SceneError>,
}

/// Reads the description from its tables.
pub fn describe(mut table: Spanned<DeTable>, source: &SourceText) -> Described {
    let mut described = Described { desc: None, damage: Damage::default(), errors: Vec::new() };
    if source.text.len() > LONGEST_TEXT {
        match SceneDesc::deserialize(toml::de::Deserializer::from(table)) {
            Ok(desc) => described.desc = Some(desc),
            Err(error) => described.errors.push(in_plain_words(source, &error)),
        }
        return described;
    }
    while let Some((key, span)) = list_for_table(table.get_ref()) {
        described.errors.push(expected_table(source, &key, &span));
        leave_out("", table.get_mut(), &span, &mut described.damage);
    }
    for _ in 0..SceneError::MOST {
        let error = match SceneDesc::deserialize(toml::de::Deserializer::from(table.clone())) {
            Ok(desc) => {
                described.desc = Some(desc);
                break;
            }
            Err(error) => error,
        };
        let span = error.span().unwrap_or_default();
        let follows = described.damage.reaches(&span) || (span.is_empty() && !described.errors.is_empty());
        if !follows {
            described.errors.push(in_plain_words(source, &error));
        }
        if !leave_out("", table.get_mut(), &span, &mut described.damage) {
            break;
        }
    }
    described
}

/// A list where a table belongs, which the reader would take for the values of the table in their order.
fn list_for_table(table: &DeTable) -> Option<(String, Range<usize>)> {
    fn within(value: &DeValue) -> Option<(String, Range<usize>)> {
        match value {
            DeValue::Table(table) => list_for_table(table),
            DeValue::Array(array) => array.iter().find_map(|value| within(value.get_ref())),
            _ => None,
        }
    }
    table.iter().find_map(|(key, value)| {
        let is_list = is_known_by_one_value(key.get_ref()) && value.get_ref().is_array();
        if is_list { Some((key.get_ref().to_string(), value.span())) } else { within(value.get_ref()) }
    })
}

/// Takes the key or the value at a place out of a table, which has this name, or of those in it, and notes all tables around it.
fn leave_out(name: &str, table: &mut DeTable, span: &Range<usize>, damage: &mut Damage) -> bool {
    let mut gone = None;
    for (key, value) in table.iter_mut() {
        let (key_span, value_span) = (key.span(), value.span());
        if leave_out_of_value(key.get_ref(), value.get_mut(), span, damage) {
            damage.tables.push(value_span);
            return true;
        }
        if key_span == *span || value_span == *span {
            gone = Some((key.get_ref().to_string(), value_span));
            break;
        }
    }
    let Some((key, value_span)) = gone else { return false };
    table.remove(key.as_str());
    damage.tables.push(value_span);
    damage.keys.push([name.to_owned(), key]);
    true
}

fn leave_out_of_value(name: &str, value: &mut DeValue, span: &Range<usize>, damage: &mut Damage) -> bool {
    match value {
        DeValue::Table(table) => leave_out(name, table, span, damage),
        DeValue::Array(array) => leave_out_of_array(array, span, damage),
        _ => false,
    }
}

fn leave_out_of_array(array: &mut DeArray, span: &Range<usize>, damage: &mut Damage) -> bool {
    for value in array.iter_mut() {
        let value_span = value.span();
        if leave_out_of_value("", value.get_mut(), span, damage) {
            damage.tables.push(value_span);
            return true;
        }
    }
    let mut left = DeArray::new();
    array.iter().filter(|value| value.span() != *span).for_each(|value| left.push(value.clone()));
    let found = left.len() < array.len();
    if found {
        damage.tables.push(span.clone());
        *array = left;
    }
    found
}
