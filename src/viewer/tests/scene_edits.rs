//! The scene is changed as a user would: select a part, change it, take it back.
use noisefall::{
    declare::{OwnedValue, Path, Textured},
    edit::{Edit, Tree},
    scene::description::SceneDescription,
    shape::{ShapeKind, Transform},
};

use super::{
    selection::{AMBER_BALL, ball, seen},
    *,
};
use crate::viewer::canvas::gizmo::Mode;
use crate::viewer::panels::outliner::{Action, New};

pub fn description(window: &Window) -> &SceneDescription {
    window.state().editor.as_ref().expect("a scene is open").document.description()
}

pub fn bits(window: &Window) -> Tree {
    Tree::of(&mut description(window).clone())
}

/// Does something and waits for the picture of the edited scene.
pub fn edits(window: &mut Window, what: &str, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    act(window);
    wait(window, what, |app| {
        let waits = app.background.worker.is_editing() || app.session.waiting_edit.is_some();
        let shown = app.results.shown.as_ref().map_or(0, |frame| frame.generation);
        !waits && shown > before && shown == app.background.worker.generation()
    });
}

fn select(window: &mut Window, subject: Subject) {
    window.state_mut().window.panel = PanelTab::Edit;
    window.state_mut().selection.select(Some(subject));
    window.run_steps(3);
}

fn material(window: &Window, name: &str) -> OwnedValue {
    let mut document = description(window).clone();
    let path = Path::of("materials").key(name).key("lambertian").key("albedo");
    Tree::at(&mut document, &path).and_then(|tree| tree.value().cloned()).expect("it has an albedo")
}

fn center(window: &Window, object: usize) -> DVec3 {
    let ShapeKind::Sphere(sphere) = &description(window).objects[object].shape else { panic!("it is a ball") };
    sphere.center
}

#[test]
fn an_albedo_that_is_changed_in_the_inspector_is_that_of_the_next_picture() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    assert_eq!(window.state().window.panel, PanelTab::Render, "the page stays");
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    click(&mut window, "Edit");
    assert!(window.query_by_label("Parts").is_some());
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("amberlambertian"));
    row.expect("the material has a row").click();
    window.run_steps(3);
    assert_eq!(window.state().selection.subject, Some(Subject::Material("amber".to_owned())));
    edits(&mut window, "the darker ball", |w| set(w, "Albedo ρ", 0, 0.25));
    assert_eq!(material(&window, "amber"), OwnedValue::Textured(Textured::Constant([0.25, 0.55, 0.22])));
    let scene = &window.state().session.opened.as_ref().expect("it is open").scene;
    assert!(scene.source.contains("0.25, 0.55, 0.22"), "the scene that is rendered is the edited one");
}

#[test]
fn edits_and_controls_are_undone_in_one_order_to_the_very_same_scene() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    select(&mut window, Subject::Material("white".to_owned()));
    edits(&mut window, "a first edit", |w| set(w, "Albedo ρ", 1, 0.5));
    let first = bits(&window);
    window.state_mut().session.settings.seed = 9;
    window.run_steps(3);
    edits(&mut window, "a second edit", |w| set(w, "Albedo ρ", 2, 0.125));
    let second = bits(&window);
    let at = |window: &Window, expected: &Tree, seed: u32| {
        assert!(bits(window).is_identical(expected));
        assert_eq!(window.state().session.settings.seed, seed);
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
        let opened = app.session.opened.as_ref().expect("it is open");
        app.editor.as_ref().is_some_and(|editor| editor.document.description() == &*opened.description)
    });
}

