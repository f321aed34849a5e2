//! Exposure and tone map. Neither restarts the render.
use egui::{ComboBox, Slider, Ui};
use noisefall::render::{Display, ToneMap};

use crate::viewer::widgets::style::{controls, row};

pub fn show(ui: &mut Ui, display: &mut Display) {
    controls(ui, "display", |ui| {
        row(ui, "Exposure", "Exposure in stops. One more doubles the brightness. ([ and ])", |ui, label| {
            let slider = Slider::new(&mut display.exposure, -10.0..=10.0).step_by(0.1).fixed_decimals(1).suffix(" EV");
            ui.add(slider).labelled_by(label);
        });
        row(ui, "Tone map", "Maps radiance, which has no upper bound, to display light.", |ui, label| {
            let tone_map = &mut display.tone_map;
            let combo = ComboBox::from_id_salt("Tone map").selected_text(tone_map.title()).show_ui(ui, |ui| {
                for (map, word) in ToneMap::ALL.map(|map| (map, map.word())) {
                    ui.selectable_value(tone_map, map, word.title).on_hover_text(word.doc);
                }
            });
            combo.response.labelled_by(label);
        });
    });
    ui.add_space(8.0);
}
