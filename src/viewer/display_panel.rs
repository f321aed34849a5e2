//! How the picture is shown. None of this restarts the render.
use egui::{ComboBox, Slider};
use noisefall::render::ToneMap;

use super::{
    app::App,
    look::{controls, row},
};

impl App {
    pub(super) fn display_panel(&mut self, ui: &mut egui::Ui) {
        controls(ui, "display", |ui| {
            row(ui, "Exposure", "In stops: one more is twice as bright. Keys [ and ].", |ui, label| {
                let slider =
                    Slider::new(&mut self.look.display.exposure, -10.0..=10.0).step_by(0.1).fixed_decimals(1).suffix(" EV");
                ui.add(slider).labelled_by(label);
            });
            row(ui, "Tone map", "How radiance, which has no upper bound, becomes display light.", |ui, label| {
                let tone_map = &mut self.look.display.tone_map;
                let combo = ComboBox::from_id_salt("Tone map").selected_text(tone_map.name()).show_ui(ui, |ui| {
                    for (map, name, doc) in ToneMap::ALL {
                        ui.selectable_value(tone_map, map, name).on_hover_text(doc);
                    }
                });
                combo.response.labelled_by(label);
            });
        });
        ui.add_space(8.0);
        self.view_rows(ui);
    }
}
