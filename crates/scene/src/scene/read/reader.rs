//! The tables around the place where a reader is, and the errors of each.
use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::scene::{
    damage::Damage,
    diagnostic::{SceneError, SourceText},
    renamed,
    wording::{found, suggestion, text_at, unknown},
};
use noisefall_base::declare::{Entry, Form, Looks, Parameter, Path};

/// A reader at its place in a file.
pub(super) struct Reader<'t> {
    pub(super) source: &'t SourceText,
    /// The tables around, the innermost last.
    frames: Vec<TableFrame<'t>>,
    pub(super) path: Path,
    /// Lengths of the paths of the enclosing tables.
    lengths: Vec<usize>,
    pub(super) damage: Damage,
    pub(super) errors: Vec<SceneError>,
}

/// A table while it is read.
pub(super) struct TableFrame<'t> {
    /// `None` if there is no table, or another item in its place.
    pub(super) table: Option<&'t DeTable<'t>>,
    pub(super) span: Range<usize>,
    /// Another item in the place of the table.
    mistaken: Option<(&'t Spanned<DeValue<'t>>, &'static str, Form)>,
    /// A name stands in the place of the table.
    pub(super) name: Option<&'t Spanned<DeValue<'t>>>,
    /// Keys that the declaration has visited.
    pub(super) known: Vec<Entry>,
    /// The choice of the table, if it holds nothing else.
    pub(super) choice: Option<&'static str>,
    /// Errors that count only if no key is unknown: a missing key may be misspelled.
    pub(super) missing: Vec<SceneError>,
    /// Nothing of its choice is given: what an alternative would need is not missing besides.
    pub(super) chooses_nothing: bool,
    is_damaged: bool,
}

impl<'t> TableFrame<'t> {
    pub(super) fn new(span: Range<usize>) -> TableFrame<'t> {
        TableFrame {
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
    pub(super) fn new(table: &'t DeTable<'t>, source: &'t SourceText) -> Reader<'t> {
        Reader {
            source,
            frames: vec![TableFrame { table: Some(table), ..TableFrame::new(0..0) }],
            path: Path::default(),
            lengths: Vec::new(),
            damage: Damage::default(),
            errors: Vec::new(),
        }
    }

    pub(super) fn frame(&mut self) -> &mut TableFrame<'t> {
        self.frames.last_mut().expect("the whole file is around")
    }

    pub(super) fn look_up(&mut self, parameter: &Parameter, looks: Looks) -> Option<&'t Spanned<DeValue<'t>>> {
        let is_full = self.is_full();
        let frame = self.frame();
        frame.known.push(Entry { parameter: *parameter, looks });
        let table = frame.table;
        table.filter(|_| !is_full).and_then(|table| self.find(table, parameter.key))
    }

    /// The value of a parameter in the innermost table.
    fn find(&self, table: &'t DeTable<'t>, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        if self.lengths.is_empty() { renamed::value_of(table, key) } else { table.get(key) }
    }

    /// Whether there are as many errors as are told: each further one would cost a look at the whole text.
    fn is_full(&self) -> bool {
        self.errors.len() >= SceneError::MOST
    }

    pub(super) fn fail(&mut self, error: SceneError) {
        self.frame().is_damaged = true;
        self.damage.left_out(&self.path);
        if self.errors.len() < SceneError::MOST {
            self.errors.push(error);
        }
    }

    pub(super) fn miss(&mut self, parameter: &Parameter) {
        let (span, source) = (self.frame().span.clone(), self.source);
        if self.frame().table.is_some() && !self.frame().chooses_nothing && !self.is_full() {
            let key = parameter.key;
            let given = if key == "format" { "format = 1" } else { key };
            let error = source.error(span, format!("missing key `{key}`"), format!("`{given}` must be given here"));
            self.frame().missing.push(error);
        }
    }

    pub(super) fn descend(&mut self, path: Path, frame: TableFrame<'t>) {
        self.lengths.push(self.path.0.len());
        self.path = path;
        self.frames.push(frame);
    }

    /// Enters a table of a list or of named tables, if it is given.
    pub(super) fn descend_to(&mut self, path: Path, parameter: &Parameter, table: Option<&'t Spanned<DeValue<'t>>>) {
        let frame = table.map_or_else(|| TableFrame::new(0..0), |value| self.table_in(parameter.key, value, Form::Table));
        self.descend(path, frame);
    }

    /// Reports a value in the place of a list or of a table of tables.
    pub(super) fn mistake(&mut self, parameter: &Parameter, value: &'t Spanned<DeValue<'t>>, choice: Option<&'static str>) {
        let frame = TableFrame { mistaken: Some((value, parameter.key, Form::Table)), choice, ..TableFrame::new(value.span()) };
        self.descend(self.path.key(parameter.key), frame);
        self.ascend();
    }

    /// Leaves the innermost table.
    pub(super) fn ascend(&mut self) {
        self.close();
        self.path.0.truncate(self.lengths.pop().unwrap_or(0));
    }

    /// The value of a parameter in the innermost table.
    pub(super) fn value_at(&mut self, parameter: &Parameter) -> Option<&'t Spanned<DeValue<'t>>> {
        let table = self.frame().table;
        table.and_then(|table| self.find(table, parameter.key))
    }

    /// A frame for a value where a table is expected.
    pub(super) fn table_in(&mut self, key: &'static str, value: &'t Spanned<DeValue<'t>>, form: Form) -> TableFrame<'t> {
        let frame = TableFrame::new(value.span());
        if self.is_full() {
            return frame;
        }
        match value.get_ref() {
            DeValue::Table(table) => TableFrame { table: Some(table), ..frame },
            DeValue::String(_) if form == Form::NameOrTable => TableFrame { name: Some(value), ..frame },
            _ => TableFrame { mistaken: Some((value, key, form)), ..frame },
        }
    }

    /// Reports the errors of the innermost table as a whole, and leaves it.
    pub(super) fn close(&mut self) {
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
            let is_known = frame.known.iter().any(|entry| entry.parameter.key == key.get_ref())
                || self.lengths.is_empty() && frame.table.is_some_and(|table| renamed::is_read(table, key.get_ref()));
            if !is_known {
                let what = if frame.choice.is_some() { "type" } else { "key" };
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
fn wrong_table(source: &SourceText, key: &str, value: &Spanned<DeValue>, form: Form, frame: &TableFrame) -> SceneError {
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
