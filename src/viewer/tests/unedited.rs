//! Nothing but an edit restarts a render: not the pointer, not a press without a move, not another tool, not saving.
use noisefall_render::render::Budget;
use noisefall_scene::scene::ShippedScene;

use super::*;

/// Places over the image.
const PLACES: [[f32; 2]; 4] = [[300.0, 300.0], [471.0, 533.0], [640.5, 402.25], [333.0, 711.0]];

/// Presses and releases a button of the mouse without a move.
fn press_in_place(window: &mut Window, at: [f32; 2], button: PointerButton) {
    let pos = Pos2::from(at);
    for pressed in [true, false] {
        window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
        window.run_steps(2);
    }
}

/// Chooses every tool, moves the pointer over the image with it, and presses every button.
fn use_all_tools(window: &mut Window) {
    for key in [Key::C, Key::B, Key::I, Key::P, Key::C] {
        press(window, key);
        for at in PLACES {
            window.hover_at(at.into());
            window.run_steps(1);
        }
        for button in [PointerButton::Middle, PointerButton::Secondary] {
            press_in_place(window, PLACES[0], button);
            press(window, Key::Escape);
        }
    }
}

#[test]
fn no_event_without_an_edit_restarts_any_shipped_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    for scene in ShippedScene::all() {
        let path = folder.path().join(scene.name).with_extension("toml");
        std::fs::write(&path, scene.text).expect("it is written");
        for (file, bytes) in scene.files() {
            let file = folder.path().join(file);
            std::fs::create_dir_all(file.parent().expect("it is in a folder")).expect("it is made");
            std::fs::write(file, bytes).expect("it is written");
        }
        let mut window = open(Some(path.clone()));
        wait(&mut window, scene.name, |app| app.opened().is_some());
        let session = &mut window.state_mut().session;
        (session.camera.resolution, session.budget) = ([32, 20], Budget { max_spp: Some(1), ..Budget::default() });
        wait(&mut window, scene.name, |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 32));
        window.run_steps(2);
        let camera = window.state().camera();
        never_restarts(&mut window, use_all_tools);
        assert_eq!(window.state().camera(), camera, "{}", scene.name);
        never_restarts(&mut window, |w| {
            w.state_mut().save_scene_to(&path);
            wait(w, scene.name, |app| app.saving.is_none());
        });
        let errors: Vec<&str> =
            window.state().dialogs.notices.0.iter().filter(|notice| notice.is_error).map(|notice| &*notice.text).collect();
        assert!(errors.is_empty() && !window.state().session.view_differs(), "{}: {errors:?}", scene.name);
    }
}
