//! The content of a document.
use std::sync::Arc;

use super::{check::check, origin::Origins, tree::Tree};
use noisefall_base::declare::{Path, Problem};
use noisefall_scene::scene::description::SceneDescription;
use noisefall_writer::updated;

/// A scene, and the parts of a file that it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Content {
    pub(super) description: SceneDescription,
    pub(super) base: Arc<Base>,
    pub(super) origins: Origins,
}

/// A file as it was read.
#[derive(Debug, PartialEq)]
pub struct Base {
    pub text: String,
    pub description: SceneDescription,
}

impl Content {
    /// A file as it was read.
    pub fn new(text: String, description: SceneDescription) -> Content {
        let origins = Origins::of(&description);
        Content { description: description.clone(), base: Arc::new(Base { text, description }), origins }
    }

    /// The text of the scene file.
    pub fn text(&self) -> String {
        updated(&self.base.text, &self.base.description, &self.description, &self.origins)
    }

    /// All names that are not defined, and values out of range.
    pub fn problem(&mut self) -> Option<Problem> {
        check(&mut self.description, &Path::default())
    }

    /// Returns the tree of values at a path.
    pub fn tree(&mut self, path: &Path) -> Option<Tree> {
        Tree::at(&mut self.description, path)
    }
}

impl Base {
    /// Whether a description equals that of the file, bit for bit.
    pub fn is(&self, description: &SceneDescription) -> bool {
        Tree::of(&mut self.description.clone()).is_identical(&Tree::of(&mut description.clone()))
    }
}
