//! The state of the window itself: tools, tabs and dialogs.
use std::path::PathBuf;

use noisefall::render::Region;

use crate::viewer::canvas::{interaction::Tool, picture_view::PictureView};
use crate::viewer::dialogs::{gallery::Gallery, notices::Notices, save::SaveDialog};
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::widgets::path_field::PathField;

#[derive(Default)]
pub struct WindowState {
    pub tool: Tool,
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
    /// How often a button of the mouse was pressed.
    pub presses: u64,
    pub last_saved: Option<PathBuf>,
}

#[derive(Default)]
pub struct Dialogs {
    pub help: bool,
    pub save: Option<SaveDialog>,
    pub open: Option<PathField>,
    /// Why the last scene could not be opened.
    pub scene_error: Option<String>,
    pub notices: Notices,
    pub gallery: Gallery,
    /// The page of the tour that is open.
    pub tour: Option<usize>,
}

impl Dialogs {
    /// Whether a dialog waits for an answer and takes the keys.
    pub fn wait(&self) -> bool {
        self.save.is_some() || self.open.is_some() || self.scene_error.is_some()
    }
}
