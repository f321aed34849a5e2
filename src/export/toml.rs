//! Scenes in the format of Noisefall.
use std::path::Path;

use super::{ExportError, Exported, Source, files::Files};
use crate::{declare::for_each_file, edit::new_text, file::replace, memory::Size, scene::LARGEST_FILE};

/// Writes the files, and then the scene that names them.
pub fn write(source: Source, path: &Path) -> Result<Exported, ExportError> {
    let mut description = source.description.clone();
    let mut named = Vec::new();
    for_each_file(&mut description, &mut |file| named.push(file.clone()));
    let files = Files::place(&source, named, path)?;
    for_each_file(&mut description, &mut |file| *file = files.path(file));
    let text = new_text(&description);
    if text.len() as u64 > LARGEST_FILE {
        return Err(ExportError::TooLong { path: path.to_owned(), size: Size(text.len() as u64).to_string() });
    }
    let [written, copied] = files.write()?;
    replace(path, text.as_bytes())?;
    Ok(Exported { text, folder: (written + copied > 0).then_some(files.folder), written, copied })
}
