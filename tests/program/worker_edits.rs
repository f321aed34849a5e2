//! The worker compiles an edited scene and renders it instead of the previous one.
use std::{
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

use noisefall_base::declare::Precision;
use noisefall_render::render::{Budget, EditResult, Frame, Publish, Published, Renderer, SceneEdit, State};
use noisefall_scene::{
    scene::{
        Scene,
        description::{EmissionDescription, SceneDescription},
    },
    shape::Sphere,
};

use crate::worker::{renderer, request, wait_for};

/// A scene whose whole image is one colour: a sphere around the camera that emits and reflects nothing.
fn plain(radiance: f64) -> SceneDescription {
    let mut scene = SceneDescription::default();
    scene.camera.resolution = [200, 120];
    let center = scene.camera.eye;
    let sphere = scene.add_object("sphere", Sphere { center, radius: 2.0 });
    (sphere.flip, sphere.emission) = (true, Some(EmissionDescription::radiance([radiance; 3])));
    scene
}

fn compiled(description: &SceneDescription) -> Arc<Scene> {
    Arc::new(description.build("".as_ref()).expect("it is valid"))
}

fn edit(description: SceneDescription, before: &Arc<Scene>) -> SceneEdit {
    SceneEdit {
        description: Arc::new(description),
        folder: PathBuf::new(),
        before: before.clone(),
        precision: Precision::Interactive,
        keeps_image: false,
        camera: before.camera,
        settings: before.settings,
    }
}

fn result(renderer: &Renderer) -> EditResult {
    let start = Instant::now();
    loop {
        if let Some(result) = renderer.take_edited() {
            return result;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it never came");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn is_full(generation: u64) -> impl Fn(&Published) -> bool {
    move |published| published.frame.generation == generation && !published.frame.is_coarse()
}

/// The one colour of a frame.
fn colour(frame: &Frame) -> f32 {
    let first = frame.radiance[0][0];
    assert!(frame.radiance.iter().all(|pixel| *pixel == [first; 3]), "no old pixel survives");
    first
}

#[test]
fn an_edit_is_compiled_and_rendered_and_its_scene_is_handed_over() {
    let renderer = renderer(Publish::Live);
    let before = compiled(&plain(0.5));
    renderer.submit(1, request(&before));
    assert_eq!(colour(&wait_for(&renderer, "an image", is_full(1)).frame), 0.5);
    renderer.edit(2, edit(plain(2.0), &before));
    let EditResult { generation, scene } = result(&renderer);
    let scene = scene.expect("it is valid");
    assert_eq!((generation, scene.compiled.made("lights"), scene.compiled.made("shapes")), (2, 1, 0));
    assert!(Arc::ptr_eq(&scene.shapes, &before.shapes));
    assert_eq!(colour(&wait_for(&renderer, "the edited image", is_full(2)).frame), 2.0);
    assert!(renderer.take_edited().is_none(), "once");
}

#[test]
fn after_an_edit_that_is_invalid_the_picture_before_goes_on() {
    let renderer = renderer(Publish::Live);
    let before = compiled(&plain(0.5));
    renderer.submit(1, request(&before));
    renderer.edit(2, edit(plain(-1.0), &before));
    let EditResult { generation, scene } = result(&renderer);
    let error = scene.err().expect("a radiance below 0 is refused");
    assert!(generation == 2 && error.to_string().contains("radiance"), "{error}");
    renderer.set_budget(Budget { max_spp: Some(8), ..Budget::default() });
    let done = wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_)));
    assert_eq!((done.status.generation, colour(&done.frame)), (1, 0.5));
}

#[test]
fn of_many_edits_and_requests_the_latest_wins() {
    let renderer = renderer(Publish::Live);
    let before = compiled(&plain(0.5));
    renderer.submit(1, request(&before));
    for generation in 2..=60 {
        renderer.edit(generation, edit(plain(generation as f64), &before));
    }
    let mut last = 0;
    while last < 60 {
        let next = result(&renderer).generation;
        assert!(next > last, "{next} after {last}");
        last = next;
    }
    assert_eq!(colour(&wait_for(&renderer, "the last edit", is_full(60)).frame), 60.0);
    renderer.edit(61, edit(plain(61.0), &before));
    renderer.submit(62, request(&before));
    assert_eq!(colour(&wait_for(&renderer, "the request after an edit", is_full(62)).frame), 0.5);
}
