//! A visitor that follows a path to one part of a description.
use noisefall_base::declare::{Path, Step};

/// The methods of a visitor that keep the walk in its field `walk` at the table that is visited, and pass over tables beside the path.
#[macro_export]
macro_rules! follows_walk {
    () => {
        fn enter(&mut self, parameter: &Parameter, _: noisefall_base::declare::Form) {
            self.walk.enter(parameter.key);
        }

        fn leave(&mut self) {
            self.walk.leave();
        }

        fn skips(&self) -> bool {
            self.walk.is_beside()
        }

        fn item(&mut self, parameter: &Parameter, index: usize) {
            self.walk.item(parameter.key, index);
        }

        fn named(&mut self, parameter: &Parameter, name: &str) {
            self.walk.named(parameter.key, name);
        }
    };
}
pub use follows_walk;

/// Position of a visitor relative to a target path.
pub struct Walk<'p> {
    target: &'p [Step],
    /// Number of steps of the target that lead to the current table: all of them within the target, `None` off the path.
    matched: Option<usize>,
    /// Those numbers for the enclosing tables, with the lengths of their paths.
    outer: Vec<(Option<usize>, usize)>,
    /// The path of the current table; not kept off the path.
    path: Path,
}

impl<'p> Walk<'p> {
    /// Starts at the top of a description.
    pub fn to(target: &'p Path) -> Walk<'p> {
        Walk { target: &target.0, matched: Some(0), outer: Vec::new(), path: Path::default() }
    }

    /// The remaining steps on the way to the target.
    fn left(&self) -> &'p [Step] {
        self.matched.map_or(&[], |matched| &self.target[matched..])
    }

    fn enter_by(&mut self, steps: &[Step]) {
        self.outer.push((self.matched, self.path.0.len()));
        let left = self.left();
        self.matched = match self.matched {
            Some(matched) if left.starts_with(steps) => Some(matched + steps.len()),
            // Within the target, or an item of the list that is the target.
            Some(_) if steps.starts_with(left) => Some(self.target.len()),
            _ => None,
        };
        if self.matched.is_some() {
            self.path.0.extend(steps.iter().cloned());
        }
    }

    /// Enters the table at a key.
    pub fn enter(&mut self, key: &str) {
        self.enter_by(&[Step::Key(key.to_owned())]);
    }

    /// Enters an item of the list at a key.
    pub fn item(&mut self, key: &str, index: usize) {
        self.enter_by(&[Step::Key(key.to_owned()), Step::Item(index)]);
    }

    /// Enters one of the named tables at a key.
    pub fn named(&mut self, key: &str, name: &str) {
        self.enter_by(&[Step::Key(key.to_owned()), Step::Key(name.to_owned())]);
    }

    /// Leaves a table.
    pub fn leave(&mut self) {
        if let Some((matched, length)) = self.outer.pop() {
            self.matched = matched;
            self.path.0.truncate(length);
        }
    }

    /// Whether the current table is not on the path.
    pub fn is_beside(&self) -> bool {
        self.matched.is_none()
    }

    /// Whether the current table is the target or lies within it.
    pub fn is_within(&self) -> bool {
        self.matched == Some(self.target.len())
    }

    /// Whether the target is the content of a key of the current table.
    pub fn is_at(&self, key: &str) -> bool {
        matches!(self.left(), [Step::Key(last)] if last == key)
    }

    /// Whether the content of a key of the current table is the target or belongs to it.
    pub fn takes(&self, key: &str) -> bool {
        self.is_within() || self.is_at(key)
    }

    /// Whether the path leads through a key of the current table, or ends there.
    pub fn leads_through(&self, key: &str) -> bool {
        matches!(self.left(), [Step::Key(next), ..] if next == key)
    }

    /// The target's index in the list at a key.
    pub fn item_at(&self, key: &str) -> Option<usize> {
        match self.left() {
            [Step::Key(list), Step::Item(place)] if list == key => Some(*place),
            _ => None,
        }
    }

    /// The target's name in the table of named tables at a key.
    pub fn name_at(&self, key: &str) -> Option<&'p str> {
        match self.left() {
            [Step::Key(map), Step::Key(name)] if map == key => Some(name),
            _ => None,
        }
    }

    /// The path of a key of the current table.
    pub fn path_of(&self, key: &str) -> Path {
        self.path.key(key)
    }
}
