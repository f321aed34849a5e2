//! The state of the window itself: tools, tabs and dialogs.
use std::path::PathBuf;

use noisefall::{
    render::Region,
    scene::{Camera, RenderSettings},
};

use crate::viewer::background::{progress_keeper::FoundRender, recovery_files::FoundRecovery, sequence_task::SequenceRequest};
use crate::viewer::canvas::{interaction::Tool, picture_view::PictureView};
use crate::viewer::dialogs::{
    choose_file::FileDialog, conflict::Conflict, connect_tev::TevDialog, gallery::Gallery, notices::Notices, open::OpenDialog,
    save::SaveDialog, sequence::SequenceDialog, unsaved::Leaving,
};
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::panels::panel_tabs::PanelTab;

#[derive(Default)]
pub struct WindowState {
    pub tool: Tool,
    /// The page of the side panel.
    pub panel: PanelTab,
    pub view: PictureView,
    pub tab: Option<InstrumentTab>,
    /// The pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    /// It is a pixel of the second picture.
    pub over_second: bool,
    /// A field or a list had the keyboard when the last frame ended.
    pub had_focus: bool,
    /// The region that is being drawn.
    pub marking: Option<Region>,
    pub hidden: bool,
    /// The key is still down after Ctrl+S or Shift+D: it does not move the camera.
    pub holds_chord: bool,
    /// The menu that adds parts opens in this frame.
    pub opens_add: bool,
    /// Input of the next frames: what came in one frame is in order only in several.
    pub later_events: Vec<egui::Event>,
    /// How often a button of the mouse was pressed.
    pub presses: u64,
    pub last_saved: Option<PathBuf>,
    /// What goes on when the scene is saved, while the place to save it is asked for.
    pub leaving: Option<Leaving>,
    /// The window closes, whatever is unsaved.
    pub quits: bool,
    pub title: String,
    /// The time of the window's clock at which it began to wait for a file.
    pub reading_since: Option<f64>,
    /// A file whose scene is shown as the one before it, with its camera and settings, when it is opened.
    pub kept_view: Option<(PathBuf, Camera, RenderSettings)>,
}

#[derive(Default)]
pub struct Dialogs {
    pub help: bool,
    pub save: Option<SaveDialog>,
    pub open: Option<OpenDialog>,
    pub file: Option<FileDialog>,
    pub tev: Option<TevDialog>,
    pub sequence: Option<SequenceDialog>,
    /// Frames to render, with the numbers of existing ones and of all.
    pub existing_frames: Option<(SequenceRequest, [usize; 2])>,
    /// What waits for an answer about unsaved changes.
    pub unsaved: Option<Leaving>,
    /// What waits for an answer about a scene file that another program has changed.
    pub conflict: Option<Conflict>,
    /// Unsaved changes that can be restored.
    pub recovery: Option<FoundRecovery>,
    pub unfinished: Option<FoundRender>,
    /// Why the last scene could not be opened.
    pub scene_error: Option<String>,
    /// The list of what was not imported exactly is open.
    pub remarks: bool,
    /// Why the file of the open scene cannot be reloaded.
    pub file_error: Option<String>,
    pub notices: Notices,
    pub gallery: Gallery,
    /// The page of the tour that is open.
    pub tour: Option<usize>,
}

impl Dialogs {
    /// Whether a dialog waits for an answer and takes the keys.
    pub fn wait(&self) -> bool {
        let has_question =
            self.unsaved.is_some() || self.conflict.is_some() || self.recovery.is_some() || self.unfinished.is_some();
        let has_export = self.tev.is_some() || self.sequence.is_some() || self.existing_frames.is_some();
        let has_file = self.save.is_some() || self.open.is_some() || self.file.is_some();
        has_file || has_export || has_question || self.scene_error.is_some()
    }
}
