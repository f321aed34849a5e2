//! Reads single values of a scene file.
use std::{borrow::Cow, ops::Range};

use glam::DVec3;
use toml::{
    Spanned,
    de::{DeArray, DeTable, DeValue},
};

use noisefall_base::declare::{Entry, Looks, Parameter, Textured, Value, Word};

/// Result of reading a value.
pub enum ReadOutcome<'t> {
    Read,
    Wrong(Wrong),
    /// An unknown key in a table that names a texture, and the known keys.
    Unknown(&'t Spanned<Cow<'t, str>>, Vec<Entry>),
    /// A table without this key.
    Missing(&'static str),
    /// A texture where only a colour is allowed.
    NoTexture,
    /// A string that is none of the words.
    NoWord(Vec<Word>),
}

/// A value of another type than expected.
pub struct Wrong {
    pub span: Range<usize>,
    pub expected: String,
    /// Description of the value found, if the text of the file is not the best one.
    pub what: Option<String>,
}

const COLOUR: &str = "a colour: [red, green, blue], or one number for grey";
const TEXTURE: Parameter = Parameter::new("texture", "The name of a texture.");

/// Reads `given` into `value`, which is unchanged if that fails.
pub fn read_value<'t>(given: &'t Spanned<DeValue<'t>>, value: &mut Value<'_>) -> ReadOutcome<'t> {
    let wrong = |expected: &str| ReadOutcome::Wrong(Wrong { span: given.span(), expected: expected.to_owned(), what: None });
    let of = |read: Result<(), Wrong>| read.map_or_else(ReadOutcome::Wrong, |()| ReadOutcome::Read);
    match value {
        Value::Number(number, _) => {
            set(&mut **number, read_number(given.get_ref())).map_or_else(|| wrong("a number"), |()| ReadOutcome::Read)
        }
        Value::Count(count, _) => set(&mut **count, read_count(given.get_ref()))
            .map_or_else(|| wrong("a whole number, 0 or more"), |()| ReadOutcome::Read),
        Value::Flag(flag) => {
            set(&mut **flag, given.get_ref().as_bool()).map_or_else(|| wrong("true or false"), |()| ReadOutcome::Read)
        }
        Value::Text(text) | Value::File(text) | Value::Name(text, _) => {
            let read = given.get_ref().as_str().map(str::to_owned);
            set(&mut **text, read).map_or_else(|| wrong("text in quotes"), |()| ReadOutcome::Read)
        }
        Value::Colour(colour, _) => match given.get_ref() {
            DeValue::Table(table) if table.contains_key("texture") => ReadOutcome::NoTexture,
            _ => of(read_colour(given).map(|read| **colour = read)),
        },
        Value::Textured(textured, _) => match texture(given) {
            Some(found) => found.unwrap_or_else(|name| {
                **textured = Textured::Texture(name);
                ReadOutcome::Read
            }),
            None => of(read_colour(given).map(|read| **textured = Textured::Constant(read))),
        },
        Value::TexturedNumber(textured, _) => match texture(given) {
            Some(found) => found.unwrap_or_else(|name| {
                **textured = Textured::Texture(name);
                ReadOutcome::Read
            }),
            None => match read_number(given.get_ref()) {
                Some(number) => {
                    **textured = Textured::Constant(number);
                    ReadOutcome::Read
                }
                None => wrong("one number"),
            },
        },
        Value::Point(point) | Value::Vector(point) => of(numbers(given).map(|read| **point = DVec3::from_array(read))),
        Value::Factors(factors) => match read_number(given.get_ref()) {
            Some(factor) => {
                **factors = DVec3::splat(factor);
                ReadOutcome::Read
            }
            None if given.get_ref().is_array() => of(numbers(given).map(|read| **factors = DVec3::from_array(read))),
            None => wrong("three factors [x, y, z], or one number for all"),
        },
        Value::Pair(pair) => of(numbers(given).map(|read| **pair = read)),
        Value::Counts(counts) => of(exactly(given, read_count, "a whole number, 0 or more").map(|read| **counts = read)),
        Value::Matrix(rows) => of(rows_of(given).map(|read| **rows = read)),
        Value::Points(points) => of(each(given, numbers).map(|read| **points = read)),
        Value::Triangles(triangles) => {
            let corners = |item| exactly(item, read_count, "a whole number, 0 or more");
            of(each(given, corners).map(|read| **triangles = read))
        }
        Value::Word(place, words) => match given.get_ref().as_str() {
            Some(name) => match words.iter().position(|word| word.name == name) {
                Some(found) => {
                    **place = found;
                    ReadOutcome::Read
                }
                None => ReadOutcome::NoWord(words.to_vec()),
            },
            None => wrong("a name in quotes"),
        },
    }
}

