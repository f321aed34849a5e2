//! The control of a setting, by the values that it takes.
use egui::{Id, Ui};
use noisefall_base::declare::{Accepted, Datum};
use noisefall_scene::scene::{RenderSettings, Setting};

use super::{kinds::choice_list, number, style::choices};

/// More words than these are in a drop-down list.
const MOST_BUTTONS: usize = 3;

/// Shows the control of a setting and lets the user change it.
pub fn show(ui: &mut Ui, label: Id, setting: Setting, settings: &mut RenderSettings) {
    let before = setting.datum(settings);
    let mut now = before.clone();
    match (setting.accepted(), &mut now) {
        (Accepted::Words(words), Datum::Word(name)) => {
            let all: Vec<_> = words.iter().map(|word| (word.name, word.title, word.doc)).collect();
            let Some(mut chosen) = words.iter().map(|word| word.name).find(|word| word == name) else { return };
            if all.len() > MOST_BUTTONS {
                choice_list(ui, label, &mut chosen, &all);
            } else {
                choices(ui, &mut chosen, &all);
            }
            chosen.clone_into(name);
        }
        (_, Datum::Flag(on)) => drop(ui.checkbox(on, "").labelled_by(label)),
        (Accepted::OptionalCount, Datum::Count(count)) => {
            let none = setting.labelled_value(&RenderSettings::default());
            let [first, most] = setting.counts;
            number::optional(ui, label, count, (&none, setting.parameter.unit), first, 0, 0.0..=most.into());
        }
        (_, Datum::Count(Some(count))) => {
            let field = number::field(ui, count, 0, 0.0..=setting.counts[1].into());
            ui.add(field).labelled_by(label);
        }
        _ => {}
    }
    if now != before {
        // The controls give values that the setting takes.
        let _ = setting.read(settings, &now.to_string());
    }
}
