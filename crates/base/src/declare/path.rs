//! The path of a parameter in a description.
use std::fmt;

use crate::quote;

/// A step into a table or a list.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// A key of a table.
    Key(String),
    /// A place in a list, from 0.
    Item(usize),
}

/// The steps from the top of a description to one of its values.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Path(pub Vec<Step>);

impl Path {
    /// Keys separated by points; numbers are places in lists.
    pub fn of(text: &str) -> Path {
        let step = |part: &str| part.parse().map_or_else(|_| Step::Key(part.to_owned()), Step::Item);
        Path(text.split('.').filter(|part| !part.is_empty()).map(step).collect())
    }

    /// Whether `inner` is this path or starts with it.
    pub fn holds(&self, inner: &Path) -> bool {
        inner.0.starts_with(&self.0)
    }

    /// This path, continued by another.
    #[must_use]
    pub fn join(&self, rest: &Path) -> Path {
        Path(self.0.iter().chain(&rest.0).cloned().collect())
    }

    /// This path, continued by a key.
    #[must_use]
    pub fn key(&self, key: &str) -> Path {
        self.join(&Path(vec![Step::Key(key.to_owned())]))
    }

    /// This path, continued by a place in a list.
    #[must_use]
    pub fn item(&self, index: usize) -> Path {
        self.join(&Path(vec![Step::Item(index)]))
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(key) if place == 0 => write!(f, "{}", quote::piece(key))?,
                Step::Key(key) => write!(f, ".{}", quote::piece(key))?,
                Step::Item(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
