//! The windows that say why a scene cannot be opened, or cannot be reloaded.
use egui::{Align2, RichText, ScrollArea};

use crate::viewer::widgets::{quotation::with_quotation_marks, style::over_the_picture};

/// Shows the report, until it is closed. Returns whether the built-in scene is to be opened, which is offered if nothing is open.
pub fn show(ctx: &egui::Context, error: &mut Option<String>, is_open: bool) -> bool {
    let Some(report) = error else { return false };
    let (mut open, mut built_in) = (true, false);
    egui::Window::new("This scene cannot be opened")
        .open(&mut open)
        .collapsible(false)
        .default_width(width(ctx))
        .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
        .show(ctx, |ui| {
            show_report(ui, report, 360.0);
            ui.horizontal(|ui| {
                copy_button(ui, report);
                built_in = !is_open && ui.button("Open the built-in scene").clicked();
            });
        });
    if !open || built_in {
        *error = None;
    }
    built_in
}

/// Shows why the file of the open scene cannot be reloaded, until it is closed.
pub fn show_of_file(ctx: &egui::Context, error: &mut Option<String>) {
    let Some(report) = error else { return };
    let mut open = true;
    egui::Window::new("This scene file cannot be reloaded")
        .open(&mut open)
        .collapsible(false)
        .default_width(width(ctx))
        .anchor(Align2::CENTER_BOTTOM, over_the_picture(64.0))
        .show(ctx, |ui| {
            show_report(ui, report, 200.0);
            ui.horizontal(|ui| {
                copy_button(ui, report);
                ui.weak("The image shows the last scene without errors.");
            });
        });
    if !open {
        *error = None;
    }
}

/// Width over the image, beside the panel.
fn width(ctx: &egui::Context) -> f32 {
    (ctx.content_rect().width() - 376.0).clamp(300.0, 760.0)
}

fn show_report(ui: &mut egui::Ui, report: &str, height: f32) {
    ScrollArea::both().max_height(height).show(ui, |ui| {
        ui.add(egui::Label::new(RichText::new(with_quotation_marks(report)).monospace()).extend());
    });
}

fn copy_button(ui: &mut egui::Ui, report: &str) {
    if ui.button("Copy").on_hover_text("Copies this message.").clicked() {
        ui.ctx().copy_text(report.to_owned());
    }
}
