//! Reads a description from the tables of a scene file, with every error on the way.
mod choice;

use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{
    damage::Damage,
    diagnostic::{SceneError, SourceText},
    values::{Found, Wrong, read_value},
    wording::{expected_word, found, found_text, suggestion, text_at, unknown},
};
use crate::declare::{Choice, Declare, Entry, Form, Looks, Parameter, Parameters, Path, Value, check_value};

/// Reads `description` from the table of a whole file. Values that cannot be read stay as they are.
pub fn read(description: &mut dyn Declare, table: &Spanned<DeTable>, source: &SourceText) -> (Damage, Vec<SceneError>) {
    let top = Frame { table: Some(table.get_ref()), ..Frame::new(0..0) };
    let mut reader = Reader {
        source,
        frames: vec![top],
        path: Path::default(),
        lengths: Vec::new(),
        damage: Damage::default(),
        errors: Vec::new(),
    };
    description.parameters(&mut reader);
    reader.close();
    (reader.damage, reader.errors)
}

struct Reader<'t> {
    source: &'t SourceText,
    /// The tables around, the innermost last.
    frames: Vec<Frame<'t>>,
    path: Path,
    /// Lengths of the paths of the enclosing tables.
    lengths: Vec<usize>,
    damage: Damage,
    errors: Vec<SceneError>,
}

/// A table while it is read.
struct Frame<'t> {
    /// `None` if there is no table, or another item in its place.
    table: Option<&'t DeTable<'t>>,
    span: Range<usize>,
    /// Another item in the place of the table.
    mistaken: Option<(&'t Spanned<DeValue<'t>>, &'static str, Form)>,
    /// A name stands in the place of the table.
    name: Option<&'t Spanned<DeValue<'t>>>,
    /// Keys that the declaration has visited.
    known: Vec<Entry>,
    /// The choice of the table, if it holds nothing else.
    choice: Option<&'static str>,
    /// Errors that count only if no key is unknown: a missing key may be misspelled.
    missing: Vec<SceneError>,
    /// Nothing of its choice is given: what an alternative would need is not missing besides.
    chooses_nothing: bool,
    is_damaged: bool,
}

impl<'t> Frame<'t> {
    fn new(span: Range<usize>) -> Frame<'t> {
        Frame {
            table: None,
            span,
            mistaken: None,
            name: None,
            known: Vec::new(),
            choice: None,
            missing: Vec::new(),
            chooses_nothing: false,
            is_damaged: false,
        }
    }
}

