//! Copying what is inspected, for a report.
use egui::Ui;
use noisefall::render::{
    path_samples::SampleTable,
    path_text::{self, PathId},
};

use crate::viewer::app::App;

impl App {
    /// Buttons that copy the path, or the samples of the pixel.
    pub(super) fn copy_buttons(&self, ui: &mut Ui) {
        let (Some(wish), Some((sample, replay)), Some(pixel)) = (self.link.wish(), self.inspector.replay(), self.inspector.pixel)
        else {
            return;
        };
        let id = PathId { scene: &wish.scene, camera: &wish.camera, settings: &wish.settings, pixel, sample };
        ui.horizontal_wrapped(|ui| {
            ui.label("Copy");
            if ui.button("Text").on_hover_text("Copies the path as text: settings, nested sum, every term").clicked() {
                ui.ctx().copy_text(path_text::text(&id, replay));
            }
            if ui.button("LaTeX").on_hover_text("Copies the nested sum with its numbers as LaTeX").clicked() {
                ui.ctx().copy_text(path_text::latex(&id, replay));
            }
            let samples = self.inspector.samples().filter(|samples| !samples.is_empty());
            if let Some(samples) = samples
                && ui.button("Samples").on_hover_text("Copies the samples as CSV, with mean and variance so far").clicked()
            {
                let mut table = SampleTable::default();
                table.extend(0, samples);
                ui.ctx().copy_text(table.csv());
            }
        });
    }
}
