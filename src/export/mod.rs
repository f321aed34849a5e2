//! Scene files for a scene in memory, with the files that it names.
//!
//! | file | holds |
//! |---|---|
//! | `toml.rs` | the format of Noisefall |
//! | `files.rs` | meshes and textures beside the scene file |
//! | `file_names.rs` | names that every system accepts |
//!
//! Another format is a file beside `toml.rs` and a line in [`write`].
mod file_names;
mod files;
mod toml;

use std::path::{Path, PathBuf};

use crate::{declare::Assets, file::WriteError, memory::TooMuch, quote, scene::description::SceneDescription};

/// A scene with its files.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The scene.
    pub description: &'a SceneDescription,
    /// Files in memory.
    pub assets: &'a Assets,
    /// The folder of files on disk that have relative paths.
    pub folder: &'a Path,
}

/// What an export wrote.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// The text of the scene file.
    pub text: String,
    /// The folder of the meshes and textures, if there are any.
    pub folder: Option<PathBuf>,
    /// Number of files that were written from memory.
    pub written: usize,
    /// Number of files that were copied.
    pub copied: usize,
}

/// Why a scene cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The extension is not known.
    #[error("{}: the format is not known; the name must end in .toml", quote::path(.0))]
    UnknownFormat(PathBuf),
    /// A file that the scene names.
    #[error("{}: cannot be read: {reason}", quote::path(path))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The message of the operating system.
        reason: String,
    },
    /// The text of the scene exceeds the limit of the reader.
    #[error("{}: the scene would be {size} of text, more than a scene file may have", quote::path(path))]
    TooLong {
        /// The scene file.
        path: PathBuf,
        /// The size, with a unit.
        size: String,
    },
    /// A file or folder cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The memory does not suffice.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
}

type Writer = fn(Source, &Path) -> Result<Exported, ExportError>;

/// Writes a scene. Its meshes and textures go to the folder `NAME.files` beside the file `NAME.toml`, which is written last. Each file
/// is replaced whole or not at all.
pub fn write(source: Source, path: &Path) -> Result<Exported, ExportError> {
    check(path)?(source, path)
}

/// The writer of a format, by the name of the file.
pub fn check(path: &Path) -> Result<Writer, ExportError> {
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    match extension.as_deref().and_then(|extension| extension.to_str()) {
        Some("toml") => Ok(toml::write),
        _ => Err(ExportError::UnknownFormat(path.to_owned())),
    }
}
