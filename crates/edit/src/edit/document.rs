//! A scene that is being edited.
use std::path::{Path as FilePath, PathBuf};

use super::{change::Edit, content::Content, tree::Tree};
use noisefall_base::{
    declare::{OwnedValue, Path, Problem},
    file::{WriteError, replace},
};
use noisefall_scene::scene::{SceneError, describe, description::SceneDescription};
use noisefall_writer::renamed;

/// A state of a document: equal versions of one document have the same description and text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Version(u64);

/// A scene that is being edited: its description, the text that it was read from, and its folder. A clone is a snapshot that another
/// thread can write or compare.
#[derive(Clone, Debug)]
pub struct Document {
    pub(super) content: Content,
    /// The scene file; absent while the scene has none.
    path: Option<PathBuf>,
    /// The file of another program that the scene was read from, while the scene has no file of its own.
    origin: Option<PathBuf>,
    /// The text of the file as it was last read or written.
    on_disk: String,
    version: Version,
    saved: Option<Version>,
    /// Never used before.
    next: u64,
}

/// A version of a document that was written to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    path: PathBuf,
    text: String,
    version: Version,
}

impl Document {
    /// A scene file that was read. Fails if the reader refuses the text, or if it uses names that are not defined; the files that it
    /// names are not read.
    pub fn open(path: impl AsRef<FilePath>, text: &str) -> Result<Document, SceneError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let content = read(&name, text)?;
        // Edits use the current names.
        let content = renamed(text).map_or(Ok(content), |text| read(&name, &text))?;
        let first = Version(0);
        Ok(Document {
            content,
            path: Some(path.to_owned()),
            origin: None,
            on_disk: text.to_owned(),
            version: first,
            saved: Some(first),
            next: 1,
        })
    }

    /// A scene without a file, such as one of a template. It counts as changed from the first edit on.
    pub fn untitled(text: &str) -> Result<Document, SceneError> {
        let document = Document::open("", text)?;
        Ok(Document { path: None, ..document })
    }

    /// A scene that was read from the file of another program. `text` is a scene file with its content, but the scene has no file of its
    /// own yet.
    pub fn imported(origin: impl AsRef<FilePath>, text: &str, description: SceneDescription) -> Document {
        let first = Version(0);
        Document {
            content: Content::new(text.to_owned(), description),
            path: None,
            origin: Some(origin.as_ref().to_owned()),
            on_disk: String::new(),
            version: first,
            saved: Some(first),
            next: 1,
        }
    }

    /// The scene as it is now.
    pub fn description(&self) -> &SceneDescription {
        &self.content.description
    }

    /// The scene file, if there is one.
    pub fn path(&self) -> Option<&FilePath> {
        self.path.as_deref()
    }

    /// The file of another program that the scene was read from, while it has no file of its own.
    pub fn origin(&self) -> Option<&FilePath> {
        self.origin.as_deref()
    }

    /// The folder that paths in the scene are relative to; empty while the scene has no file.
    pub fn folder(&self) -> &FilePath {
        self.path.as_deref().and_then(FilePath::parent).unwrap_or(FilePath::new(""))
    }

    /// The state that the document is in.
    pub fn version(&self) -> Version {
        self.version
    }

    /// Whether the document differs from its file.
    pub fn has_changes(&self) -> bool {
        self.saved != Some(self.version)
    }

    /// Applies an edit and returns its exact inverse. An edit that makes the scene invalid fails with the message of the reader of
    /// scene files, and changes nothing.
    pub fn apply(&mut self, edit: &Edit) -> Result<Edit, Problem> {
        let inverse = self.content.apply(edit)?;
        self.version = Version(self.next);
        self.next += 1;
        Ok(inverse)
    }

    /// Applies an edit that leads back to a known version.
    pub(super) fn return_to(&mut self, version: Version, edit: &Edit) -> Result<Edit, Problem> {
        let inverse = self.content.perform(edit)?;
        self.version = version;
        Ok(inverse)
    }

    /// The text of the scene file: the text that was read, with the changes.
    pub fn text(&self) -> String {
        self.content.text()
    }

    /// Writes the scene to its file, or to another one, which becomes its file. The file is replaced whole or not at all.
    pub fn save(&mut self, path: impl AsRef<FilePath>) -> Result<(), WriteError> {
        let written = self.write(path)?;
        self.note_written(written);
        Ok(())
    }

    /// Writes the scene to a file, for [`Document::note_written`]. The file is replaced whole or not at all.
    pub fn write(&self, path: impl AsRef<FilePath>) -> Result<Written, WriteError> {
        let (path, text) = (path.as_ref(), self.text());
        replace(path, text.as_bytes())?;
        Ok(Written { path: path.to_owned(), text, version: self.version })
    }

    /// Records that this version of the document was written. The file becomes that of the document, which counts as changed if it has
    /// another version by now.
    pub fn note_written(&mut self, written: Written) {
        (self.path, self.origin) = (Some(written.path), None);
        (self.on_disk, self.saved) = (written.text, Some(written.version));
    }

    /// Records that the file has this text, which is that of the document.
    pub(super) fn saved(&mut self, text: String) {
        self.on_disk = text;
        self.saved = Some(self.version);
    }

    /// Records that the file has another text with the same values.
    pub(super) fn has_text(&mut self, on_disk: String) {
        self.on_disk = on_disk;
    }

    /// The text of the file as it was last read or written.
    pub fn on_disk(&self) -> &str {
        &self.on_disk
    }

    /// Records that the text of the file differs from that of every version of the document.
    pub(super) fn differs_from(&mut self, on_disk: String) {
        self.on_disk = on_disk;
        self.saved = None;
    }

    /// The content at a path, if there is any.
    pub fn tree(&mut self, path: &Path) -> Option<Tree> {
        self.content.tree(path)
    }

    /// The value at a path, if there is one.
    pub fn value(&mut self, path: &Path) -> Option<OwnedValue> {
        self.tree(path)?.value().cloned()
    }
}

/// The description in a text, with all names defined.
pub fn read(name: &str, text: &str) -> Result<Content, SceneError> {
    let mut content = Content::new(text.to_owned(), describe(name, text.to_owned())?);
    match content.problem() {
        None => Ok(content),
        Some(problem) => {
            let message = format!("`{}`: {}", problem.path, problem.message);
            Err(SceneError::of_file(FilePath::new(name), message, problem.label))
        }
    }
}
