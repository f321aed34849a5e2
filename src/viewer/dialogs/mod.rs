//! Windows over the picture: dialogs, messages, help, the gallery and the tour.
pub mod advice;
pub mod choose_file;
mod completion;
pub mod conflict;
pub mod connect_tev;
pub mod gallery;
pub mod help;
pub mod notices;
pub mod open;
mod question;
pub mod recovery;
pub mod remarks;
pub mod save;
pub mod save_target;
pub mod scene_error;
pub mod sequence;
pub mod tour;
pub mod unsaved;
