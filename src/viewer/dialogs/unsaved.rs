//! The question what becomes of changes that are not saved.
use std::path::PathBuf;

use egui::Ui;
use noisefall::edit::Template;

use super::question::{Choice, ask};
use crate::viewer::background::recovery_files::FoundRecovery;

/// An action that leaves the open scene.
#[derive(Clone, Debug)]
pub enum Leaving {
    /// Another scene is opened; `None` is the built-in one.
    Open(Option<PathBuf>),
    /// A new scene is begun.
    New(Template),
    /// A scene is opened with changes of an earlier run.
    Restore(FoundRecovery),
    Quit,
}

/// A scene to save.
#[derive(Clone, Debug)]
pub struct SaveOrder {
    pub path: PathBuf,
    /// Replaces the file even if another program has changed it.
    pub replaces: bool,
    /// What goes on when the scene is saved.
    pub leaving: Option<Leaving>,
}

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    Save,
    Discard,
    Cancel,
}

/// Asks the question about a scene of this name.
pub fn show(ctx: &egui::Context, scene: &str) -> Option<Answer> {
    let choices = [
        Choice::new("Save changes", "Saves the scene, then continues.", Answer::Save),
        Choice::new("Discard changes", "Continues without saving.", Answer::Discard),
        Choice::new("Cancel", "Returns to the scene. (Esc)", Answer::Cancel),
    ];
    let explain = |ui: &mut Ui| _ = ui.label(format!("`{scene}` has changes that are not saved."));
    ask(ctx, "Unsaved changes", 380.0, explain, choices, Answer::Cancel)
}
