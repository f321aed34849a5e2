//! Whole scenes, written and read again.
mod looks;
mod remarks;
mod shapes;

use std::fs;

use serde_json::Value;

use crate::export::{
    ExportSource, prepare,
    round_trip::{self as scene_files, RoundTrip, names, near, scenes, shipped},
};
use noisefall_base::declare::Assets;
use noisefall_scene::scene::{
    Projection,
    description::{CameraDescription, SceneDescription},
};

fn round_trip(description: &SceneDescription, assets: &Assets) -> RoundTrip {
    scene_files::round_trip(description, assets, &scenes(), "scene.gltf")
}

fn json(content: &[u8]) -> Value {
    serde_json::from_slice(content).expect("it is JSON")
}

#[test]
fn every_shipped_scene_can_be_written_and_read() {
    for name in names() {
        let ours = shipped(&name);
        let [text, binary] =
            ["scene.gltf", "scene.glb"].map(|file| scene_files::round_trip(&ours, &Assets::default(), &scenes(), file));
        assert_eq!(text.imported.description.objects, binary.imported.description.objects, "{name}");
        assert_eq!(text.imported.description.materials.len(), binary.imported.description.materials.len(), "{name}");
        assert_eq!(text.remarks, binary.remarks, "{name}");
        assert_eq!(text.imported.description.punctual_lights.len(), ours.punctual_lights.len(), "{name}");
        let view = |camera: &CameraDescription| (camera.look_at - camera.eye).normalize();
        let (a, b) = (&ours.camera, &text.imported.description.camera);
        assert!(near(a.eye, b.eye) && near(view(a), view(b)), "{name}");
        assert!((a.fov.unwrap_or(0.0) - b.fov.unwrap_or(0.0)).abs() < 1e-9, "{name}");
    }
}

#[test]
fn files_are_the_same_each_time_and_have_no_empty_lists() {
    let description = shipped("principled");
    for name in ["scene.gltf", "scene.glb"] {
        let folder = tempfile::tempdir().expect("a folder");
        let write = || {
            let assets = Assets::default();
            let source =
                ExportSource { description: &description, assets: &assets, folder: &scenes(), allow_outside: false, text: None };
            let done = prepare(source, &folder.path().join(name)).expect("it can be written").write().expect("it is written");
            (fs::read(folder.path().join(name)).expect("it is there"), done)
        };
        let (first, done) = write();
        assert_eq!((&first, &done), (&write().0, &done));
        assert_eq!(done.folder.is_some(), name.ends_with("gltf"), "a binary file holds all");
        if name.ends_with("gltf") {
            let document = json(&first);
            let lists = document.as_object().expect("a table").values().filter_map(Value::as_array);
            assert!(lists.into_iter().all(|list| !list.is_empty()));
            assert_eq!(document["asset"]["version"], "2.0");
        }
    }
}

#[test]
fn names_with_other_characters_find_their_files() {
    let description = shipped("cornell_box");
    let trip = scene_files::round_trip(&description, &Assets::default(), &scenes(), "zimmer 100 % grün #1.gltf");
    assert_eq!(trip.imported.description.objects.len(), description.objects.len());
    let text = String::from_utf8(trip.content).expect("it is text");
    assert!(text.contains("zimmer%20100%20%25%20gr%C3%BCn%20%231.files/meshes/"), "{text}");
}

#[test]
fn parallel_cameras_come_back() {
    let camera = CameraDescription {
        projection: Projection::orthographic(3.0),
        fov: None,
        resolution: [1280, 640],
        ..CameraDescription::default()
    };
    let ours = SceneDescription { camera, ..SceneDescription::default() };
    let RoundTrip { imported, remarks, .. } = round_trip(&ours, &Assets::default());
    let theirs = imported.description.camera;
    assert_eq!((theirs.projection, theirs.resolution), (Projection::orthographic(3.0), [1280, 640]));
    assert_eq!((theirs.eye, theirs.up), (ours.camera.eye, None));
    assert_eq!(remarks, [""; 0]);
}
