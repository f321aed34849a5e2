//! Reads a description from the tables of a scene file, with every error on the way.
mod choice;
mod reader;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use self::reader::{Reader, TableFrame};
use super::{
    damage::Damage,
    diagnostic::{SceneError, SourceText},
    values::{ReadOutcome, Wrong, read_value},
    wording::{expected_word, found, found_text, text_at, unknown},
};
use noisefall_base::declare::{Choice, Declare, Entry, Form, Looks, Parameter, Parameters, Value, check_value};

/// Reads `description` from the table of a whole file. Values that cannot be read stay as they are.
pub fn read(description: &mut dyn Declare, table: &Spanned<DeTable>, source: &SourceText) -> (Damage, Vec<SceneError>) {
    let mut reader = Reader::new(table.get_ref(), source);
    description.parameters(&mut reader);
    reader.close();
    (reader.damage, reader.errors)
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
            ReadOutcome::Read => {
                if let Some(problem) = check_value(parameter, &value) {
                    let error = source.error(given.span(), problem.message, problem.label);
                    self.fail(if problem.help.is_empty() { error } else { error.with_help(problem.help) });
                }
            }
            ReadOutcome::Wrong(Wrong { span, expected, what }) => {
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
            ReadOutcome::Unknown(key, known) => {
                let error = unknown(source, key.span(), "key", key.get_ref(), &known);
                self.fail(error);
            }
            ReadOutcome::Missing(key) => {
                let error = source.error(given.span(), format!("missing key `{key}`"), format!("`{key}` must be given here"));
                self.fail(error);
            }
            ReadOutcome::NoTexture => {
                let message = format!("`{}` cannot be a texture here", parameter.key);
                let label = "expected a colour: [red, green, blue], or one number for grey";
                self.fail(source.error(given.span(), message, label));
            }
            ReadOutcome::NoWord(known) => {
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
                TableFrame::new(0..0)
            }
        };
        self.descend(path, frame);
    }

    fn leave(&mut self) {
        self.ascend();
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        let is_table = self.frame().table.is_some();
        let given = self.look_up(parameter, Looks::Table).is_some();
        // The next visit of the table records what it looks like.
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
                self.mistake(parameter, value, Some("items"));
                0
            }
        }
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        let list = self.value_at(parameter).and_then(|value| value.get_ref().as_array());
        let item = list.and_then(|list| list.get(index));
        self.descend_to(self.path.key(parameter.key).item(index), parameter, item);
    }

    fn names(&mut self, parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        if self.frame().table.is_none() {
            return now;
        }
        let Some(value) = self.look_up(parameter, Looks::Table) else { return Vec::new() };
        match value.get_ref() {
            DeValue::Table(table) => table.iter().map(|(name, _)| name.get_ref().to_string()).collect(),
            _ => {
                self.mistake(parameter, value, None);
                Vec::new()
            }
        }
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        let tables = self.value_at(parameter).and_then(|value| value.get_ref().as_table());
        let table = tables.and_then(|tables| tables.get(name));
        self.descend_to(self.path.key(parameter.key).key(name), parameter, table);
    }
}
