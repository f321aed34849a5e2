//! Editing: changes a scene step by step, and saves it.
//!
//! A [`Document`] holds a [`SceneDescription`](noisefall_scene::scene::description::SceneDescription) and the text that it was read from. An
//! [`Edit`] changes it; applying one returns its exact inverse. A [`History`] keeps the inverses. [`Document::text`] writes the scene:
//! comments, order and number formats stay, and only what changed is changed.
//!
//! A path leads through the tables of a scene file: `camera.fov`, `objects.3.shape.sphere.radius`, `materials.gold.conductor.roughness`,
//! `objects.0.transform.1.translate`. It is built by [`Path::key`](noisefall_base::declare::Path::key) and
//! [`Path::item`](noisefall_base::declare::Path::item), as visitors of declarations build it. `materials.white` and `objects.3` are paths too.
//!
//! | to | apply |
//! |---|---|
//! | set a value; adds absent tables on its path | [`Edit::Set`] |
//! | give an optional value or table its default (`objects.3.emission`) | [`Edit::Insert`] without content; [`Document::insert`] with the texture that it needs |
//! | remove an optional value, an object, a material, an item of a list | [`Edit::Remove`] |
//! | add an object, a light, a material, a texture, a transform | [`Edit::Insert`]; [`Document::add_shape`] and [`Document::add_punctual_light`] place one |
//! | add a mesh file; make an image the environment | [`Document::add_mesh`]; [`Document::set_sky`] |
//! | duplicate an object, a light, a material, a texture | [`Document::duplicate`] |
//! | change a kind: `path` is the table with the key of the kind, `choice` the [`Choice::what`](noisefall_base::declare::Choice::what) | [`Edit::Choose`] |
//! | the same, with the parameters that depend on it, such as the camera's angle | [`Document::change_kind`] |
//! | rename a material or texture, and all references to it | [`Edit::Rename`] |
//! | rename an object or a light | [`Edit::Set`] of its `name` |
//! | assign a material; `None` is black | [`Document::assign`] |
//! | reorder a list | [`Edit::Move`] |
//! | give the scene the camera and the settings of a view | [`Document::use_view`] |
//! | do several at once | [`Edit::All`] |
//!
//! | file | holds |
//! |---|---|
//! | `document.rs`, `content.rs` | the document and its content |
//! | `change.rs`, `title.rs`, `apply.rs` | the edits; in words; applying them |
//! | `set.rs`, `put.rs`, `take.rs`, `choose.rs` | the visitors that change a description |
//! | `check.rs`, `references.rs` | the reader's checks; names in use |
//! | `history.rs` | undo and redo |
//! | the crate `writer` | snapshots of a description, the part of the file that each object comes from, and the text of the file |
//! | `kind.rs`, `meaning.rs` | changes of kind that change other parameters too; what materials keep under another key |
//! | `names.rs`, `add.rs`, `pose.rs`, `drop_to_floor.rs` | free names; new shapes and lights; moving objects; dropping them to the floor |
//! | `import.rs` | meshes and skies from files |
//! | `view.rs` | the camera and the settings of a view |
//! | `outside.rs` | files that were changed outside |
//! | `trial.rs` | random scenes, written and read |
//! | `recovery.rs`, `templates/` | recovery after a crash; scenes to start from |
mod add;
mod apply;
mod change;
mod check;
mod choose;
mod colour;
mod content;
mod defaults;
mod document;
mod drop_to_floor;
mod history;
mod import;
mod kept_path;
mod kind;
mod meaning;
mod names;
mod outside;
mod pose;
mod put;
mod recovery;
mod references;
mod set;
mod take;
mod templates;
#[cfg(test)]
mod tests;
mod title;
mod trial;
mod view;

use noisefall_writer::{origin, tree, walk};

pub use self::trial::write_and_read;
pub use self::{
    change::Edit,
    content::Content,
    document::{Document, Version, Written},
    history::{Gesture, History},
    outside::Outside,
    recovery::{Recovery, WindowView},
    templates::{TEMPLATES, Template},
};
#[doc(inline)]
pub use noisefall_base::declare::{OwnedValue, Path};
#[doc(inline)]
pub use noisefall_scene::shape::Placement;
pub use noisefall_writer::{new_text, origin::Origin, tree::Tree};
