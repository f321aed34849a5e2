//! Opening files that somebody else names, and writing files whole or not at all.
mod target;

use std::{fs::File, io, path::Path};

pub use target::{WriteError, check, replace};

/// Opens a file for reading, and nothing else: a pipe would be waited for, perhaps for ever.
pub fn open_regular(path: &Path) -> io::Result<File> {
    let kind = path.metadata()?.file_type();
    let what = if kind.is_dir() { " but a folder" } else { "" };
    if !kind.is_file() {
        return Err(io::Error::other(format!("it is not a regular file{what}")));
    }
    File::open(path)
}
