//! Asks whether to save unsaved changes.
use std::path::PathBuf;

use egui::Ui;
use noisefall_edit::edit::Template;

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
#[derive(Clone, Debug, Default)]
pub struct SaveRequest {
    /// The file that was chosen; `None` is the file of the scene.
    pub path: Option<PathBuf>,
    /// Replaces the file even if another program has changed it.
    pub replaces: bool,
    /// The action that follows when the scene is saved.
    pub leaving: Option<Leaving>,
}

impl SaveRequest {
    /// One request for this one and an earlier one.
    pub fn after(self, earlier: SaveRequest) -> SaveRequest {
        SaveRequest {
            path: self.path.or(earlier.path),
            replaces: self.replaces || earlier.replaces,
            leaving: self.leaving.or(earlier.leaving),
        }
    }
}

/// The answer to whether unsaved changes are saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnsavedAnswer {
    Save,
    Discard,
    Cancel,
}

/// Asks the question about a scene of this name.
pub fn show(ctx: &egui::Context, scene: &str) -> Option<UnsavedAnswer> {
    let choices = [
        Choice::new("Save changes", "Saves the scene, then continues.", UnsavedAnswer::Save),
        Choice::new("Discard changes", "Continues without saving.", UnsavedAnswer::Discard),
        Choice::new("Cancel", "Returns to the scene. (Esc)", UnsavedAnswer::Cancel),
    ];
    let explain = |ui: &mut Ui| _ = ui.label(format!("“{scene}” has changes that are not saved."));
    ask(ctx, "Unsaved changes", 380.0, explain, choices, UnsavedAnswer::Cancel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_later_request_takes_the_place_of_an_earlier_one_and_loses_nothing_of_it() {
        let chosen = SaveRequest { path: Some("b.toml".into()), replaces: true, leaving: None };
        let own = SaveRequest { leaving: Some(Leaving::Quit), ..SaveRequest::default() };
        let SaveRequest { path, replaces, leaving } = own.after(chosen);
        assert!(path == Some("b.toml".into()) && replaces && matches!(leaving, Some(Leaving::Quit)));
    }
}
