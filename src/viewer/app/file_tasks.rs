//! Tasks under way on the files of the open scene.
use std::path::PathBuf;

use crossbeam_channel::Receiver;
use noisefall_edit::edit::Version;

use crate::viewer::background::{
    background_task::BackgroundTask,
    file_state::{FileState, SaveResult},
};
use crate::viewer::dialogs::unsaved::{Leaving, SaveRequest};

/// Changes that other programs make to the files.
#[derive(Default)]
pub struct OutsideChanges {
    /// The document whose files are watched.
    pub watched: Option<(PathBuf, Version)>,
    /// The scene file has to be compared with the document.
    pub is_due: bool,
    pub comparison: Option<BackgroundTask<(Version, FileState)>>,
    /// Finds out why a file that was reloaded cannot be compiled.
    pub diagnosis: Option<BackgroundTask<String>>,
}

impl OutsideChanges {
    /// Compares the file again: the document or its file is another one now.
    pub fn recheck(&mut self) {
        (self.comparison, self.is_due) = (None, true);
    }

    /// Whether nothing is under way.
    #[cfg(test)]
    pub fn is_settled(&self) -> bool {
        !self.is_due && self.comparison.is_none() && self.diagnosis.is_none()
    }
}

/// A scene that is being saved.
pub struct PendingSave {
    pub request: SaveRequest,
    /// The file that it is saved to.
    pub path: PathBuf,
    pub result: Receiver<SaveResult>,
    /// The next save, requested meanwhile.
    pub next: Option<SaveRequest>,
}

impl PendingSave {
    /// Leaves the scene when it is saved.
    pub fn leave(&mut self, leaving: Leaving) {
        self.next.as_mut().unwrap_or(&mut self.request).leaving = Some(leaving);
    }
}
