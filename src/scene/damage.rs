//! What could not be read of a description: what follows from that is no news.
use crate::declare::{Path, Step};

/// The tables that something was left out of.
#[derive(Default)]
pub struct Damage(Vec<Path>);

impl Damage {
    /// Something in the table at a path could not be read.
    pub fn left_out(&mut self, table: &Path) {
        self.0.push(table.clone());
    }

    /// Whether something was left out of the table at a path, or of a table in it.
    pub fn reaches(&self, table: &Path) -> bool {
        self.0.iter().any(|damaged| table.holds(damaged))
    }

    /// The names of a table of named tables of which something was left out.
    pub fn names<'s>(&'s self, table: &'s str) -> impl Iterator<Item = &'s str> {
        self.0.iter().filter_map(move |path| match &path.0[..] {
            [Step::Key(outer), Step::Key(name), ..] if outer == table => Some(name.as_str()),
            _ => None,
        })
    }
}
