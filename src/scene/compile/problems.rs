//! What is wrong with a description, collected over its tables.
use crate::{
    declare::{Path, Problem},
    scene::{damage::Damage, diagnostic::SceneError},
};

/// Collects what is wrong: a problem in one table does not keep the others from being looked at.
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

    /// The value, or `None` where its problem is kept. A table that something was left out of is not compiled: what is wrong with it has
    /// been said, and its values may be out of all ranges.
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
