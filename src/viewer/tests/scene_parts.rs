//! Parts of the scene come and go: by menus, by keys, and by their names.
use noisefall_scene::shape::{ShapeKind, Transform};

use super::{
    edited::{bits, center, description, edits, select},
    selection::{AMBER_BALL, seen},
    *,
};
use crate::viewer::{
    canvas::gizmo::Mode,
    panels::outliner::{Action, New},
};

#[test]
fn parts_are_added_duplicated_renamed_assigned_and_deleted() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    window.state_mut().add(New::Shape("cuboid"));
    window.state_mut().add(New::AreaLight("disk"));
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
    window.state_mut().act_on(Subject::Environment, Action::AddEnvironment);
    assert!(description(&window).environment.is_some());
    window.state_mut().act_on(ball(), Action::Delete);
    assert_eq!((description(&window).objects.len(), window.state().selected().clone()), (10, None));
    edits(&mut window, "the image of all of it", |w| w.run_steps(2));
    (0..9).for_each(|_| undo(&mut window));
    assert!(bits(&window).is_identical(&start));
}

#[test]
fn a_shape_gets_the_diffuse_material_of_the_surface_where_it_is_added() {
    let mut window = window("cornell_spheres");
    for (clicked, material) in [(DVec3::new(0.0, 0.0, 0.9), "white"), (selection::ball(), "amber")] {
        let at = seen(&mut window, clicked);
        click_at(&mut window, at);
        window.state_mut().add(New::Shape("cuboid"));
        let added = description(&window).objects.last().expect("it is there");
        assert_eq!(added.material.as_deref(), Some(material));
        undo(&mut window);
    }
}

#[test]
fn lights_without_surface_are_parts_like_others() {
    let mut window = window("cornell_spheres");
    let start = bits(&window);
    window.state_mut().add(New::PunctualLight("spot"));
    assert_eq!(window.state().selected(), Some(Subject::PunctualLight(0)), "what is new is selected");
    window.state_mut().act_on(Subject::PunctualLight(0), Action::Duplicate);
    assert_eq!(window.state().selected(), Some(Subject::PunctualLight(1)));
    window.state_mut().act_on(Subject::PunctualLight(1), Action::Rename("stage".to_owned()));
    window.state_mut().act_on(Subject::PunctualLight(1), Action::ChangeKind("point"));
    let punctual_lights = description(&window).punctual_lights.clone();
    assert_eq!(
        [&punctual_lights[0], &punctual_lights[1]]
            .map(|punctual_light| (punctual_light.name.clone(), punctual_light.kind.name())),
        [("spot".to_owned(), "spot"), ("stage".to_owned(), "point")]
    );
    edits(&mut window, "the image of both", |w| w.run_steps(2));
    window.state_mut().act_on(Subject::PunctualLight(1), Action::Delete);
    assert_eq!((description(&window).punctual_lights.len(), window.state().selected().clone()), (1, None));
    (0..5).for_each(|_| undo(&mut window));
    assert!(bits(&window).is_identical(&start));
}

#[test]
fn the_menu_adds_materials_and_textures() {
    let mut window = window("cornell_spheres");
    for entries in [&["Add", "Material"][..], &["Add", "Texture"]] {
        click(&mut window, "Edit");
        entries.iter().for_each(|entry| click(&mut window, entry));
    }
    assert!(description(&window).materials.contains_key("material"));
    assert_eq!(window.state().selected(), Some(Subject::Texture("texture".to_owned())));
}

#[test]
fn keys_duplicate_and_delete_the_selected_object() {
    let mut window = window("cornell_spheres");
    let (count, camera) = (description(&window).objects.len(), window.state().camera());
    for delete in [Key::Delete, Key::X] {
        window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
        window.key_press_modifiers(Modifiers::SHIFT, Key::D);
        window.run_steps(3);
        assert_eq!(description(&window).objects.len(), count + 1);
        press(&mut window, delete);
        assert_eq!((description(&window).objects.len(), window.state().selected().clone()), (count, None));
        press(&mut window, delete);
        assert_eq!(description(&window).objects.len(), count, "nothing is selected");
    }
    assert_eq!(window.state().camera(), camera, "the key does not fly");
    (0..4).for_each(|_| undo(&mut window));
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
fn the_icon_of_a_light_selects_it_on_the_page_of_the_scene() {
    let mut window = window("cornell_spheres");
    window.state_mut().add(New::PunctualLight("point"));
    let position = description(&window).punctual_lights[0].position().expect("it stands somewhere");
    let at = seen(&mut window, position);
    for (page, selected) in [(PanelTab::Render, false), (PanelTab::Edit, true)] {
        *window.state_mut().panel_mut() = page;
        window.state_mut().selection.select(None);
        window.run_steps(2);
        click_at(&mut window, at);
        assert_eq!(window.state().selected() == Some(Subject::PunctualLight(0)), selected, "{page:?}");
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
    let camera = window.state().camera();
    window.hover_at(Pos2::new(430.0, 430.0));
    window.run_steps(2);
    [Key::A, Key::W, Key::E].into_iter().for_each(|key| press(&mut window, key));
    window.key_press_modifiers(Modifiers::SHIFT, Key::A);
    window.run_steps(3);
    assert_eq!(window.state().camera(), camera, "no key flies");
    window.get_by_role_and_label(Role::Button, "Material").click();
    window.run_steps(3);
    assert!(description(&window).materials.contains_key("material"));
}
