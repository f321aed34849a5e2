//! Which view of the picture is shown, and what it is held against.
use egui::{ComboBox, Ui};
use noisefall::render::{colour_map::ColourMap, view::View};

use super::{
    app::App,
    loader::DroppedTruth,
    look::{controls, row},
};

impl App {
    /// The list of views.
    pub(super) fn view_choice(&mut self, ui: &mut Ui) {
        let view = &mut self.look.view;
        let combo = ComboBox::from_id_salt("View").selected_text(view.name()).width(150.0).height(400.0).show_ui(ui, |ui| {
            for (of, name, doc) in View::ALL {
                ui.selectable_value(view, of, name).on_hover_text(doc);
            }
        });
        let label = ui.label("View").on_hover_text("What of the picture is shown. Never restarts the render. (V: the next one)");
        combo.response.labelled_by(label.id);
    }

    /// Rows of the display panel about views.
    pub(super) fn view_rows(&mut self, ui: &mut Ui) {
        controls(ui, "views", |ui| {
            row(
                ui,
                "Colours",
                "How views that are numbers get colours; differences and scores have a scale of their own.",
                |ui, _| {
                    ui.horizontal(|ui| {
                        for (map, name, doc) in ColourMap::CHOICE {
                            ui.selectable_value(&mut self.look.map, map, name).on_hover_text(doc);
                        }
                    });
                },
            );
            row(
                ui,
                "Pinned",
                "A picture to hold others against: the view Difference shows radiance less the pinned one.",
                |ui, _| {
                    ui.horizontal(|ui| {
                        let can = self.shown.as_ref().is_some_and(|frame| !frame.is_coarse());
                        if ui.add_enabled(can, egui::Button::new("Pin this")).clicked() {
                            self.pinned = self.shown.clone();
                        }
                        match &self.pinned {
                            Some(pinned) => drop(ui.weak(format!("{} spp", pinned.spp))),
                            None => drop(ui.weak("nothing yet")),
                        }
                    });
                },
            );
            row(ui, "Truth", "What the picture must converge to, for the true error and z-scores.", |ui, _| self.truth_row(ui));
        });
    }

    fn truth_row(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| match (&self.dropped_truth, self.opened.as_ref().and_then(|opened| opened.truth.as_ref())) {
            (Some(DroppedTruth { name, .. }), _) => {
                super::look::elided(ui, 120.0, name.as_str()).on_hover_text(name.as_str());
                if ui.small_button("Drop").on_hover_text("Go back to what the scene says").clicked() {
                    self.dropped_truth = None;
                }
            }
            (None, Some(_)) if self.truth_here().is_some() => drop(ui.weak("as the scene says")),
            (None, Some(_)) => drop(ui.weak("for the scene's own camera (Home)")),
            (None, None) => drop(ui.weak("none: drop an EXR here").on_hover_text("A picture of the same size, linear")),
        });
    }

    /// The view after this one, or before it.
    pub(super) fn next_view(&mut self, back: bool) {
        let count = View::ALL.len();
        let at = View::ALL.iter().position(|(view, _, _)| *view == self.look.view).unwrap_or(0);
        self.look.view = View::ALL[(at + if back { count - 1 } else { 1 }) % count].0;
    }
}
