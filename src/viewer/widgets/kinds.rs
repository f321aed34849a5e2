//! Choices of kinds and words, as their catalogues list them.
use egui::{ComboBox, Id, Response, Ui};
use noisefall::declare::{OneOf, Parameter, Parameters, SliderScale, Value, Words};

use super::{
    list::value_entry,
    number,
    style::{choices, row},
};

/// Buttons in a row for all words of a type.
pub fn words<T: Words>(ui: &mut Ui, chosen: &mut T) {
    let all: Vec<_> = T::words().iter().map(|(word, value)| (*value, word.title, word.doc)).collect();
    choices(ui, chosen, &all);
}

/// A drop-down list of all words of a type, for more of them than a row has room for.
pub fn word_list<T: Words>(ui: &mut Ui, label: Id, chosen: &mut T) {
    let title = |value: T| T::words().iter().find(|(_, other)| *other == value).map_or("", |(word, _)| word.title);
    // The label tells lists apart: each has one of its own.
    let combo = ComboBox::from_id_salt(label).selected_text(title(*chosen)).show_ui(ui, |ui| {
        for (word, value) in T::words() {
            value_entry(ui, chosen, *value, word.title).on_hover_text(word.doc);
        }
    });
    combo.response.labelled_by(label);
}

/// A button for each kind, with the default values of the kind.
pub fn kinds<T: OneOf>(ui: &mut Ui, chosen: &mut T) {
    for kind in T::alternatives() {
        let (about, is_chosen) = (kind.about(), kind.place() == chosen.place());
        let button: Response = ui.selectable_label(is_chosen, about.label()).on_hover_text(about.doc);
        if button.clicked() && !is_chosen {
            *chosen = kind;
        }
    }
}

/// A row for each number that some kind cannot do without. Only those of the chosen kind can be changed; the others stay, so that no
/// row moves.
pub fn number_rows<T: OneOf>(ui: &mut Ui, chosen: &mut T) {
    for mut kind in T::alternatives() {
        let is_chosen = kind.place() == chosen.place();
        let shown = if is_chosen { &mut *chosen } else { &mut kind };
        shown.chosen(&mut NumberRows { ui, is_enabled: is_chosen });
    }
}

/// Sliders do not run over more than this from end to end.
const WIDEST: f64 = 1e6;

struct NumberRows<'u> {
    ui: &'u mut Ui,
    is_enabled: bool,
}

impl Parameters for NumberRows<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let Value::Number(number, range) = value else { return };
        if parameter.is_required {
            row(self.ui, &parameter.label(), parameter.doc, |ui, label| {
                let suffix = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
                let ends = range.least..=range.most;
                if range.most > WIDEST * range.least {
                    let speed = 0.005 * *number;
                    let field = number::field(ui, number, 3, ends).speed(speed).suffix(&suffix);
                    ui.add_enabled(self.is_enabled, field).labelled_by(label);
                } else {
                    let slider = number::slider(ui, number, 3, ends).logarithmic(range.scale == SliderScale::Log);
                    ui.add_enabled(self.is_enabled, slider.suffix(&suffix)).labelled_by(label);
                }
            });
        }
    }
}
