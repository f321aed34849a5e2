//! Collecting the errors of a scene file: what is wrong with one table does not keep the others from being looked at.
use std::ops::Range;

use toml::Spanned;

use super::{describe::Damage, diagnostic::SceneError};

pub struct Errors<'d> {
    damage: &'d Damage,
    found: Vec<SceneError>,
}

impl<'d> Errors<'d> {
    pub fn new(damage: &'d Damage) -> Errors<'d> {
        Errors { damage, found: Vec::new() }
    }

    /// The value, or `None` where its error is kept. What is wrong with a table that something was left out of is no news.
    pub fn keep<T, D>(&mut self, table: &Spanned<D>, result: Result<T, SceneError>) -> Option<T> {
        self.keep_at(&table.span(), result)
    }

    /// [`Errors::keep`] of a table in this place.
    pub fn keep_at<T>(&mut self, table: &Range<usize>, result: Result<T, SceneError>) -> Option<T> {
        result
            .map_err(|error| {
                if !self.damage.reaches(table) {
                    self.found.push(error);
                }
            })
            .ok()
    }

    /// The keys of a table that were left out, and may be named all the same.
    pub fn left_out(&self, table: &str) -> impl Iterator<Item = &'d str> {
        self.damage.left_out(table)
    }

    /// Whether there are enough to tell.
    pub fn are_many(&self) -> bool {
        self.found.len() >= SceneError::MOST
    }

    pub fn into_found(self) -> Vec<SceneError> {
        self.found
    }
}
