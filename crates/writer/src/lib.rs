//! The text of scene files: of new ones, and of files that are updated. An update changes only the values that differ, and keeps comments,
//! order and number formats.
//!
//! | file | holds |
//! |---|---|
//! | `tree.rs`, `walk.rs` | a snapshot of a part of a description, and the way to it |
//! | `origin.rs` | the parts of the file from which those of a document come |
//! | `outline.rs` | the required and the optional content of a file for a description |
//! | `tables.rs`, `lists.rs`, `named.rs` | update a table, a list or a table of named tables in the file |
//! | `objects.rs` | the same for the objects, in any order |
//! | `values.rs` | values in the style of a person |
//! | `update.rs` | the text of a file that is updated |
//! | `renamed.rs` | rewrites former names |
//! | `new_text.rs` | the text of a new file |
mod lists;
mod named;
mod new_text;
mod objects;
pub mod origin;
mod outline;
mod renamed;
mod tables;
pub mod tree;
mod update;
mod values;
pub mod walk;

pub use self::{new_text::new_text, renamed::renamed, update::updated};
