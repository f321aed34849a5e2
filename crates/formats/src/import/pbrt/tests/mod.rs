//! Small texts, and the descriptions that they become.
mod bombs;
mod cameras;
mod hostile;
mod lights;
mod materials;
mod old;
mod shapes;

use std::fs;

use crate::import::{ImportOptions, Imported, read};
use noisefall_scene::scene::SceneError;

/// A scene whose files are in a folder of its own.
struct SceneFolder(tempfile::TempDir);

impl SceneFolder {
    fn new(files: &[(&str, &str)]) -> SceneFolder {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            fs::write(folder.path().join(name), text).expect("it is written");
        }
        SceneFolder(folder)
    }

    fn read(&self) -> Result<Imported, SceneError> {
        read(&self.0.path().join("a.pbrt"), &ImportOptions::default())
    }
}

fn imported(text: &str) -> Imported {
    SceneFolder::new(&[("a.pbrt", text)]).read().unwrap_or_else(|error| panic!("{}", error.report()))
}

/// A world of a right-handed program, so that nothing is mirrored.
fn world(text: &str) -> Imported {
    imported(&format!("Scale -1 1 1\nLookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n{text}"))
}

fn error(text: &str) -> String {
    match SceneFolder::new(&[("a.pbrt", text)]).read() {
        Ok(_) => panic!("it is accepted"),
        Err(error) => error.report(),
    }
}

/// The remarks as text, apart from that about the sky of dark scenes.
fn remarks(imported: &Imported) -> Vec<String> {
    imported.remarks.lines(100).into_iter().filter(|line| !line.contains("neutral studio sky")).collect()
}
