//! Edits of the scene: they reach the image, keep camera and settings, and settle when the drag ends.
use std::sync::Arc;

use egui::pos2;
use noisefall_render::render::{RenderRequest, RenderTask};
use noisefall_scene::{
    scene::{Camera, RenderSettings, built_in, describe, description::SceneDescription, description::Transform},
    shape::mesh::{Knot, Mesh, MeshSource},
};

use super::*;
use crate::viewer::background::render_worker::{EditedDescription, RenderWorkerHandle};

fn description(scene: &str) -> SceneDescription {
    let path = shipped(scene);
    let text = std::fs::read_to_string(&path).expect("the scene can be read");
    describe(&path.display().to_string(), text).expect("the scene is valid")
}

/// Makes an edit, and waits for its image.
fn edit(window: &mut Window, description: &SceneDescription) {
    window.state_mut().edit_scene(Arc::new(description.clone()));
    window.step();
    wait(window, "the edited image", |app| {
        let shown = app.shown_frame().as_ref().map_or(0, |frame| frame.generation);
        let waits = app.worker().is_editing() || app.session.waiting_edit.is_some();
        !waits && shown == app.worker().generation()
    });
}

fn mean(app: &App) -> f32 {
    let frame = app.shown_frame().as_ref().expect("an image is shown");
    frame.radiance.iter().map(|[_, g, _]| g).sum::<f32>() / frame.radiance.len() as f32
}

#[test]
fn a_brighter_light_makes_the_picture_brighter_and_keeps_camera_and_settings() {
    let mut window = window("cornell_spheres");
    let mut description = description("cornell_spheres");
    window.state_mut().camera_mut().fov = 30.0;
    window.state_mut().settings_mut().seed = 7;
    edit(&mut window, &description);
    let before = mean(window.state());
    description.objects.iter_mut().find_map(|object| object.emission.as_mut()).expect("a light").scale = 50.0;
    edit(&mut window, &description);
    assert!(mean(window.state()) > 10.0 * before, "{} after {before}", mean(window.state()));
    assert_eq!((window.state().camera().fov, window.state().settings().seed), (30.0, 7));
    let opened = window.state().opened().as_ref().expect("it is open");
    assert!(Arc::ptr_eq(&opened.scene, &window.state().worker().request().expect("it is rendered").scene));
    // The camera of the scene is edited: the window follows.
    description.camera.fov = Some(50.0);
    edit(&mut window, &description);
    assert_eq!(window.state().camera().fov, 50.0);
}

#[test]
fn an_edit_of_title_and_notes_keeps_the_samples_and_is_in_the_scene_of_the_image() {
    let mut window = window("cornell_spheres");
    let mut description = description("cornell_spheres");
    (description.title, description.notes) = ("Five balls".to_owned(), "One is amber.".to_owned());
    never_restarts(&mut window, |w| {
        w.state_mut().edit_scene(Arc::new(description.clone()));
        w.step();
        wait(w, "the edited scene", |app| app.opened().as_ref().is_some_and(|opened| opened.scene.title == "Five balls"));
    });
    assert!(window.query_by_label("One is amber.").is_some());
    let request = window.state().worker().request().expect("it is rendered");
    assert!(request.scene.source.contains("Five balls"), "a saved image carries the new title");
    // The next change restarts the render.
    description.materials.clear();
    description.objects.iter_mut().for_each(|object| object.material = None);
    restarts(&mut window, "the black scene", |w| {
        edit(w, &description);
    });
}

#[test]
fn an_edit_that_is_invalid_says_why_and_keeps_the_scene() {
    let mut window = window("cornell_spheres");
    let (generation, scene) =
        (window.state().worker().generation(), window.state().opened().as_ref().expect("open").scene.clone());
    let mut description = description("cornell_spheres");
    description.camera.look_at = description.camera.eye;
    edit(&mut window, &description);
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains("the same point")));
    assert!(Arc::ptr_eq(&window.state().opened().as_ref().expect("open").scene, &scene));
    assert_eq!(window.state().worker().generation(), generation);
}

#[test]
fn a_mesh_that_is_dragged_settles_when_the_button_is_released() {
    let mut window = window("cornell_spheres");
    let mut description = description("cornell_spheres");
    let knot = Mesh { source: MeshSource::Knot(Knot { triangles: 500 }), smooth: None };
    description.add_object("knot", knot).material = Some("white".to_owned());
    edit(&mut window, &description);
    let moves = |app: &App| app.opened().as_ref().is_some_and(|opened| opened.scene.shapes.have_moved_meshes());
    assert!(!moves(window.state()), "a new mesh has a tree of its own");
    window.drag_at(pos2(640.0, 1296.0));
    window.step();
    for step in 1..4 {
        description.objects.last_mut().expect("the knot").transform =
            vec![Transform::Translate(DVec3::Y * 0.1 * f64::from(step))];
        edit(&mut window, &description);
        assert!(moves(window.state()));
    }
    window.drop_at(pos2(640.0, 1296.0));
    wait(&mut window, "the tree of the last pose", |app| !moves(app));
}

#[test]
fn while_an_edit_is_compiled_nothing_else_is_requested_and_the_second_view_follows_it() {
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    let mut worker = RenderWorkerHandle::new(threads, &egui::Context::default());
    let scene = built_in();
    let camera = Camera { resolution: [8, 8], ..scene.camera };
    let request = RenderRequest { settings: scene.settings, scene: Arc::new(scene), camera };
    let other = |request: &RenderRequest| {
        let settings = RenderSettings { seed: 5, ..request.settings };
        Some(RenderTask::Picture(RenderRequest { settings, ..request.clone() }))
    };
    worker.update(request.clone(), other(&request), 0.0);
    let (description, folder) = (Arc::new(description("cornell_spheres")), PathBuf::new());
    worker.edit(request.clone(), EditedDescription { description, folder, differs_unseen: false, earlier: None }, 1.0);
    worker.update(request.clone(), other(&request), 1.0);
    assert_eq!((worker.generation(), worker.second_generation()), (3, 2));
    let start = Instant::now();
    let scene = loop {
        if let Some(result) = worker.take_edited() {
            break result.unwrap_or_else(|error| panic!("{error}"));
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it never came");
    };
    assert!(!worker.is_editing());
    let edited = RenderRequest { scene, ..request };
    worker.update(edited.clone(), other(&edited), 2.0);
    assert_eq!((worker.generation(), worker.second_generation()), (3, 4));
}
