//! Writes a description as TOML that reads as the same description.
use toml::{Table, Value as Toml};

use super::{Choice, Declare, Form, Parameter, Parameters, Textured, Value};

/// Every value of a description, defaults included, at its key.
pub fn write(description: &mut dyn Declare) -> Table {
    let mut writer = Writer { frames: vec![WriterFrame::new(None, Destination::Table)] };
    description.parameters(&mut writer);
    writer.frames.pop().map(|frame| frame.table).unwrap_or_default()
}

struct Writer {
    frames: Vec<WriterFrame>,
}

struct WriterFrame {
    key: Option<&'static str>,
    place: Destination,
    table: Table,
    /// The alternative of a choice that is written by its name.
    name: Option<&'static str>,
}

/// Where a table goes.
enum Destination {
    Table,
    /// A table, or the name of an alternative that has no keys.
    NameOrTable,
    List,
    Named(String),
}

impl WriterFrame {
    fn new(key: Option<&'static str>, place: Destination) -> WriterFrame {
        WriterFrame { key, place, table: Table::new(), name: None }
    }
}

impl Writer {
    fn frame(&mut self) -> &mut WriterFrame {
        self.frames.last_mut().expect("the whole file is around")
    }
}

fn numbers(values: &[f64]) -> Toml {
    Toml::Array(values.iter().map(|x| Toml::Float(*x)).collect())
}

fn counts(values: &[u32]) -> Toml {
    Toml::Array(values.iter().map(|x| Toml::Integer(i64::from(*x))).collect())
}

fn texture(name: &str) -> Toml {
    Toml::Table(Table::from_iter([("texture".to_owned(), Toml::String(name.to_owned()))]))
}

fn as_toml(value: &Value) -> Toml {
    match value {
        Value::Number(number, _) => Toml::Float(**number),
        Value::Count(count, _) => Toml::Integer(i64::from(**count)),
        Value::Flag(flag) => Toml::Boolean(**flag),
        Value::Text(text) | Value::File(text) | Value::Name(text, _) => Toml::String((*text).clone()),
        Value::Colour(rgb, _) => numbers(&rgb[..]),
        Value::Textured(Textured::Constant(rgb), _) => numbers(rgb),
        Value::TexturedNumber(Textured::Constant(number), _) => Toml::Float(*number),
        Value::Textured(Textured::Texture(name), _) | Value::TexturedNumber(Textured::Texture(name), _) => texture(name),
        Value::Point(v) | Value::Vector(v) | Value::Factors(v) => numbers(&v.to_array()),
        Value::Pair(pair) => numbers(&pair[..]),
        Value::Counts(pair) => counts(&pair[..]),
        Value::Matrix(rows) => Toml::Array(rows.iter().map(|row| numbers(row)).collect()),
        Value::Points(points) => Toml::Array(points.iter().map(|point| numbers(point)).collect()),
        Value::Triangles(triangles) => Toml::Array(triangles.iter().map(|corners| counts(corners)).collect()),
        Value::Word(place, words) => Toml::String(words[**place].name.to_owned()),
    }
}

impl Parameters for Writer {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let written = as_toml(&value);
        self.frame().table.insert(parameter.key.to_owned(), written);
    }

    fn enter(&mut self, parameter: &Parameter, form: Form) {
        let place = if form == Form::NameOrTable { Destination::NameOrTable } else { Destination::Table };
        self.frames.push(WriterFrame::new(Some(parameter.key), place));
    }

    fn reads_outlines(&self) -> bool {
        false
    }

    fn leave(&mut self) {
        let Some(WriterFrame { key: Some(key), place, table, name }) = self.frames.pop() else { return };
        let outer = &mut self.frame().table;
        match place {
            Destination::NameOrTable if table.is_empty() => {
                outer.insert(key.to_owned(), Toml::String(name.unwrap_or_default().to_owned()));
            }
            Destination::Table | Destination::NameOrTable => {
                outer.insert(key.to_owned(), Toml::Table(table));
            }
            Destination::List => {
                if let Some(list) = outer.entry(key).or_insert_with(|| Toml::Array(Vec::new())).as_array_mut() {
                    list.push(Toml::Table(table));
                }
            }
            Destination::Named(name) => {
                if let Some(tables) = outer.entry(key).or_insert_with(|| Toml::Table(Table::new())).as_table_mut() {
                    tables.insert(name, Toml::Table(table));
                }
            }
        }
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        self.frame().name = Some(choice.alternatives[now].name);
        now
    }

    fn item(&mut self, parameter: &Parameter, _: usize) {
        self.frames.push(WriterFrame::new(Some(parameter.key), Destination::List));
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.frames.push(WriterFrame::new(Some(parameter.key), Destination::Named(name.to_owned())));
    }
}
