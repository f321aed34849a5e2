//! The windows that say why a scene cannot be opened, or cannot be reloaded.
use egui::{Align2, Color32, RichText, ScrollArea, TextStyle, Ui};

use super::report::fitted;
use crate::viewer::widgets::{
    quotation::with_quotation_marks,
    style::{PANEL_WIDTH, over_the_picture},
};

/// Room beside a window, between the edge of the screen and the panel, points.
const BESIDE: f32 = 40.0;
/// The least width of a window, points.
const LEAST_WIDTH: f32 = 300.0;
/// Height of a window without its report, and of what is below it, points.
const AROUND: f32 = 170.0;
/// From the lower edge of the screen to what says why a file cannot be reloaded, points.
const LIFT: f32 = 64.0;
/// Between that and what is above it, points.
const GAP: f32 = 8.0;

/// Shows the report, until it is closed. Returns whether the built-in scene is to be opened, which is offered if nothing is open.
pub fn show(ctx: &egui::Context, error: &mut Option<String>, is_open: bool) -> bool {
    let Some(report) = error else { return false };
    let (mut open, mut built_in) = (true, false);
    let window = egui::Window::new("This scene cannot be opened").open(&mut open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, over_the_picture(0.0)).show(ctx, |ui| {
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

/// Shows why the file of the open scene cannot be reloaded, until it is closed. Returns the height that it takes.
pub fn show_of_file(ctx: &egui::Context, error: &mut Option<String>) -> f32 {
    let Some(report) = error else { return 0.0 };
    let mut open = true;
    let window = egui::Window::new("This scene file cannot be reloaded").open(&mut open).collapsible(false).resizable(false);
    let shown = window.anchor(Align2::CENTER_BOTTOM, over_the_picture(LIFT)).show(ctx, |ui| {
        show_report(ui, report, 200.0);
        ui.horizontal(|ui| {
            copy_button(ui, report);
            ui.weak("The image shows the last scene without errors.");
        });
    });
    if !open {
        *error = None;
    }
    shown.map_or(0.0, |shown| shown.response.rect.height() + GAP)
}

/// Shows a report in the width that is free beside the panel.
fn show_report(ui: &mut Ui, report: &str, height: f32) {
    let screen = ui.ctx().content_rect().size();
    let width = (screen.x - PANEL_WIDTH - BESIDE).max(LEAST_WIDTH);
    let height = height.min(screen.y - AROUND);
    let font = TextStyle::Monospace.resolve(ui.style());
    let letter = ui.painter().layout_no_wrap("0".to_owned(), font, Color32::WHITE).size().x;
    let text = fitted(&with_quotation_marks(report), (width / letter) as usize);
    ScrollArea::vertical().max_height(height).show(ui, |ui| {
        ui.add(egui::Label::new(RichText::new(text).monospace()).extend());
    });
}

fn copy_button(ui: &mut Ui, report: &str) {
    if ui.button("Copy").on_hover_text("Copies this message.").clicked() {
        ui.ctx().copy_text(report.to_owned());
    }
}
