//! Work off the UI thread: rendering, display, files, studies. Nothing here depends on widgets.
pub mod adviser;
pub mod background_task;
pub mod catalogue;
pub mod display_image;
pub mod display_pipeline;
pub mod display_request;
pub mod feature_finder;
pub mod file_state;
pub mod file_watcher;
pub mod loader;
pub mod outline;
pub mod preferences;
pub mod recovery_files;
pub mod recovery_keeper;
mod reduction;
pub mod render_worker;
pub mod saver;
pub mod settler;
