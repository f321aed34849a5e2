//! Resources of a compile: files beside the scene, memory, and the slow parts of the previous compile.
use std::{
    cell::RefCell,
    fmt,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

use super::{
    Assets, NamedFile, Problem,
    memo::{CheckpointPart, Memo, PartReport},
};
use crate::{memory::Reservation, progress::Progress};

/// The folder of relative paths, the memory reserved so far, and the slow parts.
pub struct Resources {
    folder: PathBuf,
    assets: Assets,
    progress: Progress,
    memory: RefCell<Reservation>,
    /// Parts of the previous compile.
    before: Memo,
    /// Parts of this compile.
    now: RefCell<Memo>,
    report: RefCell<Vec<PartReport>>,
}

/// Results of a compile besides the scene: the memory that it took, its slow parts, and a report of them.
pub struct Leftovers {
    /// Memory of everything that is not in the memo.
    pub memory: Reservation,
    /// The slow parts, for the next compile.
    pub memo: Memo,
    /// One entry per kind of part.
    pub report: Vec<PartReport>,
}

impl Resources {
    /// Looks for files in `folder`.
    pub fn new(folder: impl Into<PathBuf>) -> Resources {
        Resources::after(folder, Memo::default())
    }

    /// Creates resources that reuse the slow parts of the compile `before`.
    pub fn after(folder: impl Into<PathBuf>, before: Memo) -> Resources {
        Resources {
            folder: folder.into(),
            assets: Assets::default(),
            progress: Progress::default(),
            memory: RefCell::new(Reservation::none()),
            before,
            now: RefCell::default(),
            report: RefCell::default(),
        }
    }

    /// Looks for files in memory first.
    pub fn with_assets(self, assets: Assets) -> Resources {
        Resources { assets, ..self }
    }

    /// Reports to `progress`, which can also cancel the compile.
    pub fn with_progress(self, progress: Progress) -> Resources {
        Resources { progress, ..self }
    }

    /// The progress of the compile.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// A file that a description names.
    pub fn file(&self, named: &str) -> NamedFile {
        NamedFile::new(self.path(named), self.assets.asset(named), self.assets.loaded())
    }

    /// A path that a description names.
    pub fn path(&self, relative: &str) -> PathBuf {
        if self.folder == Path::new("") { PathBuf::from(relative) } else { self.folder.join(relative) }
    }

    /// Reserves memory for `what`, a plural noun, that the value at a key requires.
    pub fn reserve(&self, key: &str, what: impl fmt::Display, bytes: u64) -> Result<(), Problem> {
        self.memory.borrow_mut().grow(what, bytes).map_err(|error| Problem::at(key, error.to_string(), "too much memory"))
    }

    /// The part with this key, made once per compile or reused from the previous one. `part` names its kind in the report.
    pub fn once<T: Send + Sync + 'static>(
        &self,
        part: &'static str,
        key: String,
        make: impl FnOnce() -> Result<T, Problem>,
    ) -> Result<Arc<T>, Problem> {
        let is_known = self.now.borrow().get(&key).is_some();
        let start = Instant::now();
        let mut is_made = false;
        let value = self.hold(key, || {
            is_made = true;
            make()
        })?;
        if !is_known {
            self.note(part, is_made.then(|| start.elapsed()));
        }
        Ok(value)
    }

    /// [`Resources::once`] for parts that the report leaves out.
    pub fn hold<T: Send + Sync + 'static>(
        &self,
        key: String,
        make: impl FnOnce() -> Result<T, Problem>,
    ) -> Result<Arc<T>, Problem> {
        let known = self.now.borrow().get(&key).and_then(CheckpointPart::value);
        if let Some(value) = known {
            return Ok(value);
        }
        if let Some((kept, value)) = self.before.get(&key).and_then(|kept| Some((kept, kept.value()?))) {
            self.now.borrow_mut().insert(key, kept.clone());
            return Ok(value);
        }
        // The memory of a part is released with the part, not with the scene that made it.
        let around = self.memory.replace(Reservation::none());
        let made = make();
        let memory = self.memory.replace(around);
        let value = Arc::new(made?);
        self.now.borrow_mut().insert(key, CheckpointPart::new(value.clone(), memory));
        Ok(value)
    }

    /// Reports a part: the time that it took to make, or `None` if it was reused.
    pub fn note(&self, part: &'static str, took: Option<Duration>) {
        let mut report = self.report.borrow_mut();
        let place = report.iter().position(|of| of.part == part).unwrap_or_else(|| {
            report.push(PartReport { part, made: 0, reused: 0, took: Duration::ZERO });
            report.len() - 1
        });
        match took {
            Some(took) => {
                report[place].made += 1;
                report[place].took += took;
            }
            None => report[place].reused += 1,
        }
    }

    /// Ends the compile.
    pub fn into_leftovers(self) -> Leftovers {
        Leftovers { memory: self.memory.into_inner(), memo: self.now.into_inner(), report: self.report.into_inner() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn three(resources: &Resources, key: &str) -> Arc<Vec<u8>> {
        let make = || {
            resources.reserve("", "numbers", 3)?;
            Ok(vec![1, 2, 3])
        };
        resources.once("lists", key.to_owned(), make).expect("there is room")
    }

    #[test]
    fn a_part_is_made_once_and_reused_while_compiles_use_it() {
        let first = Resources::new("");
        let (a, again) = (three(&first, "a"), three(&first, "a"));
        assert!(Arc::ptr_eq(&a, &again));
        let left = first.into_leftovers();
        assert_eq!((left.report[0].part, left.report[0].made, left.report[0].reused), ("lists", 1, 0));
        let second = Resources::after("", left.memo);
        assert!(Arc::ptr_eq(&a, &three(&second, "a")) && !Arc::ptr_eq(&a, &three(&second, "b")));
        let left = second.into_leftovers();
        assert_eq!((left.report[0].made, left.report[0].reused), (1, 1));
        // Parts that a compile does not use are gone for the next one.
        let third = Resources::after("", Resources::after("", left.memo).into_leftovers().memo);
        assert!(!Arc::ptr_eq(&a, &three(&third, "a")));
    }

    #[test]
    fn a_part_that_fails_is_not_kept() {
        let resources = Resources::new("");
        let fail = || Err::<u8, _>(Problem::at("", "no", "no"));
        assert!(resources.once("lists", "a".to_owned(), fail).is_err());
        assert_eq!(*resources.once("lists", "a".to_owned(), || Ok(7u8)).expect("it is made"), 7);
    }
}
