//! Scenes in the format of Noisefall.
use std::path::Path;

use super::{ExportError, ExportSource, Prepared, files::ExportedFiles};
use crate::import::Remarks;
use noisefall_base::{declare::for_each_file, memory::Size};
use noisefall_scene::scene::LARGEST_FILE;
use noisefall_writer::{new_text, origin::Origins, updated};

/// Places the files, and makes the text that names them.
pub fn prepare(source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
    let mut description = source.description.clone();
    let mut named = Vec::new();
    for_each_file(&mut description, &mut |file| named.push(file.clone()));
    let files = ExportedFiles::place(&source, named, path)?;
    for_each_file(&mut description, &mut |file| *file = files.path(file));
    let text = match source.text {
        Some(text) => updated(text, source.description, &description, &Origins::of(source.description)),
        None => new_text(&description),
    };
    if text.len() as u64 > LARGEST_FILE {
        return Err(ExportError::TooLong { path: path.to_owned(), size: Size(text.len() as u64).to_string() });
    }
    Ok(Prepared { path: path.to_owned(), content: text.into_bytes(), files, remarks: Remarks::default() })
}
