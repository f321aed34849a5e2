//! What can be done to a scene.
use super::{content::Content, origin::Origin, tree::Tree};
use crate::declare::{OwnedValue, Path, Step};

/// A change of a scene. See the [table](super) of what each is for.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Sets a value. Optional values and tables on the way to it appear.
    Set {
        /// The value.
        path: Path,
        /// What it becomes; of the type of the value.
        value: OwnedValue,
    },
    /// Adds what is not there: an optional value or table, a table with a new name, or an item that comes to stand at its place in a
    /// list.
    Insert {
        /// What is added.
        path: Path,
        /// Its content; absent: its defaults.
        tree: Option<Tree>,
        /// What of the file it stands for, if it has been there before.
        origin: Option<Origin>,
    },
    /// Removes an optional value or table, a table with a name, or an item of a list.
    Remove {
        /// What is removed.
        path: Path,
    },
    /// Replaces all that is at a path.
    Replace {
        /// A table, a value, a list or an item.
        path: Path,
        /// What it becomes.
        tree: Tree,
    },
    /// Chooses another alternative. Parameters of the same key and type stay as they are.
    Choose {
        /// The table with the keys of the alternatives, such as `objects.3.shape` or `materials.gold`.
        path: Path,
        /// What is chosen, as [`Choice::what`](crate::declare::Choice::what) says it: "shape", "material", "roughness".
        choice: String,
        /// The name of the alternative.
        name: String,
    },
    /// Gives a material or a texture another name. What names it follows.
    Rename {
        /// The table with the name, such as `materials.gold`.
        path: Path,
        /// The new name.
        to: String,
    },
    /// Moves an item within its list.
    Move {
        /// The item.
        path: Path,
        /// Its place afterwards.
        to: usize,
    },
    /// Several edits in their order. All are done or none is.
    All(Vec<Edit>),
    /// Takes all of a scene from a file that was changed outside: see [`Outside`](super::Outside).
    Reload(Box<Content>),
}

static EVERYTHING: Path = Path(Vec::new());

impl Edit {
    /// The edit that sets a value.
    pub fn set(path: Path, value: OwnedValue) -> Edit {
        Edit::Set { path, value }
    }

    /// The edit that adds something with its defaults.
    pub fn insert(path: Path) -> Edit {
        Edit::Insert { path, tree: None, origin: None }
    }

    /// The edit that adds something with its content.
    pub fn insert_tree(path: Path, tree: Tree) -> Edit {
        Edit::Insert { path, tree: Some(tree), origin: None }
    }

    /// The edit that removes something.
    pub fn remove(path: Path) -> Edit {
        Edit::Remove { path }
    }

    /// The edit that chooses another alternative.
    pub fn choose(path: Path, choice: impl Into<String>, name: impl Into<String>) -> Edit {
        Edit::Choose { path, choice: choice.into(), name: name.into() }
    }

    /// What the edit changes; what it makes follow is not among it.
    pub fn paths(&self) -> Vec<&Path> {
        match self {
            Edit::Set { path, .. }
            | Edit::Insert { path, .. }
            | Edit::Remove { path }
            | Edit::Replace { path, .. }
            | Edit::Choose { path, .. }
            | Edit::Rename { path, .. }
            | Edit::Move { path, .. } => vec![path],
            Edit::All(edits) => edits.iter().flat_map(Edit::paths).collect(),
            Edit::Reload(_) => vec![&EVERYTHING],
        }
    }

    /// What the edit does, for a menu: "Set roughness".
    pub fn title(&self) -> String {
        let last = |path: &Path| match path.0.last() {
            Some(Step::Key(key)) => key.replace('_', " "),
            Some(Step::Item(_)) => match path.0.first() {
                Some(Step::Key(key)) if key == "objects" && path.0.len() == 2 => "object".to_owned(),
                _ => path
                    .0
                    .iter()
                    .rev()
                    .find_map(|step| if let Step::Key(key) = step { Some(key.as_str()) } else { None })
                    .unwrap_or("item")
                    .to_owned(),
            },
            None => "scene".to_owned(),
        };
        match self {
            Edit::Set { path, .. } | Edit::Replace { path, .. } => format!("Set {}", last(path)),
            Edit::Insert { path, .. } => format!("Add {}", last(path)),
            Edit::Remove { path } => format!("Delete {}", last(path)),
            Edit::Choose { choice, name, .. } => format!("Change {choice} to {}", name.replace('_', " ")),
            Edit::Rename { path, to } => format!("Rename {} to {to}", last(path)),
            Edit::Move { path, .. } => format!("Move {}", last(path)),
            Edit::All(edits) => edits.first().map_or_else(|| "Edit".to_owned(), Edit::title),
            Edit::Reload(_) => "Reload".to_owned(),
        }
    }
}
