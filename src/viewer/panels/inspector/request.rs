//! Changes that the inspector requests.
use noisefall_base::declare::{Family, OwnedValue, Path};

/// The requests of one frame.
#[derive(Debug, Default, PartialEq)]
pub struct InspectorRequests {
    pub requests: Vec<Request>,
    pub drag: Drag,
}

/// Grouping of requests: one undo takes back a whole drag.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drag {
    /// Every request stands by itself.
    #[default]
    None,
    /// More may follow.
    Going,
    /// The last drag has ended, with these requests or those before.
    Ended,
}

/// A requested change, which is not applied yet.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Set a value.
    Set { path: Path, value: OwnedValue },
    /// Give a value its default.
    Reset { path: Path },
    /// Choose another alternative of a choice, whose keys stand in the table at the path.
    Choose { path: Path, choice: &'static str, name: &'static str },
    /// Give an optional value or table, or an item of a list, its defaults.
    Insert { path: Path },
    /// Remove an optional value or table, or an item of a list.
    Remove { path: Path },
    /// Let the user choose a file for the value.
    BrowseFile { path: Path },
    /// Let the user choose an image file, make a texture of it, and set the value to its name.
    BrowseTexture { path: Path },
    /// Make a texture of this kind, and set the value to its name.
    NewTexture { path: Path, kind: &'static str },
    /// Show the parameters of the material or texture of this name.
    Show { family: Family, name: String },
}
