//! Missing files of a scene. A reader goes on past each, so that all of them are named at once.
use std::{
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use noisefall_scene::scene::SceneError;

/// Why a path leads to no file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unresolved {
    pub message: String,
    /// There is no such file, rather than one that must not be read.
    pub is_missing: bool,
}

impl From<Unresolved> for String {
    fn from(why: Unresolved) -> String {
        why.message
    }
}

impl Unresolved {
    /// A file that must not be read.
    pub fn refused(message: String) -> Unresolved {
        Unresolved { message, is_missing: false }
    }
}

/// Failures of parts that are put down to missing files. Each costs a pass over the text of the file.
const MOST_FAILURES: usize = 10 * SceneError::MOST;

/// The missing files so far. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct Missing(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    /// One for each file.
    errors: Vec<SceneError>,
    failures: usize,
}

impl Missing {
    /// A file that the scene needs. If it is missing, `error` makes the error at the place that names it, which is noted.
    pub fn require(
        &self,
        found: Result<PathBuf, Unresolved>,
        error: impl FnOnce(String) -> SceneError,
    ) -> Result<PathBuf, SceneError> {
        found.map_err(|why| {
            let error = error(why.message);
            let mut state = self.state();
            if why.is_missing && state.errors.iter().all(|known| known.to_string() != error.to_string()) {
                state.errors.push(error.clone());
            }
            error
        })
    }

    /// Reads a part of a scene that others can be read without. `None` if it failed where files are missing: what follows may be wrong,
    /// and [`Missing::finish`] refuses the scene.
    pub fn part<T>(&self, read: impl FnOnce() -> Result<T, SceneError>) -> Result<Option<T>, SceneError> {
        let result = read();
        let mut state = self.state();
        state.failures += usize::from(result.is_err());
        let goes_on = (1..SceneError::MOST).contains(&state.errors.len()) && state.failures < MOST_FAILURES;
        match result {
            Err(_) if goes_on => Ok(None),
            result => result.map(Some),
        }
    }

    /// Returns the result of reading, or else an error that names all missing files. Other errors may only follow from them.
    pub fn finish<T>(&self, read: Result<T, SceneError>) -> Result<T, SceneError> {
        SceneError::of_all(self.state().errors.clone()).map_or(read, Err)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
