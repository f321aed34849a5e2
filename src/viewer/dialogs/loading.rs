//! The window that says which file is being read.
use egui::{Align2, Spinner};

use crate::viewer::widgets::style::{elided, over_the_picture};

/// Largest width of the text, points.
const MOST_WIDTH: f32 = 300.0;

/// Shows the file and how long it has been read. Returns whether to cancel.
pub fn show(ctx: &egui::Context, name: &str, seconds: f64) -> bool {
    let place = egui::Window::new("Reading").title_bar(false).collapsible(false).resizable(false);
    let shown = place.anchor(Align2::CENTER_CENTER, over_the_picture(0.0)).show(ctx, |ui| {
        ui.horizontal(|ui| {
            ui.add(Spinner::new());
            elided(ui, MOST_WIDTH, format!("Reading “{name}”, {seconds:.0} s"));
            ui.button("Cancel").on_hover_text("Keeps the scene that is open. (Esc)").clicked()
        })
        .inner
    });
    shown.and_then(|shown| shown.inner).unwrap_or(false)
}
