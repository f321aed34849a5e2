//! glTF 2.0 files.
use std::path::Path;

use super::{ImportOptions, Imported};
use crate::scene::SceneError;

/// Reads the file.
pub fn read(path: &Path, _: &ImportOptions) -> Result<Imported, SceneError> {
    Err(SceneError::of_file(path, "not built yet", "not built yet"))
}