fn set<T>(slot: &mut T, read: Option<T>) -> Option<()> {
    read.map(|value| *slot = value)
}

fn read_number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(number) => number.as_str().parse().ok(),
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix()).ok().map(|number| number as f64),
        _ => None,
    }
}

fn read_count(value: &DeValue) -> Option<u32> {
    let number = value.as_integer()?;
    u32::from_str_radix(number.as_str(), number.radix()).ok()
}

fn read_colour(given: &Spanned<DeValue>) -> Result<[f64; 3], Wrong> {
    let wrong = |what| Wrong { span: given.span(), expected: COLOUR.to_owned(), what };
    if let Some(grey) = read_number(given.get_ref()) {
        return Ok([grey; 3]);
    }
    let list = given.get_ref().as_array().ok_or_else(|| wrong(None))?;
    if list.len() != 3 {
        return Err(wrong(Some(format!("{} values", list.len()))));
    }
    numbers(given)
}

/// The name of a texture, if the value is a table; or the error in that table.
fn texture<'t>(given: &'t Spanned<DeValue<'t>>) -> Option<Result<ReadOutcome<'t>, String>> {
    let table: &DeTable = given.get_ref().as_table()?;
    let wrong =
        |span: Range<usize>, expected: &str| ReadOutcome::Wrong(Wrong { span, expected: expected.to_owned(), what: None });
    if let Some((key, _)) = table.iter().find(|(key, _)| key.get_ref() != TEXTURE.key) {
        return Some(Ok(ReadOutcome::Unknown(key, vec![Entry { parameter: TEXTURE, looks: Looks::Text }])));
    }
    match table.get(TEXTURE.key) {
        Some(name) => match name.get_ref().as_str() {
            Some(name) => Some(Err(name.to_owned())),
            None => Some(Ok(wrong(name.span(), "text in quotes"))),
        },
        None => Some(Ok(ReadOutcome::Missing(TEXTURE.key))),
    }
}

fn list<'t>(given: &'t Spanned<DeValue<'t>>, expected: impl Fn() -> String) -> Result<&'t DeArray<'t>, Wrong> {
    given.get_ref().as_array().ok_or_else(|| Wrong { span: given.span(), expected: expected(), what: None })
}

/// A list of a fixed length.
fn exactly<'t, T: Copy + Default, const N: usize>(
    given: &'t Spanned<DeValue<'t>>,
    read: impl Fn(&DeValue) -> Option<T>,
    expected: &str,
) -> Result<[T; N], Wrong> {
    let list = list(given, || format!("a list of {N}"))?;
    if list.len() != N {
        return Err(Wrong {
            span: given.span(),
            expected: format!("a list of {N}"),
            what: Some(format!("{} values", list.len())),
        });
    }
    let mut values = [T::default(); N];
    for (slot, item) in values.iter_mut().zip(list.iter()) {
        let wrong = || Wrong { span: item.span(), expected: expected.to_owned(), what: None };
        *slot = read(item.get_ref()).ok_or_else(wrong)?;
    }
    Ok(values)
}

fn numbers<const N: usize>(given: &Spanned<DeValue>) -> Result<[f64; N], Wrong> {
    exactly(given, read_number, "a number")
}

fn rows_of(given: &Spanned<DeValue>) -> Result<[[f64; 4]; 4], Wrong> {
    let rows = list(given, || "a list of 4".to_owned())?;
    if rows.len() != 4 {
        return Err(Wrong {
            span: given.span(),
            expected: "a list of 4".to_owned(),
            what: Some(format!("{} values", rows.len())),
        });
    }
    let mut matrix = [[0.0; 4]; 4];
    for (row, given) in matrix.iter_mut().zip(rows.iter()) {
        *row = numbers(given)?;
    }
    Ok(matrix)
}

/// A list of any length.
fn each<'t, T>(
    given: &'t Spanned<DeValue<'t>>,
    read: impl Fn(&'t Spanned<DeValue<'t>>) -> Result<T, Wrong>,
) -> Result<Vec<T>, Wrong> {
    list(given, || "a list [ … ]".to_owned())?.iter().map(read).collect()
}
