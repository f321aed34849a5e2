//! Opening files that somebody else names, and writing files whole or not at all.
use std::{
    fs::File,
    io::{self, Write},
    path::Path,
};

use tempfile::NamedTempFile;

/// Opens a file for reading, and nothing else: a pipe would be waited for, perhaps for ever.
pub fn open_regular(path: &Path) -> io::Result<File> {
    let kind = path.metadata()?.file_type();
    let what = if kind.is_dir() { " but a folder" } else { "" };
    if !kind.is_file() {
        return Err(io::Error::other(format!("it is not a regular file{what}")));
    }
    File::open(path)
}

/// A file in `folder` that disappears unless it is renamed.
pub fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".noisefall-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Replaces the file `name` of a folder, or leaves it as it is if that fails.
pub fn replace(folder: &Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut file = temporary(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(folder.join(name))?;
    Ok(())
}
