//! Writes files: each appears whole or not at all, and nothing but a regular file is ever replaced.
//!
//! Bytes go to a file beside the target, are brought to the disk, and are then renamed. That file is locked while it is written;
//! one that is not locked was left behind by a process that was killed, and the next write to the same name removes it.
use std::{
    ffi::{OsStr, OsString},
    fs::{self, File, FileType, TryLockError},
    hash::{DefaultHasher, Hash, Hasher},
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

/// What the name of a temporary file has besides that of its target: `.picture.png.noisefall-AbC123.part`.
const MARK: &str = ".noisefall-";
const SUFFIX: &str = ".part";
const RANDOM_LETTERS: usize = 6;

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    #[error("{}: there is no folder {}", path.display(), folder.display())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("{}: cannot be written: it is {what}, and output only replaces regular files", path.display())]
    NotAFile { path: PathBuf, what: &'static str },
    #[error("{}: cannot be written: {reason}", path.display())]
    Failed { path: PathBuf, reason: String },
}

/// Whether a file could be written there, as far as this can be known before there are bytes.
pub fn check(path: &Path) -> Result<(), WriteError> {
    // Made and removed again: a folder that cannot be written to is better known before an hour of rendering than after.
    Target::of(path)?.temporary().map(drop).map_err(|error| failed(path, &error))
}

/// Replaces a file, or leaves it as it is if that fails. Symbolic links are written through.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let target = Target::of(path)?;
    let write = || {
        let mut file = target.temporary()?;
        fill(file.as_file_mut(), bytes)?;
        file.persist(&target.path)?;
        Ok(())
    };
    write().map_err(|error| failed(path, &error))
}

fn failed(path: &Path, error: &io::Error) -> WriteError {
    // Some errors name the temporary file, which says nothing to anybody.
    let reason = error.to_string();
    let reason = reason.split(" at path ").next().unwrap_or_default().to_owned();
    WriteError::Failed { path: path.to_owned(), reason }
}

/// What keeps its bytes through a loss of power, once it has been told to.
trait Durable: Write {
    fn sync(&self) -> io::Result<()>;
}

impl Durable for File {
    fn sync(&self) -> io::Result<()> {
        self.sync_all()
    }
}

/// A rename must not reach the disk before the bytes do.
fn fill(file: &mut impl Durable, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    file.sync()
}

/// A file to write.
struct Target {
    /// Without symbolic links at its end: a rename to a link would replace the link.
    path: PathBuf,
    folder: PathBuf,
    name: OsString,
}

impl Target {
    fn of(path: &Path) -> Result<Target, WriteError> {
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
        let parent = end.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = parent.unwrap_or_else(|| Path::new(".")).to_owned();
        if !folder.is_dir() {
            return Err(WriteError::NoFolder { path: path.to_owned(), folder });
        }
        let name = end.file_name().unwrap_or_default().to_owned();
        Ok(Target { path: end, folder, name })
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

/// What there is in place of a regular file.
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

/// What a symbolic link stands for in the end, there or not.
fn through_links(path: &Path) -> PathBuf {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(to) = fs::read_link(&path) else { break };
        path = path.parent().map_or_else(|| to.clone(), |folder| folder.join(&to));
    }
    path
}

/// What the names of temporary files of a target begin with. Names must not be longer than 255 bytes, so that of a long one is cut.
fn prefix(name: &OsStr) -> OsString {
    const LONGEST: usize = 200;
    const KEPT_LETTERS: usize = 40;
    let mut prefix = OsString::from(".");
    if name.len() <= LONGEST {
        prefix.push(name);
    } else {
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        let start: String = name.to_string_lossy().chars().take(KEPT_LETTERS).collect();
        prefix.push(format!("{start}-{:016x}", hasher.finish()));
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
