//! The parts of a description that could not be read. Errors that follow from these are not reported.
use noisefall_base::declare::{Path, Step};

/// The incomplete tables.
#[derive(Default)]
pub struct Damage(Vec<Path>);

impl Damage {
    /// Records that a part of the table at a path could not be read.
    pub fn left_out(&mut self, table: &Path) {
        self.0.push(table.clone());
    }

    /// Whether the table at a path, or a table in it, is incomplete.
    pub fn reaches(&self, table: &Path) -> bool {
        self.0.iter().any(|damaged| table.holds(damaged))
    }

    /// The names of the incomplete tables in a table of named tables.
    pub fn names<'s>(&'s self, table: &'s str) -> impl Iterator<Item = &'s str> {
        self.0.iter().filter_map(move |path| match &path.0[..] {
            [Step::Key(outer), Step::Key(name), ..] if outer == table => Some(name.as_str()),
            _ => None,
        })
    }
}
