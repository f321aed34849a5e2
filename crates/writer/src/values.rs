//! Values in the style of a person: short numbers, tables on one line, the forms that the file uses.
use toml_edit::{Array, InlineTable, Value};

use super::outline::{Node, Table};
use noisefall_base::declare::{OwnedValue, Textured};

/// Longer lists have a line for each item.
const LONGEST_ROW: usize = 8;

/// A number with the fewest digits that distinguish it from all others.
fn number(x: f64) -> Value {
    // Rust writes 1e300 with an exponent here, and 1 as 1.0.
    literal(&format!("{x:?}").to_lowercase()).unwrap_or_else(|| x.into())
}

fn literal(text: &str) -> Option<Value> {
    text.parse().ok()
}

fn row<T>(items: impl IntoIterator<Item = T>, write: impl Fn(T) -> Value) -> Value {
    let mut array: Array = items.into_iter().map(write).collect();
    if array.len() > LONGEST_ROW {
        array.iter_mut().for_each(|item| item.decor_mut().set_prefix("\n    "));
        array.set_trailing_comma(true);
        array.set_trailing("\n");
    }
    Value::Array(array)
}

fn numbers(values: &[f64]) -> Value {
    row(values, |x| number(*x))
}

fn counts(values: &[u32]) -> Value {
    row(values, |x| i64::from(*x).into())
}

fn grey(values: &[f64; 3], collapses: bool) -> Value {
    let [r, g, b] = values.map(f64::to_bits);
    if collapses && r == g && g == b { number(values[0]) } else { numbers(values) }
}

fn texture(name: &str) -> Value {
    Value::InlineTable(InlineTable::from_iter([("texture", name)]))
}

/// A value.
pub fn written(value: &OwnedValue, collapses: bool) -> Value {
    match value {
        OwnedValue::Number(x) | OwnedValue::TexturedNumber(Textured::Constant(x)) => number(*x),
        OwnedValue::Count(count) => i64::from(*count).into(),
        OwnedValue::Flag(flag) => (*flag).into(),
        OwnedValue::Text(text) => text.into(),
        OwnedValue::Word(word) => (*word).into(),
        OwnedValue::Colour(rgb) | OwnedValue::Textured(Textured::Constant(rgb)) => grey(rgb, collapses),
        OwnedValue::Textured(Textured::Texture(name)) | OwnedValue::TexturedNumber(Textured::Texture(name)) => texture(name),
        OwnedValue::Vector(v) => grey(&v.to_array(), collapses),
        OwnedValue::Pair(pair) => numbers(pair),
        OwnedValue::Counts(pair) => counts(pair),
        OwnedValue::Matrix(rows) => row(rows, |x| numbers(x)),
        OwnedValue::Points(points) => row(points, |x| numbers(x)),
        OwnedValue::Triangles(triangles) => row(triangles, |x| counts(x)),
    }
}

/// A table on one line, or the name that may replace it.
pub fn written_table(table: &Table) -> Value {
    match table.name {
        Some(name) if table.is_default() => name.into(),
        _ => {
            let entries = table.entries.iter().filter(|entry| !entry.is_default);
            Value::InlineTable(entries.map(|entry| (entry.key, written_node(&entry.node))).collect())
        }
    }
}

/// Anything on one line.
pub fn written_node(node: &Node) -> Value {
    match node {
        Node::Value { value, collapses } => written(value, *collapses),
        Node::Table(table) => written_table(table),
        Node::List(tables) => row(tables, written_table),
        Node::Named(tables) => {
            Value::InlineTable(tables.iter().map(|(name, table)| (name.as_str(), written_table(table))).collect())
        }
    }
}

/// Replaces a value by another in the form of the old one.
pub fn replace(old: &mut Value, value: &OwnedValue, collapses: bool) {
    // A colour that is written as a list stays one.
    let collapses = collapses && !old.is_array();
    replace_written(old, written(value, collapses));
}

fn replace_written(old: &mut Value, new: Value) {
    match (&mut *old, new) {
        (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
            old.iter_mut().zip(new).for_each(|(old, new)| replace_written(old, new));
        }
        (Value::InlineTable(table), Value::InlineTable(new)) => {
            for (key, new) in new {
                match table.get_mut(&key) {
                    Some(old) => replace_written(old, new),
                    None => drop(table.insert(key.as_str(), new)),
                }
            }
        }
        (old, new) if is_same(old, &new) => {}
        (old, new) => {
            let decor = old.decor().clone();
            *old = styled(old, new);
            *old.decor_mut() = decor;
        }
    }
}

/// Whether both are the same number, bit for bit, or the same text.
fn is_same(old: &Value, new: &Value) -> bool {
    let bits = |value: &Value| match value {
        Value::Integer(x) => Some((*x.value() as f64).to_bits()),
        Value::Float(x) => Some(x.value().to_bits()),
        _ => None,
    };
    match (bits(old), bits(new)) {
        (Some(old), Some(new)) => old == new,
        _ => old.as_str().is_some() && old.as_str() == new.as_str(),
    }
}

/// A value in the style of the one that it replaces: whole numbers without a point, texts in single quotes.
fn styled(old: &Value, new: Value) -> Value {
    /// Larger numbers are not exact as integers.
    const LARGEST: f64 = 9e15;
    let styled = match (old, &new) {
        (Value::Integer(_), Value::Float(x))
            if x.value().fract() == 0.0 && x.value().abs() < LARGEST && x.value().to_bits() != (-0.0f64).to_bits() =>
        {
            Some(Value::from(*x.value() as i64))
        }
        (Value::String(quoted), Value::String(text)) => {
            let is_literal = quoted.display_repr().starts_with('\'') && !quoted.display_repr().starts_with("'''");
            let fits = !text.value().contains(|c: char| c == '\'' || c.is_control());
            (is_literal && fits).then(|| literal(&format!("'{}'", text.value()))).flatten()
        }
        _ => None,
    };
    styled.unwrap_or(new)
}
