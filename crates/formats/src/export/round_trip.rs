//! Scenes of tests, written and read again.
use std::{
    fs,
    path::{Path, PathBuf},
};

use glam::DVec3;

use super::{ExportSource, prepare};
use crate::import::{ImportOptions, Imported, read};
use noisefall_base::declare::{Assets, check};
use noisefall_scene::scene::{describe, description::SceneDescription};

/// A scene that was written and read again, with the remarks about the writing.
pub struct RoundTrip {
    pub imported: Imported,
    pub remarks: Vec<String>,
    /// The scene file.
    pub content: Vec<u8>,
    /// The files that were written.
    pub folder: tempfile::TempDir,
}

/// Writes a scene to a file with this name, and reads it.
pub fn round_trip(description: &SceneDescription, assets: &Assets, folder: &Path, name: &str) -> RoundTrip {
    let out = tempfile::tempdir().expect("a folder");
    let path = out.path().join(name);
    let prepared = prepare(ExportSource { description, assets, folder, allow_outside: false, text: None }, &path)
        .expect("it can be written");
    prepared.write().expect("it is written");
    let imported = read(&path, &ImportOptions::default()).unwrap_or_else(|error| panic!("{}", error.report()));
    let problems = check(&mut imported.description.clone());
    assert!(problems.is_empty(), "{problems:?}");
    let remarks = prepared.remarks.iter().map(|counted| counted.remark.found.clone()).collect();
    RoundTrip { imported, remarks, content: prepared.content().to_vec(), folder: out }
}

/// The folder of the scenes that are shipped.
pub fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// A scene that is shipped.
pub fn shipped(name: &str) -> SceneDescription {
    let text = fs::read_to_string(scenes().join(format!("{name}.toml"))).expect("it is shipped");
    describe(name, text).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// The names of all scenes that are shipped, without one of a million triangles, which takes a second or two without optimisation.
pub fn names() -> Vec<String> {
    let entries = fs::read_dir(scenes()).expect("they are shipped").map(|entry| entry.expect("an entry").path());
    let scenes = entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let mut names: Vec<String> = scenes.map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    names.retain(|name| name != "million_triangles");
    names.sort();
    names
}

/// Whether two points are the same up to rounding.
pub fn near(a: DVec3, b: DVec3) -> bool {
    a.distance(b) <= 1e-7 * (1.0 + a.length().max(b.length()))
}