#[test]
fn parts_are_added_duplicated_renamed_assigned_and_deleted() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    window.state_mut().add(New::Shape("cuboid"));
    window.state_mut().add(New::Lamp("disk"));
    assert_eq!(description(&window).objects.len(), 10);
    assert_eq!(window.state().selection.object(), Some(9), "what is new is selected");
    let ball = || Subject::Object(AMBER_BALL);
    window.state_mut().act_on(ball(), Action::Duplicate);
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL + 1));
    assert_eq!(description(&window).objects[AMBER_BALL + 1].name, "amber ball 2");
    window.state_mut().act_on(ball(), Action::Rename("globe".to_owned()));
    window.state_mut().act_on(ball(), Action::AssignMaterial(Some("blue".to_owned())));
    window.state_mut().act_on(ball(), Action::ChangeKind("cylinder"));
    let object = &description(&window).objects[AMBER_BALL];
    assert_eq!((object.name.as_str(), object.material.as_deref()), ("globe", Some("blue")));
    assert!(matches!(object.shape, ShapeKind::Cylinder(_)));
    window.state_mut().act_on(Subject::Material("blue".to_owned()), Action::Rename("sky".to_owned()));
    assert_eq!(description(&window).objects[AMBER_BALL].material.as_deref(), Some("sky"));
    window.state_mut().act_on(Subject::Material("sky".to_owned()), Action::Delete);
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains("aterial `sky` is")));
    window.state_mut().act_on(Subject::Background, Action::AddBackground);
    assert!(description(&window).background.is_some());
    window.state_mut().act_on(ball(), Action::Delete);
    assert_eq!((description(&window).objects.len(), window.state().selection.subject.clone()), (10, None));
    edits(&mut window, "the picture of all of it", |w| w.run_steps(2));
    (0..9).for_each(|_| undo(&mut window));
    assert!(bits(&window).is_identical(&start));
}

#[test]
fn lamps_without_surface_are_parts_like_others() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    window.state_mut().add(New::LampWithoutSurface("spot"));
    assert_eq!(window.state().selection.subject, Some(Subject::Lamp(0)), "what is new is selected");
    window.state_mut().act_on(Subject::Lamp(0), Action::Duplicate);
    assert_eq!(window.state().selection.subject, Some(Subject::Lamp(1)));
    window.state_mut().act_on(Subject::Lamp(1), Action::Rename("stage".to_owned()));
    window.state_mut().act_on(Subject::Lamp(1), Action::ChangeKind("point"));
    let lamps = description(&window).lamps.clone();
    assert_eq!(
        [&lamps[0], &lamps[1]].map(|lamp| (lamp.name.clone(), lamp.kind.name())),
        [("spot".to_owned(), "spot"), ("stage".to_owned(), "point")]
    );
    edits(&mut window, "the picture of both", |w| w.run_steps(2));
    window.state_mut().act_on(Subject::Lamp(1), Action::Delete);
    assert_eq!((description(&window).lamps.len(), window.state().selection.subject.clone()), (1, None));
    (0..5).for_each(|_| undo(&mut window));
    assert!(bits(&window).is_identical(&start));
}

#[test]
fn the_menu_adds_what_it_says() {
    let mut window = window("cornell_spheres");
    for entries in [&["Add", "Material"][..], &["Add", "Texture"]] {
        click(&mut window, "Edit");
        entries.iter().for_each(|entry| click(&mut window, entry));
    }
    assert!(description(&window).materials.contains_key("material"));
    assert_eq!(window.state().selection.subject, Some(Subject::Texture("texture".to_owned())));
}

#[test]
fn the_gizmo_moves_the_object_by_keys_and_escape_takes_it_back() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    let (start, tool) = (center(&window, AMBER_BALL), window.state().window.tool);
    window.hover_at(at - vec2(0.0, 120.0));
    window.run_steps(2);
    press(&mut window, Key::G);
    for key in [Key::X, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    assert_eq!(window.state().window.tool, tool, "the key moves the object and chooses no tool");
    assert!(center(&window, AMBER_BALL).distance(start + DVec3::X * 2.0) < 1e-12);
    undo(&mut window);
    assert_eq!(center(&window, AMBER_BALL), start);
    // It is one step: before it nothing was edited.
    assert!(!window.state().has_unsaved_changes());
    // Over a handle too.
    window.hover_at(at);
    window.run_steps(2);
    press(&mut window, Key::G);
    window.hover_at(at + vec2(60.0, -60.0));
    window.run_steps(3);
    assert_ne!(center(&window, AMBER_BALL), start);
    press(&mut window, Key::Escape);
    assert_eq!((center(&window, AMBER_BALL), window.state().has_unsaved_changes()), (start, false));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL), "the key ends the operation only");
    let camera = window.state().session.camera;
    for key in [Key::S, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    let ShapeKind::Sphere(sphere) = &description(&window).objects[AMBER_BALL].shape else { panic!("it is a ball") };
    assert!((sphere.radius - 0.76).abs() < 1e-12);
    assert_eq!(window.state().session.camera, camera, "the key does not fly");
}

