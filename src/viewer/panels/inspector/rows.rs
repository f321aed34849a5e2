//! The visitor that makes rows of parameters.
use egui::{ComboBox, Ui};
use noisefall_base::declare::{
    Alternative, Choice, Form, Parameter, Parameters, Path, Textured, Value, capitalised, key_in_words,
};

use super::{
    Request, Surroundings,
    cell::Cell,
    numbers::fits_field,
    references,
    row::{Heading, Mark},
};
use crate::viewer::widgets::list::{explained, value_entry};

/// The visited tables, and the requests so far.
pub struct Rows<'u> {
    ui: &'u mut Ui,
    surroundings: &'u Surroundings<'u>,
    path: Path,
    /// Lengths of the paths of the enclosing tables.
    lengths: Vec<usize>,
    /// The optional parameter that is visited next.
    optional: Option<&'static str>,
    /// A table that was entered and has no title yet: its choice may share the row.
    entered: Option<(Heading, Form)>,
    /// The alternative that was chosen last; its table needs no title.
    chosen: Option<&'static str>,
    requests: Vec<Request>,
}

impl<'u> Rows<'u> {
    pub fn new(ui: &'u mut Ui, path: Path, surroundings: &'u Surroundings<'u>) -> Rows<'u> {
        let (lengths, requests) = (Vec::new(), Vec::new());
        Rows { ui, surroundings, path, lengths, optional: None, entered: None, chosen: None, requests }
    }

    pub fn finish(self) -> Vec<Request> {
        self.requests
    }

    fn descend(&mut self, path: Path) {
        self.lengths.push(self.path.0.len());
        self.path = path;
    }

    /// Shows the title of the table that was entered last.
    fn show_title(&mut self) {
        if let Some((heading, _)) = self.entered.take()
            && self.ui.push_id(&self.path, |ui| heading.title(ui)).inner
        {
            self.requests.push(Request::Remove { path: self.path.clone() });
        }
    }

    fn mark(&mut self, parameter: &Parameter) -> Mark {
        let is_optional = self.optional.take() == Some(parameter.key);
        if is_optional { Mark::Optional(true) } else { Mark::None }
    }
}

impl Parameters for Rows<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.show_title();
        self.chosen = None;
        let (path, mark) = (self.path.key(parameter.key), self.mark(parameter));
        // A name that is absent is an entry of the menu of names.
        let is_optional_name = mark != Mark::None && matches!(value, Value::Name(..));
        let is_number = matches!(value, Value::Number(..) | Value::TexturedNumber(Textured::Constant(_), _));
        let heading = if is_number && fits_field(parameter.unit) { Heading::of } else { Heading::with_unit };
        let heading = heading(parameter, if is_optional_name { Mark::None } else { mark });
        let surroundings = self.surroundings;
        let row = self.ui.push_id(&path, |ui| {
            let mut cell = Cell { parameter, path: &path, surroundings, is_optional_name, request: None, resets: false.into() };
            let is_removed = heading.row(ui, |ui, label| cell.show(ui, label, &value));
            match is_removed {
                true => Some(Request::Remove { path: path.clone() }),
                false if cell.resets.get() => Some(Request::Reset { path: path.clone() }),
                false => cell.request,
            }
        });
        self.requests.extend(row.inner);
    }

    fn enter(&mut self, parameter: &Parameter, form: Form) {
        self.show_title();
        let (is_kind, mark) = (self.chosen.take() == Some(parameter.key), self.mark(parameter));
        self.entered = (!is_kind).then(|| (Heading::of(parameter, mark), form));
        self.descend(self.path.key(parameter.key));
    }

    fn leave(&mut self) {
        self.show_title();
        self.path.0.truncate(self.lengths.pop().unwrap_or(0));
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        if now {
            self.optional = Some(parameter.key);
            return true;
        }
        self.show_title();
        let path = self.path.key(parameter.key);
        let surroundings = self.surroundings;
        let request = self.ui.push_id(&path, |ui| match references::family_of(parameter) {
            Some(family) => {
                let mut request = None;
                Heading::of(parameter, Mark::None).row(ui, |ui, label| {
                    request = references::names(ui, label, None, family, surroundings, true, &path);
                });
                request
            }
            None => {
                let is_given = Heading::of(parameter, Mark::Optional(false)).row(ui, |_, _| {});
                is_given.then(|| Request::Insert { path: path.clone() })
            }
        });
        self.requests.extend(request.inner);
        false
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        // The part itself is of that kind.
        let title = if self.lengths.is_empty() { "Type".to_owned() } else { capitalised(&key_in_words(choice.what)) };
        let of_choice = || Heading { title, tooltip: format!("The type of {}.", choice.what), mark: Mark::None };
        let (mut heading, form) = self.entered.take().unwrap_or_else(|| (of_choice(), Form::Table));
        if form == Form::NameOrTable {
            // It keeps its default if its key is absent, so there is nothing to remove.
            heading.mark = if heading.mark == Mark::Item { Mark::Item } else { Mark::None };
        }
        let mut place = now;
        let is_removed = self.ui.push_id((&self.path, choice.what), |ui| {
            heading.row(ui, |ui, label| {
                let name = |place: usize| words(&choice.alternatives[place]);
                let combo = ComboBox::from_id_salt("choice").selected_text(name(now)).show_ui(ui, |ui| {
                    for (at, alternative) in choice.alternatives.iter().enumerate() {
                        let entry = value_entry(ui, &mut place, at, name(at));
                        if let [only] = &alternative.outline[..] {
                            explained(entry, only.parameter.doc);
                        }
                    }
                });
                combo.response.labelled_by(label);
            })
        });
        if is_removed.inner {
            self.requests.push(Request::Remove { path: self.path.clone() });
        } else if place != now {
            let name = choice.alternatives[place].name;
            self.requests.push(Request::Choose { path: self.path.clone(), choice: choice.what, name });
        }
        self.chosen = Some(choice.alternatives[now].name);
        now
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        self.show_title();
        let path = self.path.key(parameter.key);
        let mut is_added = false;
        self.ui.push_id(&path, |ui| {
            Heading::of(parameter, Mark::None).row(ui, |ui, label| {
                is_added = ui.button("Add").labelled_by(label).on_hover_text("Adds an item to the list.").clicked();
                if now == 0 {
                    ui.weak("none");
                }
            })
        });
        if is_added {
            self.requests.push(Request::Insert { path: path.item(now) });
        }
        now
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        self.show_title();
        self.chosen = None;
        let title = format!("{} {}", capitalised(&key_in_words(parameter.key)), index + 1);
        self.entered = Some((Heading { title, tooltip: parameter.doc.to_owned(), mark: Mark::Item }, Form::Table));
        self.descend(self.path.key(parameter.key).item(index));
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.show_title();
        self.descend(self.path.key(parameter.key).key(name));
    }
}

/// The name of an alternative in words: its title, or else its key.
fn words(alternative: &Alternative) -> String {
    let mut letters = alternative.title.chars();
    let first = letters.next().map(|first| first.to_lowercase().to_string());
    first.map_or_else(|| alternative.name.replace('_', " "), |first| first + letters.as_str())
}
