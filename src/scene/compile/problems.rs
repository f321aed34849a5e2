//! Collects the problems of a description.
use crate::{
    declare::{Path, Problem},
    scene::{damage::Damage, diagnostic::SceneError},
};

/// Collects what is wrong: a problem in one table does not keep the others from being looked at.
pub struct Problems<'d> {
    pub damage: &'d Damage,
    pub found: Vec<Problem>,
}

impl Problems<'_> {
    /// More are not looked for.
    const MOST: usize = SceneError::MOST;

    /// The value, or `None` where its problem is kept. What is wrong with a table that something was left out of is no news.
    pub fn keep<T>(&mut self, table: &Path, result: Result<T, Problem>) -> Option<T> {
        result
            .map_err(|problem| {
                if !self.damage.reaches(table) {
                    self.found.push(problem.within(table));
                }
            })
            .ok()
    }

    pub fn are_many(&self) -> bool {
        self.found.len() >= Self::MOST
    }
}
