//! The edits of a scene.
use super::{content::Content, origin::Origin, tree::Tree};
use noisefall_base::declare::{OwnedValue, Path};

/// A change of a scene. The [table](super) lists their uses.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Sets a value. Adds optional tables on the path that are absent.
    Set {
        /// The value.
        path: Path,
        /// The new value, of the same type.
        value: OwnedValue,
    },
    /// Adds an optional value or table, a table with a new name, or an item at a place in a list.
    Insert {
        /// Path of the new part.
        path: Path,
        /// Its content; `None` gives it its defaults.
        tree: Option<Tree>,
        /// The part of the file that it was read from, if any.
        origin: Option<Origin>,
    },
    /// Removes an optional value or table, a table with a name, or an item of a list.
    Remove {
        /// Path of the removed part.
        path: Path,
    },
    /// Replaces everything at a path.
    Replace {
        /// A table, a value, a list or an item.
        path: Path,
        /// The new content.
        tree: Tree,
    },
    /// Chooses another alternative. Parameters of the same key and type stay as they are.
    Choose {
        /// The table with the keys of the alternatives, such as `objects.3.shape` or `materials.gold`.
        path: Path,
        /// Name of the choice, as in [`Choice::what`](noisefall_base::declare::Choice::what): "shape", "material", "roughness".
        choice: String,
        /// The name of the alternative.
        name: String,
    },
    /// Renames a material or a texture, and every reference to it.
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
        /// Its index afterwards.
        to: usize,
    },
    /// Applies several edits in order: all of them, or none if one fails.
    All(Vec<Edit>),
    /// Reloads the whole scene from a file that another program changed: see [`Outside`](super::Outside).
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

    /// The paths that the edit changes, without the references that follow a renaming.
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
}
