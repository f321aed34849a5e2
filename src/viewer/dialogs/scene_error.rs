//! The window that says why a scene cannot be opened.
use egui::{Align2, RichText, ScrollArea};

use crate::viewer::widgets::style::over_the_picture;

/// Shows the report, until it is closed. Returns whether the built-in scene is to be opened, which is offered if nothing is open.
pub fn show(ctx: &egui::Context, error: &mut Option<String>, is_open: bool) -> bool {
    let Some(report) = error else { return false };
    let (mut open, mut built_in) = (true, false);
    egui::Window::new("This scene cannot be opened")
        .open(&mut open)
        .collapsible(false)
        .default_width((ctx.content_rect().width() - 376.0).clamp(300.0, 760.0))
        .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
        .show(ctx, |ui| {
            ScrollArea::both().max_height(360.0).show(ui, |ui| {
                ui.add(egui::Label::new(RichText::new(report.as_str()).monospace()).extend());
            });
            ui.horizontal(|ui| {
                if ui.button("Copy").on_hover_text("Copies this message.").clicked() {
                    ui.ctx().copy_text(report.clone());
                }
                built_in = !is_open && ui.button("Open the built-in scene").clicked();
            });
        });
    if !open || built_in {
        *error = None;
    }
    built_in
}
