//! Scene files for a scene in memory, with the files that it names.
//!
//! | file | holds |
//! |---|---|
//! | `toml.rs` | the format of Noisefall |
//! | `mitsuba/` | XML of Mitsuba 3 |
//! | `gltf/` | glTF 2.0 |
//! | `files.rs`, `new_assets.rs` | meshes and textures beside the scene file |
//! | `file_names.rs` | names that every system accepts |
//! | `notes.rs` | remarks by place |
//! | `geometry.rs` | shapes in world space, and triangles that replace them |
//! | `textures.rs` | means and images of textures |
//! | `substitutes.rs` | what stands for kinds that a format does not know |
//!
//! Another format is a file beside `toml.rs` and a line in [`check`]. What a format cannot express becomes a remark, as in the readers.
mod file_names;
mod files;
mod geometry;
mod gltf;
mod mitsuba;
mod new_assets;
mod notes;
#[cfg(test)]
mod round_trip;
mod substitutes;
mod textures;
mod toml;

use std::{
    collections::HashSet,
    path::{Path, PathBuf},
};

use crate::import::{self, Remarks};
use noisefall_base::{
    declare::{Assets, for_each_file},
    file::{WriteError, replace},
    memory::TooMuch,
    quote,
};
use noisefall_scene::scene::description::SceneDescription;

/// A scene to export, with its files.
#[derive(Clone, Copy)]
pub struct ExportSource<'a> {
    /// The scene.
    pub description: &'a SceneDescription,
    /// Files in memory.
    pub assets: &'a Assets,
    /// The folder of files on disk that have relative paths.
    pub folder: &'a Path,
    /// Whether files outside of that folder may be copied.
    pub allow_outside: bool,
    /// The scene file of Noisefall that the description was read from, if there is one. Another such file keeps its comments.
    pub text: Option<&'a str>,
}

/// A scene in another format, before anything is written.
pub struct Prepared {
    path: PathBuf,
    /// The scene file.
    content: Vec<u8>,
    files: files::ExportedFiles,
    /// Remarks on parts that the format cannot express exactly.
    pub remarks: Remarks,
}

/// Files that an export wrote.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
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
    #[error("{}: the format is not known; the name must end in .toml, .xml, .gltf or .glb", quote::path(.0))]
    UnknownFormat(PathBuf),
    /// A part of the scene is invalid.
    #[error("{place}: {reason}")]
    Invalid {
        /// Its name in the scene.
        place: String,
        /// The problem.
        reason: String,
    },
    /// A file that the scene names.
    #[error("{}: cannot be read: {reason}", quote::path(path))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The message of the operating system.
        reason: String,
    },
    /// A file that the scene names, and that must not be copied.
    #[error("{}: {reason}; --allow-outside permits it", quote::path(path))]
    Outside {
        /// The file.
        path: PathBuf,
        /// Where it lies.
        reason: &'static str,
    },
    /// The scene exceeds the limit of the format.
    #[error("{}: the scene would be {size}, more than a scene file may have", quote::path(path))]
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

type Translator = fn(ExportSource, &Path) -> Result<Prepared, ExportError>;

/// Translates a scene to the format that the name of the file asks for. Nothing is written.
pub fn prepare(source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
    let translate = check(path)?;
    check_files(source)?;
    translate(source, path)
}

/// Checks that all files on disk may be copied: those in the folder of the scene, and those that its reader was allowed to read.
fn check_files(source: ExportSource) -> Result<(), ExportError> {
    let folder = if source.folder.as_os_str().is_empty() { Path::new(".") } else { source.folder };
    let root = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let known: HashSet<&str> = source.assets.paths().chain(source.assets.sources()).collect();
    let mut refused = None;
    for_each_file(&mut source.description.clone(), &mut |named| {
        let resolved = folder.join(&*named).canonicalize().ok().filter(|_| !known.contains(named.as_str()));
        let reason = resolved.and_then(|file| import::refusal(&root, &file));
        refused = refused.take().or_else(|| Some(ExportError::Outside { path: PathBuf::from(&*named), reason: reason? }));
    });
    refused.filter(|_| !source.allow_outside).map_or(Ok(()), Err)
}

/// Writes a scene. Its meshes and textures go to the folder `NAME.files` beside the file `NAME.toml`, which is written last. Each file
/// is replaced whole or not at all.
pub fn write(source: ExportSource, path: &Path) -> Result<Exported, ExportError> {
    prepare(source, path)?.write()
}

/// The translator to a format, by the name of the file.
pub fn check(path: &Path) -> Result<Translator, ExportError> {
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    match extension.as_deref().and_then(|extension| extension.to_str()) {
        Some("toml") => Ok(toml::prepare),
        Some("gltf") => Ok(gltf::prepare_text),
        Some("glb") => Ok(gltf::prepare_binary),
        Some("xml") => Ok(mitsuba::prepare),
        _ => Err(ExportError::UnknownFormat(path.to_owned())),
    }
}

impl Prepared {
    /// The content of the scene file.
    pub fn content(&self) -> &[u8] {
        &self.content
    }

    /// Writes the files, and then the scene that names them.
    pub fn write(&self) -> Result<Exported, ExportError> {
        let [written, copied] = self.files.write()?;
        replace(&self.path, &self.content)?;
        Ok(Exported { folder: (written + copied > 0).then(|| self.files.folder.clone()), written, copied })
    }
}
