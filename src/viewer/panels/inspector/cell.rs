//! Controls for values, by type.
use egui::{ComboBox, Id, Ui};
use glam::DVec3;
use noisefall_base::declare::{OwnedValue, Parameter, Path, Range, Textured, Value, Word, check_value};

use super::{Request, Surroundings, numbers::Numbers, references};
use crate::viewer::widgets::{
    colour_edit, committed_text,
    counted::counted,
    list::{explained, value_entry},
};

/// The control of a value, and its result.
pub struct Cell<'a> {
    pub parameter: &'a Parameter,
    pub path: &'a Path,
    pub surroundings: &'a Surroundings<'a>,
    /// Whether the value is a name that may be absent.
    pub is_optional_name: bool,
    pub request: Option<Request>,
    /// Whether the default value is asked for.
    pub resets: std::cell::Cell<bool>,
}

impl Cell<'_> {
    /// Shows the value and records the requested change.
    pub fn show(&mut self, ui: &mut Ui, label: Id, value: &Value<'_>) {
        match value {
            Value::Number(number, range) => {
                let new = self.numbers(label).number(ui, **number, range, &|x| Value::Number(x, *range));
                self.set(new.map(OwnedValue::Number));
            }
            Value::Count(count, range) => {
                let new = self.numbers(label).count(ui, **count, range);
                self.set(new.map(OwnedValue::Count));
            }
            Value::Flag(flag) => {
                let mut new = **flag;
                let is_changed = ui.checkbox(&mut new, "").labelled_by(label).changed();
                self.set(is_changed.then_some(OwnedValue::Flag(new)));
            }
            Value::Text(text) => self.text(ui, label, text, 180.0),
            Value::File(text) => self.file(ui, label, text),
            Value::Name(name, family) => {
                let (surroundings, is_optional) = (self.surroundings, self.is_optional_name);
                self.request = references::names(ui, label, Some(name.as_str()), *family, surroundings, is_optional, self.path);
            }
            Value::Colour(rgb, range) => {
                let new = self.colour(ui, label, **rgb, range);
                self.set(new.map(OwnedValue::Colour));
            }
            Value::Textured(textured, range) => self.textured(ui, label, textured, range),
            Value::TexturedNumber(textured, range) => self.textured_number(ui, label, textured, range),
            Value::Point(v) => {
                let (parameter, size) = (self.parameter, self.surroundings.size);
                let check = |v: DVec3| check_value(parameter, &Value::Point(&mut v.clone()));
                let new = self.numbers(label).metres(ui, **v, size, &check);
                self.set(new.map(OwnedValue::Vector));
            }
            Value::Vector(v) => {
                let size = if self.parameter.unit == "m" { self.surroundings.size } else { 5.0 };
                let new = self.numbers(label).metres(ui, **v, size, &|_| None);
                self.set(new.map(OwnedValue::Vector));
            }
            Value::Factors(v) => {
                let new = self.numbers(label).factors(ui, **v);
                self.set(new.map(OwnedValue::Vector));
            }
            Value::Pair(pair) => {
                let new = self.numbers(label).pair(ui, **pair);
                self.set(new.map(OwnedValue::Pair));
            }
            Value::Counts(counts) => {
                let new = self.numbers(label).counts(ui, **counts);
                self.set(new.map(OwnedValue::Counts));
            }
            Value::Matrix(rows) => {
                let new = self.numbers(label).matrix(ui, **rows);
                self.set(new.map(OwnedValue::Matrix));
            }
            Value::Points(points) => _ = ui.weak(format!("{}, in the file", counted(points.len(), "point"))),
            Value::Triangles(triangles) => _ = ui.weak(format!("{}, in the file", counted(triangles.len(), "triangle"))),
            Value::Word(place, words) => self.word(ui, label, **place, words),
        }
    }

    fn set(&mut self, value: Option<OwnedValue>) {
        self.request = value.map(|value| Request::Set { path: self.path.clone(), value });
    }

    fn numbers(&self, label: Id) -> Numbers<'_> {
        Numbers { parameter: self.parameter, label, resets: &self.resets }
    }

    fn colour(&mut self, ui: &mut Ui, label: Id, rgb: [f64; 3], range: &Range) -> Option<[f64; 3]> {
        let mut new = rgb;
        // Only light has a unit.
        let is_light = self.parameter.unit.starts_with('W');
        colour_edit::show(ui, label, &mut new, range.most, is_light);
        let typed = self.numbers(label).colour(ui, new, range);
        Some(typed.unwrap_or(new)).filter(|new| *new != rgb)
    }

    fn textured(&mut self, ui: &mut Ui, label: Id, textured: &Textured, range: &Range) {
        let set = |textured| Some(OwnedValue::Textured(textured));
        let chosen = match textured {
            Textured::Constant(rgb) => {
                let new = self.colour(ui, label, *rgb, range);
                self.set(new.and_then(|rgb| set(Textured::Constant(rgb))));
                references::map_button(ui, label, self.surroundings)
            }
            Textured::Texture(name) => references::textures(ui, label, name, self.surroundings),
        };
        self.choose_texture(chosen, &|name| OwnedValue::Textured(name.map_or(Textured::grey(0.5), Textured::Texture)));
    }

    fn textured_number(&mut self, ui: &mut Ui, label: Id, textured: &Textured<f64>, range: &Range) {
        let set = |textured| Some(OwnedValue::TexturedNumber(textured));
        let chosen = match textured {
            Textured::Constant(number) => {
                let new = self.numbers(label).number(ui, *number, range, &|x| Value::Number(x, *range));
                self.set(new.and_then(|number| set(Textured::Constant(number))));
                references::map_button(ui, label, self.surroundings)
            }
            Textured::Texture(name) => references::textures(ui, label, name, self.surroundings),
        };
        let middle = 0.5f64.clamp(range.least, range.most);
        self.choose_texture(chosen, &|name| {
            OwnedValue::TexturedNumber(name.map_or(Textured::Constant(middle), Textured::Texture))
        });
    }

    fn choose_texture(&mut self, chosen: Option<references::ValueSource>, value: &dyn Fn(Option<String>) -> OwnedValue) {
        match chosen {
            Some(references::ValueSource::Constant) => self.set(Some(value(None))),
            Some(references::ValueSource::Texture(name)) => self.set(Some(value(Some(name)))),
            Some(references::ValueSource::Shown(request)) => self.request = Some(request),
            Some(references::ValueSource::New(kind)) => {
                self.request = Some(Request::NewTexture { path: self.path.clone(), kind });
            }
            Some(references::ValueSource::File) => self.request = Some(Request::BrowseTexture { path: self.path.clone() }),
            None => {}
        }
    }

    fn text(&mut self, ui: &mut Ui, label: Id, text: &str, width: f32) {
        let entered = committed_text::show(ui, label, text, width).entered;
        self.set(entered.map(OwnedValue::Text));
    }

    fn file(&mut self, ui: &mut Ui, label: Id, text: &str) {
        self.text(ui, label, text, 110.0);
        if ui.button("Browse…").on_hover_text("Chooses the file in a dialog.").clicked() {
            self.request = Some(Request::BrowseFile { path: self.path.clone() });
        }
    }

    fn word(&mut self, ui: &mut Ui, label: Id, place: usize, words: &[Word]) {
        let mut new = place;
        let combo = ComboBox::from_id_salt("word").selected_text(words[place].title).show_ui(ui, |ui| {
            for (at, word) in words.iter().enumerate() {
                explained(value_entry(ui, &mut new, at, word.title), word.doc);
            }
        });
        combo.response.labelled_by(label);
        self.set((new != place).then(|| OwnedValue::Word(words[new].name)));
    }
}
