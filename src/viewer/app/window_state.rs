//! The state of the window itself: tools, tabs and dialogs.
use std::path::{Path, PathBuf};

use noisefall_edit::edit::WindowView;
use noisefall_render::render::Region;

use crate::viewer::background::{
    progress_checkpoints::FoundRender, recovery_files::FoundRecovery, sequence_task::SequenceRequest,
};
use crate::viewer::canvas::{interaction::Tool, picture_view::PictureView};
use crate::viewer::dialogs::{
    choose_file::FileDialog, conflict::Conflict, connect_tev::TevDialog, gallery::Gallery, notices::Notices, open::OpenDialog,
    open_reference::ReferenceDialog, save::SaveDialog, sequence::SequenceDialog, unsaved::Leaving,
};
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::panels::{panel_tabs::PanelTab, subject::Subject};

#[derive(Default)]
pub struct WindowState {
    pub tool: Tool,
    /// The page of the side panel.
    pub panel: PanelTab,
    pub view: PictureView,
    pub tab: Option<InstrumentTab>,
    /// The pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    /// It is a pixel of the second image.
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
    /// The file of an image, a plot or a path of this scene that was saved last.
    pub last_saved: Option<PathBuf>,
    /// The folder of the last such file of an earlier scene.
    pub last_folder: Option<PathBuf>,
    /// The action that follows when the scene is saved, while a dialog asks for its file.
    pub leaving: Option<Leaving>,
    /// The window closes, whatever is unsaved.
    pub quits: bool,
    pub title: String,
    /// The time of the window's clock at which it began to wait for a file.
    pub reading_since: Option<f64>,
    /// The view of the scene that is opened next, if that is the one of this file, or one without a file.
    pub kept_view: Option<(Option<PathBuf>, WindowView)>,
    /// The part whose menu is open over the image.
    pub menu_of: Option<Subject>,
    /// Whether the window filled the screen when it was last asked to change that, and what it was asked for, until it has followed.
    pub full_screen: Option<[bool; 2]>,
    /// The view of the last frame.
    pub last_view: Option<WindowView>,
}

impl WindowState {
    /// Forgets the name of the last saved file, and not its folder: another scene has other names.
    pub fn forget_last_saved(&mut self) {
        let folder = self.last_saved.take().and_then(|path| path.parent().map(Path::to_owned));
        self.last_folder = folder.or(self.last_folder.take());
    }
}

#[derive(Default)]
pub struct Dialogs {
    pub help: bool,
    pub save: Option<SaveDialog>,
    pub open: Option<OpenDialog>,
    pub file: Option<FileDialog>,
    /// Asks for a reference.
    pub reference: Option<ReferenceDialog>,
    pub tev: Option<TevDialog>,
    pub sequence: Option<SequenceDialog>,
    /// Frames to render, with the numbers of existing ones and of all.
    pub existing_frames: Option<(SequenceRequest, [usize; 2])>,
    /// The action that waits for an answer about unsaved changes.
    pub unsaved: Option<Leaving>,
    /// The conflict with a scene file that another program has changed, until the user decides.
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
