//! The texts of a scene, and places in them.
use std::{cell::Cell, collections::HashSet, fmt, io::Read, path::Path, rc::Rc};

use flate2::read::MultiGzDecoder;

use crate::import::Folder;
use noisefall_base::{
    file::open_regular,
    memory::{Reservation, reserve},
};
use noisefall_scene::scene::{SceneError, SourceText};

/// Larger files are refused, before and after they are unpacked.
const LARGEST_FILE: u64 = 1 << 31;
/// Bytes that files may have together when they are read a second time: a small file can include itself by detours a thousand times.
const MOST_REPEATED: u64 = 64 << 20;
/// Every repetition counts at least as many bytes.
const LEAST_REPEATED: u64 = 4096;

/// A range of bytes in a text, with the line and column of its start, from 1.
#[derive(Clone, Debug)]
pub struct TextSpan {
    pub source: Rc<SourceText>,
    pub start: usize,
    pub end: usize,
    pub line: u32,
    pub column: u32,
}

impl TextSpan {
    /// An error at this place. `label` stands at the caret.
    pub fn error(&self, message: impl Into<String>, label: impl Into<String>) -> SceneError {
        self.source.error(self.start..self.end, message, label)
    }
}

impl fmt::Display for TextSpan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.source.name, self.line, self.column)
    }
}

/// Reads the files of a scene.
pub struct SourceFiles {
    pub folder: Folder,
    known: HashSet<String>,
    repeated: Cell<u64>,
    /// Bytes of all texts.
    pub bytes: u64,
    memory: Reservation,
}

impl SourceFiles {
    /// Reads files within a folder.
    pub fn new(folder: Folder) -> SourceFiles {
        SourceFiles { folder, known: HashSet::new(), repeated: Cell::new(0), bytes: 0, memory: Reservation::none() }
    }

    /// The text of a file, which may be packed by gzip. An error is a sentence without the path.
    pub fn text(&mut self, path: &Path) -> Result<Rc<SourceText>, String> {
        let (bytes, room) = unpacked(path, &self.folder)?;
        let length = bytes.len() as u64;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if !self.known.insert(path.display().to_string()) {
            self.repeated.set(self.repeated.get() + length.max(LEAST_REPEATED));
            if self.repeated.get() > MOST_REPEATED {
                return Err("files are included too many times".to_owned());
            }
        }
        self.bytes += length;
        self.memory.grow("the bytes of the scene files", length).map_err(|error| error.to_string())?;
        drop(room);
        let text = String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
        Ok(Rc::new(SourceText { name, text }))
    }
}

/// The bytes of a file, unpacked if its name ends in `.gz`.
pub fn unpacked(path: &Path, folder: &Folder) -> Result<(Vec<u8>, Reservation), String> {
    let message = |error: std::io::Error| format!("the file cannot be read: {error}");
    let file = open_regular(path).map_err(message)?;
    let length = file.metadata().map_err(message)?.len();
    if length > LARGEST_FILE {
        return Err(format!("the file is larger than {LARGEST_FILE} bytes"));
    }
    let mut room = reserve("bytes of a file", length).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz")) {
        file.take(LARGEST_FILE).read_to_end(&mut bytes).map_err(message)?;
        return Ok((bytes, room));
    }
    folder.budget.packed(length);
    let mut unpacked = MultiGzDecoder::new(std::io::BufReader::new(file));
    // Little at a time: a small file can claim gigabytes.
    const CHUNK: u64 = 1 << 22;
    loop {
        let before = bytes.len();
        (&mut unpacked).take(CHUNK).read_to_end(&mut bytes).map_err(message)?;
        if bytes.len() == before {
            return Ok((bytes, room));
        }
        let more = (bytes.len() - before) as u64;
        folder.budget.unpack(more)?;
        room.grow("bytes of an unpacked file", more).map_err(|error| error.to_string())?;
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(format!("the unpacked file is larger than {LARGEST_FILE} bytes"));
        }
    }
}
