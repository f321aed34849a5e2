//! Problems of a description, collected over its tables.
use crate::scene::{damage::Damage, diagnostic::SceneError};
use noisefall_base::declare::{Path, Problem};

/// Collects problems. A problem in one table does not stop the checks of the others.
pub struct Problems<'d> {
    pub damage: &'d Damage,
    pub found: Vec<Problem>,
}

impl<'d> Problems<'d> {
    pub fn new(damage: &'d Damage) -> Problems<'d> {
        Problems { damage, found: Vec::new() }
    }

    /// More are not looked for.
    const MOST: usize = SceneError::MOST;

    /// The value, or `None` if it has a problem, which is kept. An incomplete table is not compiled: its problem has been reported, and
    /// its values may be out of range.
    pub fn keep<T>(&mut self, table: &Path, compile: impl FnOnce() -> Result<T, Problem>) -> Option<T> {
        if self.damage.reaches(table) {
            return None;
        }
        compile().map_err(|problem| self.found.push(problem.within(table))).ok()
    }

    pub fn are_many(&self) -> bool {
        self.found.len() >= Self::MOST
    }
}
