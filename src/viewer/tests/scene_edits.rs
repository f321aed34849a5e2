//! The scene is changed as a user would: select a part, change it, take it back.
use noisefall_base::declare::{OwnedValue, Path, Textured};
use noisefall_edit::edit::{Edit, Tree};

use super::{
    edited::{bits, description, edits, material, select},
    selection::{AMBER_BALL, ball, seen},
    *,
};
use crate::viewer::panels::outliner::Action;

#[test]
fn an_albedo_that_is_changed_in_the_inspector_is_that_of_the_next_picture() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    assert_eq!(window.state().panel(), PanelTab::Render, "the page stays");
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    click(&mut window, "Edit");
    assert!(window.query_by_label("Parts").is_some());
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("amberlambertian"));
    row.expect("the material has a row").click();
    window.run_steps(3);
    assert_eq!(window.state().selected(), Some(Subject::Material("amber".to_owned())));
    edits(&mut window, "the darker ball", |w| set(w, "Albedo ρ", 0, 0.25));
    assert_eq!(material(&window, "amber"), OwnedValue::Textured(Textured::Constant([0.25, 0.55, 0.22])));
    let scene = &window.state().opened().as_ref().expect("it is open").scene;
    assert!(scene.source.contains("0.25, 0.55, 0.22"), "the scene that is rendered is the edited one");
}

#[test]
fn edits_and_controls_are_undone_in_one_order_to_the_very_same_scene() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    select(&mut window, Subject::Material("white".to_owned()));
    edits(&mut window, "a first edit", |w| set(w, "Albedo ρ", 1, 0.5));
    let first = bits(&window);
    window.state_mut().settings_mut().seed = 9;
    window.run_steps(3);
    edits(&mut window, "a second edit", |w| set(w, "Albedo ρ", 2, 0.125));
    let second = bits(&window);
    let at = |window: &Window, expected: &Tree, seed: u32| {
        assert!(bits(window).is_identical(expected));
        assert_eq!(window.state().settings().seed, seed);
    };
    for (expected, seed) in [(&first, 9), (&first, 0), (&start, 0)] {
        undo(&mut window);
        at(&window, expected, seed);
    }
    assert!(!window.state().has_unsaved_changes());
    for (expected, seed) in [(&first, 0), (&first, 9), (&second, 9)] {
        redo(&mut window);
        at(&window, expected, seed);
    }
    assert!(window.state().has_unsaved_changes());
    wait(&mut window, "the last scene", |app| {
        let opened = app.opened().as_ref().expect("it is open");
        app.editor.as_ref().is_some_and(|editor| editor.document.description() == &*opened.description)
    });
}

#[test]
fn an_edit_that_the_reader_would_refuse_changes_nothing_and_says_so() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    let flat = Edit::set(Path::of("objects.5.shape.sphere.radius"), OwnedValue::Number(-1.0));
    assert!(!window.state_mut().edit(&flat));
    assert!(bits(&window).is_identical(&start) && !window.state().has_unsaved_changes());
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains("radius")));
}

#[test]
fn the_camera_of_the_scene_is_edited_and_the_window_follows_without_a_step() {
    let mut window = window("cornell_spheres");
    let fov = |degrees: f64| Edit::set(Path::of("camera.fov"), OwnedValue::Number(degrees));
    edits(&mut window, "a wider image", |w| {
        w.state_mut().edit(&fov(50.0));
        w.run_steps(1);
    });
    assert_eq!((window.state().camera().fov, window.state().camera().resolution), (50.0, [96, 64]));
    window.run_steps(3);
    edits(&mut window, "the way back", undo);
    assert_eq!(window.state().camera().fov, 36.0);
    assert!(!window.state().has_unsaved_changes());
}

#[test]
fn title_and_settings_of_the_scene_have_rows_too() {
    let mut window = window("cornell_spheres");
    select(&mut window, Subject::Presentation);
    assert!(window.query_by_label("Title").is_some() && window.query_by_label("Reference").is_some());
    window.state_mut().edit(&Edit::set(Path::of("title"), OwnedValue::Text("Five balls".to_owned())));
    let title = |app: &App| app.opened().as_ref().is_some_and(|opened| opened.scene.title == "Five balls");
    wait(&mut window, "the scene under its new title", title);
    let opened = window.state().opened().as_ref().expect("it is open");
    assert!(opened.scene.source.contains("title = \"Five balls\""));
}

#[test]
fn undo_keeps_the_selected_object_though_its_place_in_the_list_is_another_one() {
    let mut window = window("cornell_spheres");
    window.state_mut().act_on(Subject::Object(0), Action::Duplicate);
    window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL + 1)));
    window.run_steps(3);
    undo(&mut window);
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    redo(&mut window);
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL + 1));
    window.state_mut().selection.select(Some(Subject::Object(1)));
    undo(&mut window);
    assert_eq!(window.state().selection.object(), None, "it is gone");
}

#[test]
fn the_map_of_a_color_can_be_a_new_texture() {
    let mut window = window("cornell_spheres");
    select(&mut window, Subject::Material("amber".to_owned()));
    let map = window.get_all_by_role_and_label(Role::Button, "Albedo ρ").last();
    map.expect("it is behind the colour").click();
    window.run_steps(3);
    click(&mut window, "New noise");
    assert!(description(&window).textures.contains_key("noise"));
    let albedo = material(&window, "amber");
    assert_eq!(albedo, OwnedValue::Textured(Textured::Texture("noise".to_owned())));
}