#[test]
fn keys_of_operations_cost_nothing_without_an_object_or_beside_the_picture() {
    let mut window = window("cornell_spheres");
    let tool = window.state().window.tool;
    let press_both = |w: &mut Window| [Key::G, Key::R].into_iter().for_each(|key| press(w, key));
    window.hover_at(Pos2::new(430.0, 430.0));
    window.run_steps(2);
    never_restarts(&mut window, press_both);
    window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
    window.event(egui::Event::PointerGone);
    window.run_steps(2);
    never_restarts(&mut window, press_both);
    assert_eq!((window.state().window.tool, window.state().has_unsaved_changes()), (tool, false));
}

#[test]
fn keys_duplicate_and_delete_the_selected_object() {
    let mut window = window("cornell_spheres");
    let (count, camera) = (description(&window).objects.len(), window.state().session.camera);
    for delete in [Key::Delete, Key::X] {
        window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
        window.key_press_modifiers(Modifiers::SHIFT, Key::D);
        window.run_steps(3);
        assert_eq!(description(&window).objects.len(), count + 1);
        press(&mut window, delete);
        assert_eq!((description(&window).objects.len(), window.state().selection.subject.clone()), (count, None));
        press(&mut window, delete);
        assert_eq!(description(&window).objects.len(), count, "nothing is selected");
    }
    assert_eq!(window.state().session.camera, camera, "the key does not fly");
    (0..4).for_each(|_| undo(&mut window));
    assert!(!window.state().has_unsaved_changes());
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
    edits(&mut window, "a wider picture", |w| {
        w.state_mut().edit(&fov(50.0));
        w.run_steps(1);
    });
    assert_eq!((window.state().session.camera.fov, window.state().session.camera.resolution), (50.0, [96, 64]));
    window.run_steps(3);
    edits(&mut window, "the way back", undo);
    assert_eq!(window.state().session.camera.fov, 36.0);
    assert!(!window.state().has_unsaved_changes());
}

#[test]
fn an_object_drops_to_the_floor() {
    let mut window = window("cornell_spheres");
    let lift = Transform::Translate(DVec3::Y * 0.3);
    let editor = window.state().editor.as_ref().expect("a scene is open");
    let edit = editor.document.transformed(AMBER_BALL, &lift, DVec3::ZERO).expect("it is there");
    edits(&mut window, "the ball in the air", |w| {
        w.state_mut().edit(&edit);
        w.run_steps(1);
    });
    window.state_mut().act_on(Subject::Object(AMBER_BALL), Action::DropToFloor);
    assert!((center(&window, AMBER_BALL).y - 0.38).abs() < 1e-3, "{}", center(&window, AMBER_BALL));
}

#[test]
fn title_and_settings_of_the_scene_have_rows_too() {
    let mut window = window("cornell_spheres");
    select(&mut window, Subject::Presentation);
    assert!(window.query_by_label("Title").is_some() && window.query_by_label("Truth").is_some());
    window.state_mut().edit(&Edit::set(Path::of("title"), OwnedValue::Text("Five balls".to_owned())));
    let title = |app: &App| app.session.opened.as_ref().is_some_and(|opened| opened.scene.title == "Five balls");
    wait(&mut window, "the scene under its new title", title);
    let opened = window.state().session.opened.as_ref().expect("it is open");
    assert!(opened.scene.source.contains("title = \"Five balls\""));
}

#[test]
fn a_material_is_dragged_from_the_list_onto_an_object_in_the_image() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    select(&mut window, Subject::Material("blue".to_owned()));
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("bluelambertian"));
    let from = row.expect("the material has a row").rect().center();
    edits(&mut window, "the blue ball", |window| drag(window, PointerButton::Primary, from.into(), at.into()));
    assert_eq!(description(&window).objects[AMBER_BALL].material.as_deref(), Some("blue"));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL), "what was changed is selected");
}

