//! The window as a whole. It joins panels, instruments and dialogs with the work in the background.
mod canvas;
mod commands;
mod dialogs;
mod display;
mod dock;
mod editing;
mod frame;
mod history;
mod receive;
mod results;
mod saving;
mod selecting;
mod selection;
mod session;
mod side_panel;
mod state;
mod submit;
mod undo;
mod window_state;

pub use self::state::App;
