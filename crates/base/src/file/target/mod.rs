//! Atomic writes: a file appears whole or not at all, and only regular files are ever replaced.
//!
//! The bytes are written to a temporary file beside the target, synced to disk, and renamed. The temporary file is locked while
//! it is written. One without a lock was left behind by a killed process, and the next write to the same name removes it.
use std::{
    ffi::{OsStr, OsString},
    fs::{self, File, FileType, TryLockError},
    hash::{DefaultHasher, Hash, Hasher},
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use super::{durable::fill, short_name::cut};

/// Marks the name of a temporary file: `.picture.png.noisefall-AbC123.part`.
const MARK: &str = ".noisefall-";
const SUFFIX: &str = ".part";
const RANDOM_LETTERS: usize = 6;

/// Error of writing a file.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder of the file does not exist.
    #[error("{}: there is no folder {}", path.display(), folder.display())]
    NoFolder {
        /// The file.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// The path is a folder, a device or the like.
    #[error("{}: cannot be written: it is {what}, and output only replaces regular files", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// The kind of item at the path.
        what: &'static str,
    },
    /// A link stands where no link is followed.
    #[error(
        "{}: is not written: {} is a link, which may lead to a file of yours; remove the link",
        path.display(),
        link.display()
    )]
    Link {
        /// The file.
        path: PathBuf,
        /// The link.
        link: PathBuf,
    },
    /// The system refuses.
    #[error("{}: cannot be written: {reason}", path.display())]
    Failed {
        /// The file.
        path: PathBuf,
        /// The message of the operating system.
        reason: String,
    },
}

impl WriteError {
    pub(super) fn failed(path: &Path, reason: &str) -> WriteError {
        WriteError::Failed { path: path.to_owned(), reason: reason.to_owned() }
    }
}

/// Checks whether a file can be written to this path, as far as this is known before there are bytes.
pub fn check(path: &Path) -> Result<(), WriteError> {
    // Made and removed again: a folder that cannot be written to is better known before an hour of rendering than after.
    OutputFile::of(path)?.temporary().map(drop).map_err(|error| failed(path, &error))
}

/// Replaces a file, or leaves it unchanged on failure. Symbolic links are followed.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    replace_by(path, |to| to.write_all(bytes))
}

/// Replaces a file with bytes that are written piece by piece.
pub fn replace_by(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    OutputFile::of(path)?.replace(write)
}

fn failed(path: &Path, error: &io::Error) -> WriteError {
    // Some errors name the temporary file, which says nothing to anybody.
    let reason = error.to_string();
    let reason = reason.split(" at path ").next().unwrap_or_default();
    let remedy = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => ": free some space there, or choose another disk",
        ErrorKind::ReadOnlyFilesystem | ErrorKind::PermissionDenied => ": choose another folder",
        ErrorKind::FileTooLarge => ": raise the limit on the size of files (`ulimit -f`), or choose another disk",
        _ => "",
    };
    WriteError::Failed { path: path.to_owned(), reason: format!("{reason}{remedy}") }
}

/// A file to write.
pub(super) struct OutputFile {
    /// As it was given, for messages.
    given: PathBuf,
    /// The path with symbolic links resolved: a rename to a link would replace the link.
    path: PathBuf,
    folder: PathBuf,
    name: OsString,
}

impl OutputFile {
    fn of(path: &Path) -> Result<OutputFile, WriteError> {
        // Before links are followed by name: some lead to what has no name, such as a pipe.
        match fs::metadata(path) {
            Ok(there) => {
                if let Some(what) = other_than_a_file(there.file_type()) {
                    return Err(WriteError::NotAFile { path: path.to_owned(), what });
                }
            }
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(failed(path, &error)),
        }
        let end = through_links(path);
        let file = OutputFile::at(path, end);
        if !file.folder.is_dir() {
            return Err(WriteError::NoFolder { path: path.to_owned(), folder: file.folder });
        }
        Ok(file)
    }

