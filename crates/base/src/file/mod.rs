//! File access: opens files that a user names, and replaces files atomically.
mod below;
mod durable;
mod elsewhere;
pub mod faults;
mod numbered;
mod short_name;
mod target;

use std::{
    fs::File,
    io::{self, Read, Seek},
    path::Path,
};

pub use below::{check_below, replace_below};
pub use elsewhere::save_elsewhere;
pub use numbered::numbered;
pub use short_name::{LONGEST_NAME, cut, short_name};
pub use target::{WriteError, check, replace, replace_by};

/// Opens a regular file for reading. Anything else is an error: reading from a pipe could wait for ever. So is a pointer of Git LFS,
/// which stands for a file of any format.
pub fn open_regular(path: &Path) -> io::Result<File> {
    let found = path.metadata()?;
    let kind = found.file_type();
    let what = if kind.is_dir() { " but a folder" } else { "" };
    if !kind.is_file() {
        return Err(io::Error::other(format!("it is not a regular file{what}")));
    }
    let mut file = File::open(path)?;
    // It may have been replaced meanwhile.
    if !file.metadata()?.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    if found.len() <= LONGEST_POINTER && is_pointer(&mut file)? {
        return Err(io::Error::other("it is a pointer of Git LFS, not the file itself; fetch that with `git lfs pull`"));
    }
    Ok(file)
}

/// Longest pointer, bytes (Git LFS specification, "The Pointer").
const LONGEST_POINTER: u64 = 1024;

/// Whether the file is a pointer of Git LFS.
fn is_pointer(file: &mut File) -> io::Result<bool> {
    const START: &[u8] = b"version https://git-lfs.github.com/spec/";
    let mut start = Vec::new();
    file.by_ref().take(START.len() as u64).read_to_end(&mut start)?;
    file.rewind()?;
    Ok(start == START)
}

/// Reads a regular file of at most so many bytes as text.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let mut text = String::new();
    // Reading stops at the limit even if the file is smaller now, because it may grow meanwhile.
    open_regular(path)?.take(most + 1).read_to_string(&mut text)?;
    if text.len() as u64 > most {
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, format!("it has more than {most} bytes")));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointers_of_git_lfs_are_no_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.obj");
        std::fs::write(&path, "version https://git-lfs.github.com/spec/v1\noid sha256:2c6b\nsize 4285914\n")
            .expect("it is written");
        let error = open_regular(&path).expect_err("it is refused").to_string();
        assert!(error.contains("Git LFS") && error.contains("git lfs pull"), "{error}");
        std::fs::write(&path, "version 2\nv 0 0 0\n").expect("it is written");
        let text = io::read_to_string(open_regular(&path).expect("it is a file")).expect("it is text");
        assert_eq!(text, "version 2\nv 0 0 0\n", "it is read from its beginning");
    }
}
