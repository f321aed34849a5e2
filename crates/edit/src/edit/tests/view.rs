//! The camera and the settings of a view.
use std::path::Path as FilePath;

use glam::DVec3;

use super::*;
use noisefall_scene::scene::{Camera, Projection, RenderSettings};

fn view(document: &Document) -> (Camera, RenderSettings) {
    let scene = document.description().build(FilePath::new("")).unwrap_or_else(|error| panic!("{}", error.report()));
    (scene.camera, scene.settings)
}

#[test]
fn a_scene_takes_over_the_view_and_its_file_changes_only_there() {
    let mut document = room();
    let (camera, settings) = view(&document);
    assert_eq!(document.use_view(&camera, &settings), None, "it has this view");
    let eye = DVec3::new(1.0, 1.5, 4.0);
    let edit = document.use_view(&Camera { eye, ..camera }, &settings).expect("it is another view");
    let inverse = document.apply(&edit).expect("it is valid");
    assert_eq!(document.text(), ROOM.replace("eye = [0.0, 1.0, 4.0]", "eye = [1.0, 1.5, 4.0]"));
    document.apply(&inverse).expect("it was so");
    assert_eq!(document.text(), ROOM);
    let parallel = Camera { projection: Projection::orthographic(3.0), up: DVec3::X, ..camera };
    let seeded = RenderSettings { seed: 7, ..settings };
    let edit = document.use_view(&parallel, &seeded).expect("it is another view");
    document.apply(&edit).expect("it is valid");
    let (camera, settings) = view(&document);
    assert_eq!((camera.projection, camera.up, settings), (parallel.projection, DVec3::X, seeded));
}