impl<'t> Reader<'t> {
    fn frame(&mut self) -> &mut Frame<'t> {
        self.frames.last_mut().expect("the whole file is around")
    }

    fn look_up(&mut self, parameter: &Parameter, looks: Looks) -> Option<&'t Spanned<DeValue<'t>>> {
        let is_full = self.is_full();
        let frame = self.frame();
        frame.known.push(Entry { parameter: *parameter, looks });
        frame.table.filter(|_| !is_full).and_then(|table| table.get(parameter.key))
    }

    /// Whether there are as many errors as are told: each further one would cost a look at the whole text.
    fn is_full(&self) -> bool {
        self.errors.len() >= SceneError::MOST
    }

    fn fail(&mut self, error: SceneError) {
        self.frame().is_damaged = true;
        self.damage.left_out(&self.path);
        if self.errors.len() < SceneError::MOST {
            self.errors.push(error);
        }
    }

    fn miss(&mut self, parameter: &Parameter) {
        let (span, source) = (self.frame().span.clone(), self.source);
        if self.frame().table.is_some() && !self.frame().chooses_nothing && !self.is_full() {
            let key = parameter.key;
            let given = if key == "format" { "format = 1" } else { key };
            let error = source.error(span, format!("missing key `{key}`"), format!("`{given}` must be given here"));
            self.frame().missing.push(error);
        }
    }

    fn descend(&mut self, path: Path, frame: Frame<'t>) {
        self.lengths.push(self.path.0.len());
        self.path = path;
        self.frames.push(frame);
    }

    /// A frame for a value where a table is expected.
    fn table_in(&mut self, key: &'static str, value: &'t Spanned<DeValue<'t>>, form: Form) -> Frame<'t> {
        let frame = Frame::new(value.span());
        if self.is_full() {
            return frame;
        }
        match value.get_ref() {
            DeValue::Table(table) => Frame { table: Some(table), ..frame },
            DeValue::String(_) if form == Form::NameOrTable => Frame { name: Some(value), ..frame },
            _ => Frame { mistaken: Some((value, key, form)), ..frame },
        }
    }

    /// Reports the errors of the innermost table as a whole, and leaves it.
    fn close(&mut self) {
        let frame = self.frames.pop().expect("a table that was entered");
        if self.is_full() {
            return;
        }
        let source = self.source;
        let mut errors = Vec::new();
        if let Some((value, key, form)) = frame.mistaken {
            errors.push(wrong_table(source, key, value, form, &frame));
        }
        for (key, _) in frame.table.into_iter().flatten() {
            if errors.len() >= SceneError::MOST {
                break;
            }
            if !frame.known.iter().any(|entry| entry.parameter.key == key.get_ref()) {
                let what = if frame.choice.is_some() { "kind" } else { "key" };
                errors.push(unknown(source, key.span(), what, key.get_ref(), &frame.known));
            }
        }
        if errors.is_empty() && !frame.is_damaged {
            errors = frame.missing;
        }
        let is_damaged = frame.is_damaged || !errors.is_empty();
        if !errors.is_empty() {
            self.damage.left_out(&self.path);
            let room = SceneError::MOST.saturating_sub(self.errors.len());
            self.errors.extend(errors.into_iter().take(room));
        }
        if let Some(outer) = self.frames.last_mut() {
            outer.is_damaged |= is_damaged && outer.choice.is_some();
        }
    }
}

/// The error of a value in the place of a table.
fn wrong_table(source: &SourceText, key: &str, value: &Spanned<DeValue>, form: Form, frame: &Frame) -> SceneError {
    let text = text_at(source, &value.span());
    let found = found(value.get_ref(), text);
    if frame.choice == Some("items") {
        let error =
            source.error(value.span(), format!("`{key}`: expected a list of tables, found {found}"), "expected a list of tables");
        return error.with_help(format!("each item has its own table: write `[[{key}]]`"));
    }
    let meant = suggestion(value.get_ref(), text, &frame.known);
    let expected = if form == Form::NameOrTable { "a name in quotes, or a table { … }" } else { "a table { … }" };
    let label = meant.map_or_else(|| format!("expected {expected}"), |meant| format!("write {meant}"));
    source.error(value.span(), format!("`{key}`: expected {expected}, found {found}"), label)
}

