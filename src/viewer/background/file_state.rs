//! The file of a scene: saves to it, compares it with the document, and finds the files that a scene names.
use std::path::{Path, PathBuf};

use noisefall_base::declare::{Assets, for_each_file};
use noisefall_edit::edit::{Document, Outside, Version, Written};
use noisefall_formats::export::{self, ExportSource};
use noisefall_scene::scene::{description::SceneDescription, load, read_text};

/// The file of a document as it is now.
pub enum FileState {
    /// It has the text that the document knows, or the document has no file.
    Known,
    /// Another program removed it.
    Missing,
    /// Another program changed it.
    Changed(Box<Outside>),
    /// It is not a scene that can be read.
    Broken(BrokenFile),
}

/// A file that cannot be read as a scene.
pub struct BrokenFile {
    /// Its text; absent if it is not text.
    pub text: Option<String>,
    /// The error and its place.
    pub report: String,
}

/// The result of saving a scene.
pub enum SaveResult {
    Written(Written),
    /// A scene of another program was written with its meshes and textures. The scene that is open still has them in memory.
    Exported(Version),
    /// The file was changed by another program, and stays as it is.
    Differs(FileState),
    Failed(String),
}

/// Compares a document with its file.
pub fn compare(document: &Document) -> FileState {
    let Some(path) = document.path() else { return FileState::Known };
    let text = match read_text(path) {
        Ok(text) => text,
        Err(_) if !path.exists() => return if document.on_disk().is_empty() { FileState::Known } else { FileState::Missing },
        Err(error) => return FileState::Broken(BrokenFile { text: None, report: error.report() }),
    };
    match document.compare_outside(&text) {
        Ok(None) => FileState::Known,
        Ok(Some(outside)) => FileState::Changed(Box::new(outside)),
        Err(error) => {
            // The compiler knows the lines of names, too.
            let report = load(path).err().unwrap_or(error).report();
            FileState::Broken(BrokenFile { text: Some(text), report })
        }
    }
}

/// Saves a document that was opened from a file. `assets` are the files of the scene that are in memory. A file that another program has changed is replaced only if `replaces` says so.
pub fn save(document: &Document, opened: Option<&Path>, assets: &Assets, path: &Path, replaces: bool) -> SaveResult {
    // A scene in the program has its files in memory too.
    let in_memory = opened.filter(|_| document.path().is_none() && !assets.is_empty());
    if let Some(origin) = document.origin().or(in_memory) {
        let folder = origin.parent().unwrap_or(Path::new(""));
        // The reader was allowed to read what the scene named, and the user has chosen all else.
        let exported = export::write(
            ExportSource { description: document.description(), assets, folder, allow_outside: true, text: None },
            path,
        );
        return exported.map_or_else(|error| SaveResult::Failed(error.to_string()), |_| SaveResult::Exported(document.version()));
    }
    let folder = |path: &Path| path.parent().and_then(|folder| folder.canonicalize().ok());
    if let Some(opened) = opened.filter(|opened| folder(opened) != folder(path))
        && named_files(document.description()).iter().any(|file| file.is_relative())
    {
        let folder = opened.parent().unwrap_or(Path::new("")).display();
        return SaveResult::Failed(format!("the scene uses relative file paths. Save it in their folder, {folder}"));
    }
    if !replaces && document.path() == Some(path) {
        match compare(document) {
            FileState::Known | FileState::Missing => {}
            state => return SaveResult::Differs(state),
        }
    }
    document.write(path).map_or_else(|error| SaveResult::Failed(error.to_string()), SaveResult::Written)
}

/// The files that a scene names.
pub fn named_files(description: &SceneDescription) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for_each_file(&mut description.clone(), &mut |path| files.push(PathBuf::from(&*path)));
    files
}

#[cfg(test)]
mod tests {
    use noisefall_base::declare::{OwnedValue, Path as ParameterPath};
    use noisefall_edit::edit::Edit;
    use noisefall_scene::scene::{BUILT_IN, describe};

    use super::*;

    #[test]
    fn a_scene_of_another_program_is_written_with_its_files_and_keeps_its_document() {
        let folder = tempfile::tempdir().expect("a folder");
        let (opened, path) = (folder.path().join("room.gltf"), folder.path().join("room.toml"));
        let document = Document::imported(&opened, BUILT_IN, describe("room", BUILT_IN.to_owned()).expect("it is a scene"));
        let done = save(&document, Some(&opened), &Assets::default(), &path, false);
        assert!(matches!(done, SaveResult::Exported(version) if version == document.version()));
        assert!(path.is_file() && document.path().is_none());
        let refused = save(&document, Some(&opened), &Assets::default(), &folder.path().join("no/room.toml"), false);
        assert!(matches!(refused, SaveResult::Failed(error) if error.contains("there is no folder")));
    }

    #[test]
    fn a_scene_in_the_program_is_written_with_its_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("sky.toml");
        let scene = load(Path::new("sky_lit")).expect("it is in the program");
        let document = Document::untitled(&scene.source).expect("a scene");
        let done = save(&document, Some(Path::new("sky_lit")), &scene.assets, &path, false);
        assert!(matches!(done, SaveResult::Exported(version) if version == document.version()));
        let again = load(&path).expect("its files are there");
        assert!(again.assets.is_empty() && again.objects.len() == scene.objects.len());
    }

    #[test]
    fn a_file_that_was_changed_outside_is_replaced_only_on_demand() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("mine.toml");
        std::fs::write(&path, BUILT_IN).expect("it is written");
        let mut document = Document::open(&path, BUILT_IN).expect("it is a scene");
        let narrower = Edit::set(ParameterPath::of("camera.fov"), OwnedValue::Number(20.0));
        document.apply(&narrower).expect("it is in range");
        for (text, is_scene) in [(format!("{BUILT_IN}\n# from outside\n"), true), ("format = 1\ncamera = 3\n".to_owned(), false)]
        {
            std::fs::write(&path, &text).expect("it is written");
            let SaveResult::Differs(state) = save(&document, Some(&path), &Assets::default(), &path, false) else {
                panic!("it is replaced")
            };
            match state {
                FileState::Changed(outside) => assert!(is_scene && !outside.conflicts),
                FileState::Broken(broken) => assert!(!is_scene && broken.text.as_ref() == Some(&text)),
                FileState::Known | FileState::Missing => panic!("it is there, and another one"),
            }
            assert_eq!(std::fs::read_to_string(&path).expect("it is there"), text);
        }
        let SaveResult::Written(written) = save(&document, Some(&path), &Assets::default(), &path, true) else {
            panic!("it is refused")
        };
        document.note_written(written);
        assert!(!document.has_changes() && matches!(compare(&document), FileState::Known));
        std::fs::remove_file(&path).expect("it is there");
        assert!(matches!(compare(&document), FileState::Missing));
        document.keep_own("");
        assert!(document.has_changes() && matches!(compare(&document), FileState::Known));
        assert!(
            matches!(save(&document, Some(&path), &Assets::default(), &path, false), SaveResult::Written(_)) && path.is_file()
        );
    }
}