#[test]
fn a_texture_is_dragged_onto_an_object_whose_name_is_at_the_pointer_and_whose_outline_is_shown() {
    let mut window = window("cornell_spheres");
    window.state_mut().add(New::Texture);
    let at = seen(&mut window, ball());
    select(&mut window, Subject::Texture("texture".to_owned()));
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("texturechecker"));
    let from = row.expect("the texture has a row").rect().center();
    let press = |window: &Window, pos, pressed| {
        window.event(egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
    };
    window.hover_at(from);
    window.run_steps(2);
    press(&window, from, true);
    window.run_steps(1);
    for part in [0.5, 1.0, 1.0] {
        window.hover_at(from + (at - from) * part);
        window.run_steps(2);
    }
    assert_eq!(window.state().drop_target(), Some(AMBER_BALL), "it is outlined");
    edits(&mut window, "the checkered ball", |window| {
        press(window, at, false);
        window.run_steps(2);
    });
    let color = Path::of("materials.amber.lambertian.albedo");
    let found = Tree::at(&mut description(&window).clone(), &color).and_then(|tree| tree.value().cloned());
    assert_eq!(found, Some(OwnedValue::Textured(Textured::Texture("texture".to_owned()))));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
}

#[test]
fn the_icon_of_a_lamp_selects_it_on_the_page_of_the_scene() {
    let mut window = window("cornell_spheres");
    window.state_mut().add(New::LampWithoutSurface("point"));
    let position = description(&window).lamps[0].position().expect("it stands somewhere");
    let at = seen(&mut window, position);
    for (page, selected) in [(PanelTab::Render, false), (PanelTab::Edit, true)] {
        window.state_mut().window.panel = page;
        window.state_mut().selection.select(None);
        window.run_steps(2);
        click_at(&mut window, at);
        assert_eq!(window.state().selection.subject == Some(Subject::Lamp(0)), selected, "{page:?}");
    }
}

#[test]
fn a_material_names_the_objects_that_use_it_and_they_are_a_click_away() {
    let mut window = window("cornell_spheres");
    select(&mut window, Subject::Material("amber".to_owned()));
    let button = |window: &Window| window.get_all_by_role_and_label(Role::Button, "amber ball").count();
    assert_eq!(button(&window), 1);
    window.get_by_role_and_label(Role::Button, "amber ball").click();
    window.run_steps(3);
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    for (name, mode) in [("Rotate", Mode::Rotate), ("Scale", Mode::Scale), ("Move", Mode::Move)] {
        click(&mut window, name);
        assert_eq!(window.state().selection.gizmo.mode, mode);
    }
}

#[test]
fn shift_a_opens_the_menu_that_adds_and_letters_do_not_fly_over_a_selection() {
    let mut window = window("cornell_spheres");
    select(&mut window, Subject::Object(AMBER_BALL));
    let camera = window.state().session.camera;
    window.hover_at(Pos2::new(430.0, 430.0));
    window.run_steps(2);
    [Key::A, Key::W, Key::E].into_iter().for_each(|key| press(&mut window, key));
    window.key_press_modifiers(Modifiers::SHIFT, Key::A);
    window.run_steps(3);
    assert_eq!(window.state().session.camera, camera, "no key flies");
    window.get_by_role_and_label(Role::Button, "Material").click();
    window.run_steps(3);
    assert!(description(&window).materials.contains_key("material"));
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
    map.expect("it is behind the color").click();
    window.run_steps(3);
    click(&mut window, "New noise");
    assert!(description(&window).textures.contains_key("noise"));
    let albedo = material(&window, "amber");
    assert_eq!(albedo, OwnedValue::Textured(Textured::Texture("noise".to_owned())));
}

#[test]
fn saving_says_that_the_view_is_left_out_and_can_keep_it() {
    let mut window = window("cornell_spheres");
    window.state_mut().session.camera.eye.y += 0.1;
    let eye = window.state().session.camera.eye;
    window.run_steps(2);
    let at = seen(&mut window, ball());
    window.state_mut().ask_where_to_save();
    window.run_steps(3);
    // The dialog has the mouse too.
    click_at(&mut window, at);
    assert_eq!(window.state().selection.subject, None);
    check_box(&mut window, "Save this view as the scene's camera");
    window.state_mut().keep_view();
    assert_eq!(description(&window).camera.eye, eye);
    let resolution = description(&window).camera.resolution;
    assert_ne!(resolution, [96, 64], "the resolution is no part of the view");
    window.run_steps(2);
    wait(&mut window, "the scene with this view", |app| !app.session.view_differs());
}
