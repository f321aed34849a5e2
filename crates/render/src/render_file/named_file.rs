//! The files that a scene names, by what is in them.
use std::{
    io::{self, Read},
    path::Path,
};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use noisefall_base::{file::open_regular, quote};

/// A file beside the scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NamedFile {
    /// The path as the scene writes it.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

impl NamedFile {
    /// Reads the file at a path that is relative to a folder, or absolute.
    pub fn of(folder: &Path, path: &str) -> io::Result<NamedFile> {
        const CHUNK: usize = 1 << 20;
        let mut file = open_regular(&folder.join(path))?;
        let (mut hash, mut bytes, mut chunk) = (Sha256::new(), 0, vec![0; CHUNK]);
        loop {
            match file.read(&mut chunk) {
                Ok(0) => break,
                Ok(count) => {
                    hash.update(&chunk[..count]);
                    bytes += count as u64;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(NamedFile { path: path.to_owned(), bytes, sha256: digits(&hash.finalize()) })
    }

    /// Says how the file differs from this record; `None` if it does not.
    pub fn difference(&self, folder: &Path) -> Option<String> {
        let shown = quote::path(&folder.join(&self.path));
        match NamedFile::of(folder, &self.path) {
            Ok(now) if now == *self => None,
            Ok(now) if now.bytes != self.bytes => Some(format!("{shown} has {} bytes, not {}", now.bytes, self.bytes)),
            Ok(_) => Some(format!("{shown} has other contents")),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Some(format!("{shown} is missing")),
            Err(error) => Some(format!("{shown} cannot be read: {error}")),
        }
    }
}

/// SHA-256 of some bytes, in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    digits(&Sha256::digest(bytes))
}

fn digits(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
