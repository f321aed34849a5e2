//! `merge --watch`: files of samples that arrive, and are replaced by longer ones.
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

use noisefall_base::{declare::key_of_file, quote};
use noisefall_render::render::{
    checkpoint::is_checkpoint_file,
    split::{Join, SampleFile, SampleFileError},
};

use super::messages::{Failure, tell};

/// Files, and folders of files, whose samples are joined as they arrive.
pub struct Watch<'a> {
    files: &'a [PathBuf],
    /// The file that is written.
    output: &'a Path,
    join: Option<Join>,
    /// The files that were joined, each with the [`key_of_file`] from before it was read.
    joined: BTreeMap<PathBuf, String>,
    unusable: BTreeMap<PathBuf, Unusable>,
}

/// A file that could not be read at the last look.
struct Unusable {
    key: String,
    is_told: bool,
}

impl<'a> Watch<'a> {
    pub fn new(files: &'a [PathBuf], output: &'a Path) -> Watch<'a> {
        Watch { files, output, join: None, joined: BTreeMap::new(), unusable: BTreeMap::new() }
    }

    /// Joins the files that are new. Returns whether all samples up to `until` are there.
    pub fn look(&mut self, until: Option<u32>) -> Result<bool, Failure> {
        for (path, key) in self.present().into_iter().map(|path| (path.clone(), key_of_file(&path))) {
            if self.joined.get(&path) == Some(&key)
                || self.unusable.get(&path).is_some_and(|file| file.is_told && file.key == key)
            {
                continue;
            }
            match whole(&path) {
                Ok(_) if self.joined.contains_key(&path) => {
                    // Sums cannot be taken out again.
                    tell(&format!("{}: was replaced; all files are joined again", quote::path(&path)));
                    (self.join, self.joined) = (None, BTreeMap::new());
                    return self.look(until);
                }
                Ok(file) => self.add(path, key, file, until)?,
                Err(error) => self.note(path, key, &error),
            }
        }
        Ok(self.join.as_ref().is_some_and(|join| join.samples().missing(until).is_empty()))
    }

    /// Returns the joined samples.
    pub fn into_join(self) -> Option<Join> {
        self.join
    }

    fn add(&mut self, path: PathBuf, key: String, file: SampleFile, until: Option<u32>) -> Result<(), Failure> {
        let mut join = match self.join.take() {
            Some(join) => join,
            None => Join::begin(&file).map_err(|error| error.to_string())?,
        };
        join.enter(&file).and_then(|()| join.add(file)).map_err(|error| error.to_string())?;
        let missing = join.samples().missing(until);
        let left = if missing.is_empty() { "complete".to_owned() } else { format!("missing: {missing}") };
        tell(&format!("{}: joined; samples {}, {left}", quote::path(&path), join.samples()));
        self.join = Some(join);
        self.unusable.remove(&path);
        self.joined.insert(path, key);
        Ok(())
    }

    /// Tells once that a file cannot be used. One that is different at the next look is still on its way.
    fn note(&mut self, path: PathBuf, key: String, error: &SampleFileError) {
        let is_told = path.exists() && self.unusable.get(&path).is_some_and(|before| before.key == key);
        if is_told {
            tell(&format!("warning: {error}. It is left out until it is replaced"));
        }
        self.unusable.insert(path, Unusable { key, is_told });
    }

    /// The files that are there now, those in folders included.
    fn present(&self) -> BTreeSet<PathBuf> {
        let mut present = BTreeSet::new();
        for path in self.files {
            match std::fs::read_dir(path) {
                Ok(entries) => present.extend(entries.flatten().map(|entry| entry.path()).filter(|path| self.is_source(path))),
                Err(_) => _ = present.insert(path.clone()),
            }
        }
        present
    }

    /// Whether a file of a folder is to be joined.
    fn is_source(&self, path: &Path) -> bool {
        is_checkpoint_file(path) && path != self.output
    }
}

/// Opens a file, if all of it is there.
fn whole(path: &Path) -> Result<SampleFile, SampleFileError> {
    SampleFile::open(path)?.read(|_, _| Ok::<(), SampleFileError>(()))?;
    SampleFile::open(path)
}
