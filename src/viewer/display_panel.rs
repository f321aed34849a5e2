//! How the picture is shown. None of this restarts the render.
use egui::{ComboBox, Slider};
use noisefall::render::ToneMap;

use super::app::{App, row};

impl App {
    pub(super) fn display_panel(&mut self, ui: &mut egui::Ui) {
        egui::Grid::new("display").num_columns(2).spacing([12.0, 8.0]).show(ui, |ui| {
            row(ui, "Exposure", "In stops: one more is twice as bright. Keys [ and ].", |ui| {
                ui.add(Slider::new(&mut self.display.exposure, -10.0..=10.0).step_by(0.1).fixed_decimals(1).suffix(" EV"));
            });
            row(ui, "Tone map", "How radiance, which has no upper bound, becomes display light.", |ui| {
                let tone_map = &mut self.display.tone_map;
                ComboBox::from_id_salt("Tone map").selected_text(tone_map.name()).show_ui(ui, |ui| {
                    for (map, name, doc) in ToneMap::ALL {
                        ui.selectable_value(tone_map, map, name).on_hover_text(doc);
                    }
                });
            });
        });
    }
}
