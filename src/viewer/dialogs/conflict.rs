//! Asks which version of a scene to keep if another program has changed its file.
use egui::Ui;
use noisefall_edit::edit::Outside;

use super::{
    question::{Choice, ask},
    unsaved::SaveRequest,
};
use crate::viewer::background::file_state::BrokenFile;

/// Unsaved changes of a scene whose file was changed by another program.
pub struct Conflict {
    pub file: Result<Box<Outside>, BrokenFile>,
    /// A save that waits for the answer.
    pub save: Option<SaveRequest>,
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
    let explain = |ui: &mut Ui| {
        let end = if conflict.file.is_ok() { "" } else { " and has errors" };
        ui.label(format!("“{file}” was changed by another program{end}. The scene in this window has unsaved changes."));
    };
    let keep = if conflict.save.is_some() {
        "Replaces the file with the scene in this window."
    } else {
        "Keeps the scene in this window. Ctrl+S then replaces the file."
    };
    let reload = "Reloads the file. Undo brings the changes in this window back.";
    let refusal = conflict.file.is_err().then_some("The file has errors.");
    let save_as = "Saves the scene in this window to another file and leaves this file as it is.";
    let choices = [
        Choice::new("Keep mine", keep, ConflictAnswer::KeepMine),
        Choice { refusal, ..Choice::new("Use the file", reload, ConflictAnswer::UseFile) },
        Choice::new("Save mine as…", save_as, ConflictAnswer::SaveAs),
    ];
    ask(ctx, "The scene file has changed", 440.0, explain, choices, ConflictAnswer::Later)
}
