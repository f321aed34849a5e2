//! The window that says which file is being read.
use egui::{Align2, ProgressBar, Spinner};
use noisefall_base::progress::Progress;

use crate::viewer::widgets::style::{elided, over_the_picture};

/// Largest width of the text, points.
const MOST_WIDTH: f32 = 300.0;

/// Shows the file, how long it has been read, and the progress if it is known. Returns whether to cancel.
pub fn show(ctx: &egui::Context, name: &str, seconds: f64, progress: Option<&Progress>) -> bool {
    let place = egui::Window::new("Reading").title_bar(false).collapsible(false).resizable(false);
    let shown = place.anchor(Align2::CENTER_CENTER, over_the_picture(0.0)).show(ctx, |ui| {
        let is_cancelled = ui.horizontal(|ui| {
            ui.add(Spinner::new());
            elided(ui, MOST_WIDTH, format!("Reading “{name}”, {seconds:.0} s"));
            ui.button("Cancel").on_hover_text("Cancels reading and keeps the open scene. (Esc)").clicked()
        });
        if let Some(progress) = progress {
            let percent = format!("{}: {:.0} %", progress.stage().name(), 100.0 * progress.fraction());
            ui.add(ProgressBar::new(progress.fraction() as f32).text(percent).desired_width(ui.min_rect().width()));
        }
        is_cancelled.inner
    });
    shown.and_then(|shown| shown.inner).unwrap_or(false)
}
