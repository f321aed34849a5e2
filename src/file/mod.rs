//! File access: opens files that a user names, and replaces files atomically.
mod durable;
#[cfg(test)]
pub mod faults;
mod numbered;
mod target;

use std::{fs::File, io, path::Path};

pub use numbered::numbered;
pub use target::{WriteError, check, replace, replace_by};

/// Opens a regular file for reading. Anything else is an error: reading from a pipe could wait for ever.
pub fn open_regular(path: &Path) -> io::Result<File> {
    let kind = path.metadata()?.file_type();
    let what = if kind.is_dir() { " but a folder" } else { "" };
    if !kind.is_file() {
        return Err(io::Error::other(format!("it is not a regular file{what}")));
    }
    File::open(path)
}
