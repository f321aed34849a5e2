//! The store of measurements: `study.csv`. Runs are found by their keys. Runs of other studies stay in it.
//!
//! Several processes can measure in one folder. Each reads what the others have written before it writes, under a lock. Stores are
//! joined by appending one to the other.
use std::{
    collections::HashMap,
    fs::File,
    io::{ErrorKind, Read},
    path::{Path, PathBuf},
};

use super::{
    StudyError,
    measure::Run,
    row::{self, Row},
};
use noisefall_base::file::{open_regular, replace};

/// Name of the file.
pub const CSV: &str = "study.csv";

/// The file whose lock is held while the store is written. The store itself is replaced, which would end a lock on it.
const LOCK: &str = ".study.lock";

/// The measurements in a folder.
pub struct Store {
    folder: PathBuf,
    /// The lines of each run, in file order.
    runs: Vec<Vec<Row>>,
    places: HashMap<String, usize>,
    /// Number of lines that were ignored because they or their runs were truncated.
    pub dropped: usize,
}

impl Store {
    /// Opens the store of a folder.
    pub fn open(folder: &Path) -> Result<Store, StudyError> {
        let path = folder.join(CSV);
        let failed = |reason: String| StudyError::File { path: path.clone(), reason };
        let read = |mut file: File| {
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).map(|_| bytes)
        };
        match open_regular(&path).and_then(read) {
            Ok(bytes) => Store::read(folder, &bytes).map_err(failed),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Store::empty(folder)),
            Err(error) => Err(failed(format!("cannot be read: {error}"))),
        }
    }

    fn empty(folder: &Path) -> Store {
        Store { folder: folder.to_owned(), runs: Vec::new(), places: HashMap::new(), dropped: 0 }
    }

    fn read(folder: &Path, bytes: &[u8]) -> Result<Store, String> {
        let mut store = Store::empty(folder);
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.byte_headers().map_err(|error| error.to_string())?;
        if !bytes.is_empty() && *header != Row::columns().map_err(|error| error.to_string())? {
            let advice = "move it away, or give another folder";
            return Err(format!("was not written by `noisefall study` of this version: {advice}"));
        }
        let header = header.clone();
        for line in reader.byte_records() {
            match line.map(|line| (line == header, line.deserialize::<Row>(None))) {
                Ok((_, Ok(row))) if row.is_whole() => store.push(row),
                // It begins a store that was appended.
                Ok((true, _)) => {}
                _ => store.dropped += 1,
            }
        }
        store.forget_incomplete();
        Ok(store)
    }

    fn push(&mut self, row: Row) {
        let place = *self.places.entry(row.measured.key.clone()).or_insert(self.runs.len());
        if place == self.runs.len() {
            self.runs.push(Vec::new());
        }
        let rows = &mut self.runs[place];
        // A run that is there twice was measured by two processes at the same time, or is in two stores that were joined.
        if rows.len() == row.measured.checkpoints {
            return;
        }
        if row.measured.checkpoint == 1 {
            self.dropped += std::mem::take(rows).len();
        }
        rows.push(row);
    }

    fn forget_incomplete(&mut self) {
        let all = std::mem::take(&mut self.runs);
        self.places.clear();
        for rows in all {
            match row::run(&rows) {
                Some(_) => rows.into_iter().for_each(|row| self.push(row)),
                None => self.dropped += rows.len(),
            }
        }
    }

    /// The run with a key, if it has been measured.
    pub fn run(&self, key: &str) -> Option<Run> {
        row::run(&self.runs[*self.places.get(key)?])
    }

    /// Number of runs, of all studies.
    pub fn len(&self) -> usize {
        self.runs.len()
    }

    /// Whether there are no runs.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Adds the lines of a run, and writes them to the file before it returns. Keeps what other processes have written.
    pub fn add(&mut self, rows: Vec<Row>) -> Result<(), StudyError> {
        let _lock = self.lock()?;
        self.refresh()?;
        rows.into_iter().for_each(|row| self.push(row));
        let path = self.folder.join(CSV);
        match self.bytes() {
            Ok(bytes) => Ok(replace(&path, &bytes)?),
            Err(reason) => Err(StudyError::File { path, reason }),
        }
    }

    /// Reads what other processes have written.
    pub fn refresh(&mut self) -> Result<(), StudyError> {
        *self = Store { dropped: self.dropped, ..Store::open(&self.folder)? };
        Ok(())
    }

    /// Waits until no other process writes the store. On file systems without locks it does not wait.
    fn lock(&self) -> Result<File, StudyError> {
        let path = self.folder.join(LOCK);
        let open = File::options().create(true).truncate(false).write(true).open(&path);
        let lock = open.and_then(|file| match file.lock() {
            Err(error) if error.kind() != ErrorKind::Unsupported => Err(error),
            _ => Ok(file),
        });
        lock.map_err(|error| StudyError::File { path, reason: format!("cannot be locked: {error}") })
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        let written = || {
            let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
            if !self.is_empty() {
                writer.write_byte_record(&Row::columns()?)?;
            }
            self.runs.iter().flatten().try_for_each(|row| writer.serialize(row))?;
            writer.into_inner().map_err(csv::IntoInnerError::into_error).map_err(csv::Error::from)
        };
        written().map_err(|error| error.to_string())
    }
}