impl Parameters for Reader<'_> {
    fn value(&mut self, parameter: &Parameter, mut value: Value<'_>) {
        let looks = Looks::of(&value);
        let Some(given) = self.look_up(parameter, looks) else {
            if parameter.is_required {
                self.miss(parameter);
            }
            return;
        };
        let source = self.source;
        match read_value(given, &mut value) {
            Found::Read => {
                if let Some(problem) = check_value(parameter, &value) {
                    let error = source.error(given.span(), problem.message, problem.label);
                    self.fail(if problem.help.is_empty() { error } else { error.with_help(problem.help) });
                }
            }
            Found::Wrong(Wrong { span, expected, what }) => {
                let text = text_at(source, &span);
                let whole = span == given.span();
                let what = what.unwrap_or_else(|| if whole { found(given.get_ref(), text) } else { found_text(text) });
                let message = format!("`{}`: expected {expected}, found {what}", parameter.key);
                let textured = matches!(value, Value::Textured(..) | Value::TexturedNumber(..)) && given.get_ref().is_str();
                let label = if textured { format!("write {{ texture = {text} }}") } else { format!("expected {expected}") };
                let error = source.error(span, message, label);
                let advice = parameter.advice;
                self.fail(if advice.is_empty() { error } else { error.with_help(advice) });
            }
            Found::Unknown(key, known) => {
                let error = unknown(source, key.span(), "key", key.get_ref(), &known);
                self.fail(error);
            }
            Found::Missing(key) => {
                let error = source.error(given.span(), format!("missing key `{key}`"), format!("`{key}` must be given here"));
                self.fail(error);
            }
            Found::NoTexture => {
                let message = format!("`{}` cannot be a texture here", parameter.key);
                let label = "expected a colour: [red, green, blue], or one number for grey";
                self.fail(source.error(given.span(), message, label));
            }
            Found::NoWord(known) => {
                let word = given.get_ref().as_str().unwrap_or_default();
                let error = unknown(source, given.span(), "value", word, &known.iter().map(expected_word).collect::<Vec<_>>());
                self.fail(error);
            }
        }
    }

    fn enter(&mut self, parameter: &Parameter, form: Form) {
        let path = self.path.key(parameter.key);
        let frame = match self.look_up(parameter, Looks::Table) {
            Some(value) => self.table_in(parameter.key, value, form),
            None => {
                if parameter.is_required {
                    self.miss(parameter);
                }
                Frame::new(0..0)
            }
        };
        self.descend(path, frame);
    }

    fn leave(&mut self) {
        self.close();
        self.path.0.truncate(self.lengths.pop().unwrap_or(0));
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        let is_table = self.frame().table.is_some();
        let given = self.look_up(parameter, Looks::Table).is_some();
        // What is visited next says what it looks like.
        if given {
            self.frame().known.pop();
        }
        if is_table { given } else { now }
    }

    fn given(&mut self, parameter: &Parameter) -> bool {
        self.present(parameter, true)
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let entries: Vec<Entry> =
            choice.alternatives.iter().flat_map(|alternative| alternative.outline.iter().copied()).collect();
        let frame = self.frame();
        if frame.known.is_empty() {
            frame.choice = Some(choice.what);
        }
        frame.known.extend(entries);
        if let Some(value) = frame.name {
            return self.choose_by_name(choice, value, now);
        }
        match frame.table {
            Some(table) => self.choose_by_keys(choice, table, now),
            None => now,
        }
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        if self.frame().table.is_none() {
            return now;
        }
        let Some(value) = self.look_up(parameter, Looks::List) else { return 0 };
        match value.get_ref() {
            DeValue::Array(array) => array.len(),
            _ => {
                let frame = Frame {
                    mistaken: Some((value, parameter.key, Form::Table)),
                    choice: Some("items"),
                    ..Frame::new(value.span())
                };
                self.descend(self.path.key(parameter.key), frame);
                self.leave();
                0
            }
        }
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        let path = self.path.key(parameter.key).item(index);
        let list = self.frame().table.and_then(|table| table.get(parameter.key)).and_then(|value| value.get_ref().as_array());
        let frame = match list.and_then(|list| list.get(index)) {
            Some(value) => self.table_in(parameter.key, value, Form::Table),
            None => Frame::new(0..0),
        };
        self.descend(path, frame);
    }

    fn names(&mut self, parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        if self.frame().table.is_none() {
            return now;
        }
        let Some(value) = self.look_up(parameter, Looks::Table) else { return Vec::new() };
        match value.get_ref() {
            DeValue::Table(table) => table.iter().map(|(name, _)| name.get_ref().to_string()).collect(),
            _ => {
                let frame = Frame { mistaken: Some((value, parameter.key, Form::Table)), ..Frame::new(value.span()) };
                self.descend(self.path.key(parameter.key), frame);
                self.leave();
                Vec::new()
            }
        }
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        let path = self.path.key(parameter.key).key(name);
        let tables = self.frame().table.and_then(|table| table.get(parameter.key)).and_then(|value| value.get_ref().as_table());
        let frame = match tables.and_then(|tables| tables.get(name)) {
            Some(value) => self.table_in(parameter.key, value, Form::Table),
            None => Frame::new(0..0),
        };
        self.descend(path, frame);
    }
}
