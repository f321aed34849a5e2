//! Keys move, rotate and scale the selected object.
use noisefall_scene::shape::ShapeKind;

use crate::viewer::panels::outliner::{Action, New};

use super::{
    edited::{center, description, edits},
    selection::{AMBER_BALL, ball, seen},
    *,
};

/// A window in whose image the amber ball was clicked.
fn window_with_ball() -> Window {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    window
}

#[test]
fn the_gizmo_moves_the_object_by_keys_and_escape_takes_it_back() {
    let mut window = window_with_ball();
    let at = seen(&mut window, ball());
    let (start, tool) = (center(&window, AMBER_BALL), window.state().tool());
    window.hover_at(at - vec2(0.0, 120.0));
    window.run_steps(2);
    press(&mut window, Key::G);
    for key in [Key::X, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    assert_eq!(window.state().tool(), tool, "the key moves the object and chooses no tool");
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
    let camera = window.state().camera();
    for key in [Key::S, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    let ShapeKind::Sphere(sphere) = &description(&window).objects[AMBER_BALL].shape else { panic!("it is a ball") };
    assert!((sphere.radius - 0.76).abs() < 1e-12);
    assert_eq!(window.state().camera(), camera, "the key does not fly");
}

#[test]
fn a_copy_follows_the_pointer_until_it_is_put_down() {
    let mut window = window_with_ball();
    let count = description(&window).objects.len();
    edits(&mut window, "the copy", |w| w.key_press_modifiers(Modifiers::SHIFT, Key::D));
    let copy = window.state().selection.object().expect("it is selected");
    let start = center(&window, copy);
    for key in [Key::X, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    assert_eq!(description(&window).objects.len(), count + 1, "x is an axis here");
    assert!(center(&window, copy).distance(start + DVec3::X * 2.0) < 1e-12);
    undo(&mut window);
    assert!(!window.state().has_unsaved_changes(), "it is one step");
    redo(&mut window);
    assert!(center(&window, copy).distance(start + DVec3::X * 2.0) < 1e-12);
    undo(&mut window);
    // Escape, or a click where it began, takes the copy back.
    for moves in [&[Key::X, Key::Num2, Key::Escape][..], &[Key::Enter]] {
        window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
        edits(&mut window, "another copy", |w| w.key_press_modifiers(Modifiers::SHIFT, Key::D));
        assert_eq!(window.state().selection.object(), Some(copy));
        moves.iter().for_each(|key| press(&mut window, *key));
        assert_eq!((description(&window).objects.len(), window.state().has_unsaved_changes()), (count, false));
        assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    }
}

#[test]
fn another_edit_ends_the_move_of_a_copy() {
    let mut window = window_with_ball();
    let count = description(&window).objects.len();
    for moves in [&[][..], &[Key::X, Key::Num2]] {
        window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
        edits(&mut window, "the copy", |w| w.key_press_modifiers(Modifiers::SHIFT, Key::D));
        moves.iter().for_each(|key| press(&mut window, *key));
        window.state_mut().act_on(Subject::Object(0), Action::Rename("west".to_owned()));
        press(&mut window, Key::Escape);
        assert_eq!((description(&window).objects.len(), description(&window).objects[0].name.as_str()), (count + 1, "west"));
        (0..2).for_each(|_| undo(&mut window));
        assert!(!window.state().has_unsaved_changes(), "a copy and its move are one step");
    }
}

#[test]
fn selecting_another_part_ends_the_move_of_a_copy() {
    let mut window = window_with_ball();
    for (moves, least) in [(&[][..], 0.7), (&[Key::X, Key::Num2], 1.9)] {
        window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
        edits(&mut window, "the copy", |w| w.key_press_modifiers(Modifiers::SHIFT, Key::D));
        let copy = window.state().selection.object().expect("it is selected");
        moves.iter().for_each(|key| press(&mut window, *key));
        window.state_mut().pick(Some(Subject::Object(0)));
        assert_eq!(window.state().selection.object(), Some(0));
        let by = center(&window, copy).distance(center(&window, AMBER_BALL));
        assert!(by > least, "{by}: it does not lie in its original");
        undo(&mut window);
        assert!(!window.state().has_unsaved_changes(), "a copy and its move are one step");
    }
}

#[test]
fn a_copy_made_in_the_list_lies_beside_its_original() {
    let mut window = window("cornell_spheres");
    let start = center(&window, AMBER_BALL);
    edits(&mut window, "the copy", |w| w.state_mut().act_on(Subject::Object(AMBER_BALL), Action::Duplicate));
    let copy = window.state().selection.object().expect("it is selected");
    let by = center(&window, copy) - start;
    assert!(by.x.abs() > 2.0 * 0.38 && by.y == 0.0 && by.z == 0.0, "{by}");
    undo(&mut window);
    assert!(!window.state().has_unsaved_changes());
    window.state_mut().add(New::PunctualLight("point"));
    window.state_mut().act_on(Subject::PunctualLight(0), Action::Duplicate);
    let punctual_lights = &description(&window).punctual_lights;
    let [from, to] =
        [&punctual_lights[0], &punctual_lights[1]].map(|punctual_light| punctual_light.position().expect("it stands somewhere"));
    assert!(from.distance(to) > 0.05 && from.y == to.y);
    window.state_mut().act_on(Subject::Material("amber".to_owned()), Action::Duplicate);
    assert!(description(&window).materials.contains_key("amber 2"));
}

#[test]
fn keys_of_operations_cost_nothing_without_an_object_or_beside_the_picture() {
    let mut window = window("cornell_spheres");
    let tool = window.state().tool();
    let press_both = |w: &mut Window| [Key::G, Key::R].into_iter().for_each(|key| press(w, key));
    window.hover_at(Pos2::new(430.0, 430.0));
    window.run_steps(2);
    never_restarts(&mut window, press_both);
    window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
    window.event(egui::Event::PointerGone);
    window.run_steps(2);
    never_restarts(&mut window, press_both);
    assert_eq!((window.state().tool(), window.state().has_unsaved_changes()), (tool, false));
}
