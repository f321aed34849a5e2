//! Changes of scene files, undo and saving.

pub mod edit;
