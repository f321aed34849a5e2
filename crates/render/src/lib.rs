//! Progressive rendering: the worker, passes, film, frames, views, image files, checkpoints and render files.

pub mod render;
pub mod render_file;

/// The commit that the renderer was built from, or "unknown" where that cannot be known.
pub const COMMIT: &str = env!("NOISEFALL_COMMIT");
