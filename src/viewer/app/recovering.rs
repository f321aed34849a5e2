//! Keeps unsaved changes in case the program ends unexpectedly, and offers those of earlier runs.
use std::path::Path;

use super::state::App;
use crate::viewer::dialogs::{
    recovery::{self, RecoveryAnswer},
    unsaved::Leaving,
};

impl App {
    /// Keeps the unsaved changes as they are now. A drag ends first.
    pub fn keep_changes(&mut self) {
        if !self.is_dragging() {
            let document = self.editor.as_ref().map(|editor| &editor.document);
            self.background.recovery.keep(document.filter(|document| document.has_changes() && !self.window.quits));
        }
    }

    /// Looks for unsaved changes of the scene that was opened; in a new window without a scene file, for those of any scene.
    pub fn look_for_recovery(&mut self, is_first: bool) {
        self.dialogs.recovery = None;
        let path = self.session.path().map(Path::to_owned);
        self.background.recovery.begin(&self.ctx, path, is_first);
    }

    /// Offers unsaved changes that were found, and follows the answer.
    pub fn show_recovery(&mut self) {
        if let Some(found) = self.background.recovery.take() {
            self.dialogs.recovery = Some(found);
        }
        let Some(answer) = self.dialogs.recovery.as_ref().and_then(|found| recovery::show(&self.ctx, found)) else { return };
        let Some(found) = self.dialogs.recovery.take() else { return };
        match answer {
            RecoveryAnswer::Restore => self.ask_to_leave(Leaving::Restore(found)),
            RecoveryAnswer::Discard => self.background.recovery.discard(found),
            RecoveryAnswer::Later => {}
        }
    }
}
