//! The question which version of a scene counts if another program has changed its file.
use egui::{Align2, RichText};
use noisefall::edit::Outside;

use super::unsaved::SaveOrder;
use crate::viewer::background::file_state::BrokenFile;

/// Unsaved changes of a scene whose file was changed by another program.
pub struct Conflict {
    pub file: Result<Box<Outside>, BrokenFile>,
    /// A save that waits for the answer.
    pub save: Option<SaveOrder>,
}

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConflictAnswer {
    KeepMine,
    UseFile,
    SaveAs,
    Later,
}

/// Asks the question about a file of this name.
pub fn show(ctx: &egui::Context, conflict: &Conflict, file: &str) -> Option<ConflictAnswer> {
    let (mut open, mut answer) = (true, None);
    egui::Window::new("The scene file has changed")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(440.0);
            let end = if conflict.file.is_ok() { "" } else { " and has errors" };
            ui.label(format!("`{file}` was changed by another program{end}. The scene in this window has unsaved changes."));
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                let keep = if conflict.save.is_some() {
                    "Replaces the file by the scene in this window."
                } else {
                    "Keeps the scene in this window. Ctrl+S then replaces the file."
                };
                let buttons = [
                    (RichText::new("Keep mine").strong(), keep, ConflictAnswer::KeepMine),
                    (
                        RichText::new("Use the file"),
                        "Reloads the file. Undo brings the changes in this window back.",
                        ConflictAnswer::UseFile,
                    ),
                    (
                        RichText::new("Save mine as…"),
                        "Saves the scene in this window to another file and leaves this file as it is.",
                        ConflictAnswer::SaveAs,
                    ),
                ];
                for (name, doc, means) in buttons {
                    let can = means != ConflictAnswer::UseFile || conflict.file.is_ok();
                    let button = ui.add_enabled(can, egui::Button::new(name)).on_hover_text(doc);
                    if button.on_disabled_hover_text("The file has errors.").clicked() {
                        answer = Some(means);
                    }
                }
            });
        });
    if open { answer } else { Some(ConflictAnswer::Later) }
}
