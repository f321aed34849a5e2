//! The dialog in front. Only one is shown at a time, and keys go to no other part of the window.
use super::state::App;

/// Dialogs over the image, in the order in which they are shown: forms that the user has opened before questions, and those before
/// what only tells something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontDialog {
    Save,
    Open,
    ChooseFile,
    Reference,
    Tev,
    Sequence,
    ExistingFrames,
    Unsaved,
    Conflict,
    Recovery,
    Unfinished,
    Help,
    Gallery,
    SceneError,
    Advice,
    Remarks,
}

impl FrontDialog {
    /// Whether it waits for an answer, and nothing behind it takes clicks. The others make room for a command.
    pub fn waits(self) -> bool {
        use FrontDialog as D;
        !matches!(self, D::Help | D::Gallery | D::SceneError | D::Advice | D::Remarks)
    }
}

impl App {
    /// The dialog that is shown and has the keys.
    pub fn front(&self) -> Option<FrontDialog> {
        use FrontDialog as D;
        let dialogs = &self.dialogs;
        let is_saving = self.saving.is_some();
        let open = [
            (D::Save, dialogs.save.is_some()),
            (D::Open, dialogs.open.is_some()),
            (D::ChooseFile, dialogs.file.is_some()),
            (D::Reference, dialogs.reference.is_some()),
            (D::Tev, dialogs.tev.is_some()),
            (D::Sequence, dialogs.sequence.is_some()),
            (D::ExistingFrames, dialogs.existing_frames.is_some()),
            (D::Unsaved, dialogs.unsaved.is_some()),
            // It may be answered by the save that is under way.
            (D::Conflict, dialogs.conflict.is_some() && !is_saving),
            (D::Recovery, dialogs.recovery.is_some()),
            (D::Unfinished, dialogs.unfinished.is_some()),
            (D::Help, dialogs.help),
            (D::Gallery, dialogs.gallery.open),
            (D::SceneError, dialogs.scene_error.is_some()),
            (D::Advice, self.background.adviser.is_some()),
            (D::Remarks, dialogs.remarks),
        ];
        open.into_iter().find(|(_, is_open)| *is_open).map(|(dialog, _)| dialog)
    }

    /// Whether a dialog waits for an answer.
    pub fn awaits_answer(&self) -> bool {
        self.front().is_some_and(FrontDialog::waits)
    }

    /// Closes a dialog without an answer.
    pub fn close(&mut self, dialog: FrontDialog) {
        use FrontDialog as D;
        let dialogs = &mut self.dialogs;
        match dialog {
            D::Save => {
                // The question where to save has no answer.
                (dialogs.save, self.window.leaving) = (None, None);
            }
            D::Open => dialogs.open = None,
            D::ChooseFile => dialogs.file = None,
            D::Reference => dialogs.reference = None,
            D::Tev => dialogs.tev = None,
            D::Sequence => dialogs.sequence = None,
            D::ExistingFrames => dialogs.existing_frames = None,
            D::Unsaved => dialogs.unsaved = None,
            D::Conflict => dialogs.conflict = None,
            D::Recovery => dialogs.recovery = None,
            D::Unfinished => dialogs.unfinished = None,
            D::Help => dialogs.help = false,
            D::Gallery => dialogs.gallery.open = false,
            D::SceneError => dialogs.scene_error = None,
            D::Advice => self.background.adviser = None,
            D::Remarks => dialogs.remarks = false,
        }
    }

    /// Opens or closes the help or the gallery, unless a question waits for an answer.
    pub fn toggle_dialog(&mut self, dialog: FrontDialog) {
        let is_front = self.front() == Some(dialog);
        if is_front || self.make_room() {
            let dialogs = &mut self.dialogs;
            let shown = if dialog == FrontDialog::Help { &mut dialogs.help } else { &mut dialogs.gallery.open };
            *shown = !is_front;
        }
    }

    /// Makes room for a command. Returns whether it can be carried out: what only tells something is closed, and a question is not.
    pub fn make_room(&mut self) -> bool {
        while let Some(front) = self.front() {
            if front.waits() {
                return false;
            }
            self.close(front);
        }
        true
    }
}