    /// A file that is no link, and whose folder may be missing.
    pub(super) fn without_links(path: &Path) -> Result<OutputFile, WriteError> {
        match fs::symlink_metadata(path) {
            Ok(there) if there.is_symlink() => Err(WriteError::Link { path: path.to_owned(), link: path.to_owned() }),
            Ok(there) => match other_than_a_file(there.file_type()) {
                Some(what) => Err(WriteError::NotAFile { path: path.to_owned(), what }),
                None => Ok(OutputFile::at(path, path.to_owned())),
            },
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(OutputFile::at(path, path.to_owned())),
            Err(error) => Err(failed(path, &error)),
        }
    }

    fn at(given: &Path, path: PathBuf) -> OutputFile {
        let parent = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = parent.unwrap_or_else(|| Path::new(".")).to_owned();
        let name = path.file_name().unwrap_or_default().to_owned();
        OutputFile { given: given.to_owned(), path, folder, name }
    }

    /// Writes the file to the disk under another name, and renames it.
    pub(super) fn replace(&self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
        let write = || {
            let mut file = self.temporary()?;
            if let Some(disk) = super::faults::disk(&self.path) {
                return disk.put(file, &self.path, write);
            }
            fill(file.as_file_mut(), write)?;
            file.persist(&self.path)?;
            Ok(())
        };
        write().map_err(|error| failed(&self.given, &error))
    }

    /// An empty file beside the target that disappears unless it is renamed. It is locked, and has the target's permissions.
    fn temporary(&self) -> io::Result<NamedTempFile> {
        const ATTEMPTS: u32 = 16;
        self.remove_leftovers();
        let prefix = prefix(&self.name);
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(SUFFIX).rand_bytes(RANDOM_LETTERS);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        for _ in 0..ATTEMPTS {
            let file = builder.tempfile_in(&self.folder)?;
            // Not every file system has locks. Where there are none, nobody can lock a leftover either, and it stays.
            let is_taken = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
            // Before it was locked, it could have been taken for a leftover.
            if is_taken || !file.path().exists() {
                continue;
            }
            #[cfg(unix)]
            if let Ok(there) = fs::metadata(&self.path) {
                file.as_file().set_permissions(there.permissions())?;
            }
            return Ok(file);
        }
        Err(io::Error::other("others keep removing its temporary file"))
    }

    /// Removes temporary files of this target whose process is gone.
    fn remove_leftovers(&self) {
        let prefix = prefix(&self.name);
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        for entry in entries.flatten().filter(|entry| is_part(&entry.file_name(), &prefix)) {
            let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
            let Some(file) = is_file.then(|| File::open(entry.path()).ok()).flatten() else { continue };
            if file.try_lock().is_ok() {
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

/// Names the type of a file that is not regular.
fn other_than_a_file(kind: FileType) -> Option<&'static str> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return Some("a named pipe");
        } else if kind.is_socket() {
            return Some("a socket");
        } else if kind.is_char_device() || kind.is_block_device() {
            return Some("a device");
        }
    }
    match (kind.is_dir(), kind.is_file()) {
        (true, _) => Some("a folder"),
        (_, true) => None,
        _ => Some("something else"),
    }
}

/// Resolves symbolic links to their final target, which need not exist.
fn through_links(path: &Path) -> PathBuf {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(to) = fs::read_link(&path) else { break };
        path = path.parent().map_or_else(|| to.clone(), |folder| folder.join(&to));
    }
    path
}

/// The prefix of temporary files of a target. It is truncated for long names, because names have at most 255 bytes.
fn prefix(name: &OsStr) -> OsString {
    const LONGEST: usize = 200;
    const KEPT_BYTES: usize = 80;
    let mut prefix = OsString::from(".");
    if name.len() <= LONGEST {
        prefix.push(name);
    } else {
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        prefix.push(format!("{}-{:016x}", cut(&name.to_string_lossy(), KEPT_BYTES), hasher.finish()));
    }
    prefix.push(MARK);
    prefix
}

/// Whether a file is a temporary one of the target with this prefix.
fn is_part(name: &OsStr, prefix: &OsStr) -> bool {
    let rest = name.as_encoded_bytes().strip_prefix(prefix.as_encoded_bytes());
    let random = rest.and_then(|rest| rest.strip_suffix(SUFFIX.as_bytes()));
    random.is_some_and(|random| random.len() == RANDOM_LETTERS && random.iter().all(u8::is_ascii_alphanumeric))
}

#[cfg(test)]
mod tests;
