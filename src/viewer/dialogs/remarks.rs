//! The window that lists what of a scene of another program was not taken over exactly.
use egui::{Align2, ScrollArea};
use noisefall::import::Remarks;

use crate::viewer::widgets::style::over_the_picture;

/// Largest number of remarks that are shown. The copied text has all.
const MOST: usize = 200;

/// Shows the list, until it is closed.
pub fn show(ctx: &egui::Context, open: &mut bool, remarks: &Remarks) {
    let copy = || remarks.lines(remarks.len()).join("\n");
    egui::Window::new("Differences from the original scene")
        .open(open)
        .collapsible(false)
        .default_width((ctx.content_rect().width() - 376.0).clamp(300.0, 720.0))
        .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
        .show(ctx, |ui| {
            ui.label("Everything else was taken over exactly.");
            ui.add_space(4.0);
            ScrollArea::both().max_height(320.0).show(ui, |ui| {
                for line in remarks.lines(MOST) {
                    ui.add(egui::Label::new(line).extend());
                }
            });
            ui.add_space(4.0);
            if ui.button("Copy").on_hover_text("Copies the whole list.").clicked() {
                ui.ctx().copy_text(copy());
            }
        });
}
