//! What kinds use while they are compiled: files beside the scene, and memory.
use std::{
    cell::RefCell,
    fmt,
    path::{Path, PathBuf},
};

use super::Problem;
use crate::memory::Reservation;

/// The folder that paths are relative to, and the memory that is taken so far.
pub struct Resources {
    folder: PathBuf,
    memory: RefCell<Reservation>,
}

impl Resources {
    /// Files are looked for in `folder`.
    pub fn new(folder: impl Into<PathBuf>) -> Resources {
        Resources { folder: folder.into(), memory: RefCell::new(Reservation::none()) }
    }

    /// A path that a description names.
    pub fn path(&self, relative: &str) -> PathBuf {
        if self.folder == Path::new("") { PathBuf::from(relative) } else { self.folder.join(relative) }
    }

    /// Takes room for `what`, a plural, that the value at a key asks for.
    pub fn reserve(&self, key: &str, what: impl fmt::Display, bytes: u64) -> Result<(), Problem> {
        self.memory.borrow_mut().grow(what, bytes).map_err(|error| Problem::at(key, error.to_string(), "too much memory"))
    }

    /// All that was taken.
    pub fn into_memory(self) -> Reservation {
        self.memory.into_inner()
    }
}
