//! Choices of kinds and words, as their catalogues list them.
use std::collections::HashMap;

use egui::{ComboBox, Id, Response, Ui};
use noisefall_base::declare::{OneOf, Parameter, Parameters, SliderScale, Value};

use super::{
    list::{explained, value_entry},
    number,
    slider::{self, Scale},
    style::row,
};

/// A drop-down list to choose one of several values, with their names and tooltips.
pub fn choice_list<T: Copy + PartialEq>(ui: &mut Ui, label: Id, chosen: &mut T, all: &[(T, &str, &str)]) {
    let title = all.iter().find(|(value, ..)| value == chosen).map_or("", |(_, title, _)| title);
    // The label tells lists apart: each has one of its own.
    let combo = ComboBox::from_id_salt(label).selected_text(title).show_ui(ui, |ui| {
        for (value, title, doc) in all {
            explained(value_entry(ui, chosen, *value, *title), doc);
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

/// An entry of a list for each kind, with the default values of the kind.
pub fn kind_list<T: OneOf>(ui: &mut Ui, chosen: &mut T) {
    let mut place = chosen.place();
    for (at, kind) in T::alternatives().into_iter().enumerate() {
        let (before, about) = (place, kind.about());
        explained(value_entry(ui, &mut place, at, about.label()), about.doc);
        if place != before {
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
        let mut defaults = Defaults::default();
        if let Some(fresh) = T::alternatives().get_mut(shown.place()) {
            fresh.chosen(&mut defaults);
        }
        shown.chosen(&mut NumberRows { ui, is_enabled: is_chosen, defaults });
    }
}

/// Sliders do not run over more than this from end to end.
const WIDEST: f64 = 1e6;

/// The numbers of a new kind, by key.
#[derive(Default)]
struct Defaults(HashMap<&'static str, f64>);

impl Parameters for Defaults {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        if let Value::Number(number, _) = value {
            self.0.insert(parameter.key, *number);
        }
    }
}

struct NumberRows<'u> {
    ui: &'u mut Ui,
    is_enabled: bool,
    defaults: Defaults,
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
                    let is_logarithmic = range.scale == SliderScale::Log;
                    let scale = Scale { range: ends.clone(), is_logarithmic };
                    let default = self.defaults.0.get(parameter.key).copied().unwrap_or(*number);
                    slider::show(ui, number, &scale, default, |ui, number| {
                        let slider = number::slider(ui, number, 3, ends).logarithmic(is_logarithmic);
                        ui.add_enabled(self.is_enabled, slider.suffix(&suffix)).labelled_by(label)
                    });
                }
            });
        }
    }
}
