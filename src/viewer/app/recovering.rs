//! Keeps unsaved changes in case the program ends unexpectedly, and offers those of earlier runs.
use std::path::Path;

use super::state::App;
use crate::viewer::background::adviser::Adviser;
use crate::viewer::dialogs::{
    recovery::{self, RecoveryAnswer},
    unsaved::Leaving,
};

impl App {
    /// Keeps the unsaved changes as they are now. A drag ends first.
    pub fn keep_changes(&mut self) {
        let view = self.session.window_view();
        let is_still = self.window.last_view.replace(view) == Some(view);
        if !self.is_dragging() && is_still {
            let document = self.editor.as_ref().map(|editor| &editor.document);
            let changed = document.filter(|document| document.has_changes() && !self.window.quits);
            self.background.recovery.keep(changed, Some(view));
        }
    }

    /// Looks for unsaved changes of the scene that was opened; in a new window without a scene file, for those of any scene.
    pub fn look_for_recovery(&mut self, is_first: bool) {
        self.dialogs.recovery = None;
        let path = self.session.path().map(Path::to_owned);
        self.background.recovery.begin(&self.ctx, path, is_first);
    }

    /// Takes up unsaved changes that were found, and advice: dialogs show them.
    pub fn receive_questions(&mut self) {
        if let Some(found) = self.background.recovery.take() {
            self.dialogs.recovery = Some(found);
        }
        // Advice is for the image that it was asked for, and for none that has changed since.
        let (edited, camera) = (*self.session.edited(), self.session.camera);
        let adviser = &mut self.background.adviser;
        adviser.iter_mut().for_each(Adviser::receive);
        adviser.take_if(|adviser| adviser.request.settings != edited || adviser.request.camera != camera);
    }

    /// Offers unsaved changes that were found, and follows the answer.
    pub fn show_recovery(&mut self) {
        let Some(answer) = self.dialogs.recovery.as_ref().and_then(|found| recovery::show(&self.ctx, found)) else { return };
        let Some(found) = self.dialogs.recovery.take() else { return };
        match answer {
            RecoveryAnswer::Restore => self.ask_to_leave(Leaving::Restore(found)),
            RecoveryAnswer::Discard => self.background.recovery.discard(found),
            RecoveryAnswer::Later => {}
        }
    }
}
