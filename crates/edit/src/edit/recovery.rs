//! Keeps unsaved changes in a file in case the program ends unexpectedly.
use std::{
    io,
    path::{Path as FilePath, PathBuf, absolute},
};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{
    Document,
    kept_path::{of_json, to_json},
};
use noisefall_base::file::{WriteError, read_text, replace};
use noisefall_scene::scene::{self, Camera, RenderSettings, SceneError, describe};

/// The start of the first line of a recovery file. The path of the scene file follows as a JSON string, or `{"from": …}` with the file of
/// another program. Then follows the text of the scene.
const FIRST_LINE: &str = "# Unsaved changes of the scene ";
/// The first line for a scene without a file.
const WITHOUT_FILE: &str = "# Unsaved changes of a scene without a file";
/// The start of the second line, which may be missing. The view of the window follows as JSON.
const VIEW_LINE: &str = "# Its view ";

/// The view of a window on a scene. It is no part of the scene until it is saved with it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowView {
    /// The camera.
    pub camera: Camera,
    /// The settings of the render.
    pub settings: RenderSettings,
    /// The exposure in stops.
    pub exposure: f32,
}

/// Most bytes of a recovery file: a scene, and the lines before it.
const LONGEST: u64 = scene::LARGEST_FILE + (1 << 20);

/// A scene with changes that are not saved.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovery {
    /// The scene file, with an absolute path; absent if the scene had none.
    pub path: Option<PathBuf>,
    /// The file of another program that the scene was read from, with an absolute path, if the scene had no file of its own.
    pub origin: Option<PathBuf>,
    /// The view of the window, if it is known.
    pub view: Option<Box<WindowView>>,
    /// The text of the scene.
    pub text: String,
}

impl Recovery {
    /// The document as it is now, and the view of it.
    pub fn of(document: &Document, view: Option<WindowView>) -> Recovery {
        let absolute = |path: &FilePath| absolute(path).unwrap_or_else(|_| path.to_owned());
        Recovery {
            path: document.path().map(absolute),
            origin: document.origin().map(absolute),
            view: view.map(Box::new),
            text: document.text(),
        }
    }

    /// The file that the window had open.
    pub fn file(&self) -> Option<&FilePath> {
        self.path.as_deref().or(self.origin.as_deref())
    }

    /// Writes a recovery file, whole or not at all. It is a scene file itself, with one or two lines of comment before its text.
    pub fn write(&self, file: &FilePath) -> Result<(), WriteError> {
        let first = match (&self.path, &self.origin) {
            (Some(path), _) => format!("{FIRST_LINE}{}", to_json(path)),
            (None, Some(origin)) => format!("{FIRST_LINE}{}", json!({ "from": to_json(origin) })),
            (None, None) => WITHOUT_FILE.to_owned(),
        };
        let second = self.view.as_ref().map_or_else(String::new, |view| format!("{VIEW_LINE}{}\n", json!(**view)));
        replace(file, format!("{first}\n{second}{}", self.text).as_bytes())
    }

    /// Reads a recovery file; `None` if there is none.
    pub fn read(file: &FilePath) -> io::Result<Option<Recovery>> {
        let text = match read_text(file, LONGEST) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read?,
        };
        let (first, text) = text.split_once('\n').unwrap_or((&text, ""));
        let named = first.strip_prefix(FIRST_LINE).and_then(|source| serde_json::from_str::<Value>(source).ok());
        let source = if first == WITHOUT_FILE { Some(Value::Null) } else { named };
        let wrong = || io::Error::new(io::ErrorKind::InvalidData, "it is not a recovery file");
        let source = source.ok_or_else(wrong)?;
        let [path, origin] = [&source, &source["from"]].map(of_json);
        let view = text.strip_prefix(VIEW_LINE).and_then(|after| after.split_once('\n'));
        let (view, text) = view.map_or((None, text), |(view, text)| (serde_json::from_str(view).ok(), text));
        Ok(Some(Recovery { path, origin, view, text: text.to_owned() }))
    }

    /// The document with its changes. It counts as changed.
    pub fn open(&self) -> Result<Document, SceneError> {
        let mut document = match (&self.path, &self.origin) {
            (Some(path), _) => Document::open(path, &self.text)?,
            (None, Some(origin)) => {
                let description = describe(&origin.display().to_string(), self.text.clone())?;
                Document::imported(origin, &self.text, description)
            }
            (None, None) => Document::untitled(&self.text)?,
        };
        // The present content of the file tells later whether it was changed outside.
        let on_disk = self.path.as_ref().and_then(|path| scene::read_text(path).ok());
        document.differs_from(on_disk.unwrap_or_default());
        Ok(document)
    }
}
