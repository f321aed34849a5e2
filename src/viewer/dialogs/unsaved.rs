//! The question what becomes of changes that are not saved.
use std::path::PathBuf;

use egui::{Align2, RichText};
use noisefall::edit::Template;

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
    let (mut open, mut answer) = (true, None);
    egui::Window::new("Unsaved changes")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(380.0);
            ui.label(format!("`{scene}` has changes that are not saved."));
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                for (name, doc, means) in [
                    (RichText::new("Save changes").strong(), "Saves the scene, then continues.", Answer::Save),
                    (RichText::new("Discard changes"), "Continues without saving.", Answer::Discard),
                    (RichText::new("Cancel"), "Returns to the scene. (Esc)", Answer::Cancel),
                ] {
                    if ui.button(name).on_hover_text(doc).clicked() {
                        answer = Some(means);
                    }
                }
            });
        });
    if open { answer } else { Some(Answer::Cancel) }
}
