//! Scenes and dropped files replace what was open.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use noisefall_scene::scene::RenderSettings;

use super::*;

#[test]
fn another_scene_takes_everything_over_and_the_same_one_keeps_the_exposure() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, text.replace("[render]", "[render]\nspp = 5\nseed = 3")).expect("it is written");
    let mut window = window("cornell_spheres");
    wait(&mut window, "a full image", App::can_save);
    click(&mut window, "Pin this");
    assert!(window.state().session.pinned.is_some());
    let app = window.state_mut();
    app.look_mut().display.exposure = 2.0;
    app.window.view.actual_size();
    app.session.budget = noisefall_render::render::Budget { paused: true, steps: 7, noise: Some(0.1), ..Default::default() };
    let other = RenderSettings { seed: 8, ..app.settings() };
    app.start_comparison(other);
    app.instruments.path.look_at([3, 4]);
    app.dialogs.scene_error = Some("the file before it was broken".to_owned());
    assert!(app.results.last_seeing.is_some());
    app.background.loader.open(Some(path.clone()));
    wait(&mut window, "my scene", |app| app.settings().seed == 3);
    let app = window.state();
    let scene = &app.opened().as_ref().expect("it is open").scene;
    assert_eq!((app.camera(), app.settings()), (scene.camera, scene.settings));
    assert_eq!(app.budget(), noisefall_render::render::Budget { max_spp: Some(5), steps: 7, ..Default::default() });
    assert!(
        app.compared_with().is_none()
            && app.session.pinned.is_none()
            && app.path_inspector().pixel.is_none()
            && app.picture_view().zoom.is_none()
    );
    assert!(app.dialogs.scene_error.is_none() && app.results.last_seeing.is_none());
    assert_eq!(app.look().display.exposure, 0.0);
    window.state_mut().look_mut().display.exposure = 1.5;
    window.state_mut().settings_mut().seed = 9;
    window.state_mut().loader_mut().open(Some(path));
    wait(&mut window, "my scene again", |app| app.settings().seed == 3);
    assert_eq!(window.state().look().display.exposure, 1.5);
}

#[test]
fn a_dropped_file_is_a_scene_a_picture_with_its_scene_or_a_reference() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    wait(&mut window, "a full image", App::can_save);
    let [reference, picture] = ["reference.EXR", "picture.png"].map(|name| {
        let path = folder.path().join(name);
        window.state_mut().save_to(path.clone());
        wait(&mut window, "the file", |app| app.last_saved().as_ref() == Some(&path));
        path
    });
    drop_file(&mut window, reference);
    wait(&mut window, "the reference", |app| app.session.given_reference.is_some());
    assert_eq!(window.state().session.given_reference.as_ref().map(|truth| truth.camera), Some(window.state().camera()));
    drop_file(&mut window, shipped("furnace"));
    wait(&mut window, "the scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace"));
    assert!(window.state().session.given_reference.is_none(), "it was of the other scene");
    drop_file(&mut window, picture.clone());
    wait(&mut window, "the scene of the image", |app| {
        app.opened().as_ref().is_some_and(|opened| opened.path.as_ref() == Some(&picture))
    });
    let of_picture = window.state().opened().as_ref().map(|opened| opened.scene.objects.len());
    assert_eq!(of_picture, noisefall_scene::scene::load(&shipped("cornell_spheres")).ok().map(|scene| scene.objects.len()));
}

#[test]
fn a_file_that_takes_long_is_named_and_can_be_cancelled() {
    let mut window = window("furnace");
    for by_key in [false, true] {
        let ended = Arc::new(AtomicBool::new(false));
        window.state_mut().loader_mut().read_for_ever("cathedral.glb", ended.clone());
        window.run_steps(2);
        let says = |window: &Window| window.query_by_label_contains("Reading “cathedral.glb”").is_some();
        assert!(!says(&window), "not at once");
        let start = window.ctx.input(|input| input.time);
        while window.ctx.input(|input| input.time) < start + 0.5 {
            window.step();
        }
        window.run_steps(2);
        assert!(says(&window));
        assert!(window.state().opened().as_ref().is_some_and(|opened| opened.name == "Furnace"), "the old scene stays");
        if by_key {
            press(&mut window, Key::Escape);
        } else {
            click(&mut window, "Cancel");
        }
        assert!(!says(&window) && !window.state().loader().is_busy());
        wait(&mut window, "the end of reading", |_| ended.load(Ordering::Relaxed));
        assert!(window.state().opened().as_ref().is_some_and(|opened| opened.name == "Furnace"));
    }
}
