//! The window as a whole. It joins panels, instruments and dialogs with the work in the background.
mod canvas;
mod commands;
mod dialogs;
mod display;
mod dock;
mod editing;
mod editor_panel;
mod frame;
mod gizmo;
mod history;
mod outliner_actions;
mod receive;
mod results;
mod saving;
mod scene_editor;
mod scene_edits;
mod scene_file;
mod selecting;
mod selection;
mod session;
mod side_panel;
mod state;
mod submit;
mod undo;
mod window_state;

pub use self::state::App;
