//! Fields that are typed into: numbers, and paths of files.
use super::*;

/// Clicks into a field of numbers, the one of its name that has this place.
fn enter(window: &mut Window, label: &str, place: usize) {
    let field = window.get_all_by_role_and_label(Role::SpinButton, label).nth(place).expect("there is such a field");
    field.click();
    window.run_steps(4);
}

fn type_text(window: &mut Window, text: &str) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(3);
}

#[test]
fn a_field_that_is_only_looked_into_changes_nothing() {
    let mut window = window("cornell_spheres");
    let odd = DVec3::new(-0.123_456_789, 1.364_251, 12_345.678_912);
    restarts(&mut window, "an eye of many decimals", |w| {
        w.state_mut().camera_mut().eye = odd;
        w.state_mut().camera_mut().lens = Some(Lens { radius: 0.012_345_6, focus: 4.417_23 });
        w.state_mut().camera_mut().fov = 0.5;
        w.run_steps(3);
    });
    for (label, place) in [("Eye", 0), ("Eye", 1), ("Eye", 2), ("Lens radius", 0), ("Focus", 0), ("Seed", 0), ("Resolution", 0)] {
        for end in [Key::Escape, Key::Enter, Key::Tab] {
            never_restarts(&mut window, |w| {
                enter(w, label, place);
                w.key_press(end);
                w.run_steps(3);
            });
        }
    }
    never_restarts(&mut window, |w| {
        enter(w, "Eye", 1);
        enter(w, "Look at", 1);
        w.key_press(Key::Escape);
        w.run_steps(3);
    });
    assert_eq!((window.state().camera().eye, window.state().camera().fov), (odd, 0.5));
}

#[test]
fn a_typed_number_counts_when_it_is_entered_and_escape_gives_it_up() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        enter(w, "Eye", 1);
        type_text(w, "7.5");
        w.key_press(Key::Escape);
        w.run_steps(1);
        w.run_steps(3);
    });
    restarts(&mut window, "another eye", |w| {
        enter(w, "Eye", 1);
        type_text(w, "2.5");
        w.key_press(Key::Enter);
        w.run_steps(3);
    });
    assert_eq!(window.state().camera().eye.y, 2.5);
}

#[test]
fn arithmetic_counts_and_an_invalid_number_is_refused_until_the_next_press() {
    let mut window = window("cornell_spheres");
    let type_seed = |w: &mut Window, text: &str| {
        enter(w, "Seed", 0);
        type_text(w, text);
        w.key_press(Key::Enter);
        w.run_steps(3);
    };
    type_seed(&mut window, "3*7");
    assert_eq!(window.state().settings().seed, 21);
    never_restarts(&mut window, |w| type_seed(w, "3//7"));
    const REFUSAL: &str = "expected a number, found “3//7”";
    assert!(window.query_by_label(REFUSAL).is_some());
    click(&mut window, "Teaching");
    assert!(window.query_by_label(REFUSAL).is_none());
    assert_eq!(window.state().settings().seed, 21);
}

#[test]
fn escape_ends_the_message_of_a_field_before_the_selection() {
    let mut window = window("cornell_spheres");
    edited::select(&mut window, Subject::Object(selection::AMBER_BALL));
    enter(&mut window, "Radius r", 0);
    type_text(&mut window, "3//7");
    press(&mut window, Key::Enter);
    window.run_steps(3);
    let is_refused = |window: &Window| window.query_by_label_contains("expected a number, found “3//7”").is_some();
    assert!(is_refused(&window));
    press(&mut window, Key::Escape);
    window.run_steps(3);
    assert!(!is_refused(&window) && window.state().selection.object().is_some());
    press(&mut window, Key::Escape);
    assert!(window.state().selection.object().is_none());
}

#[test]
fn a_scene_can_be_opened_by_its_path() {
    let mut window = window("furnace");
    click(&mut window, "Open…");
    window.get_by_role(Role::TextInput).set_text_value_accesskit("/nowhere/at/all.toml");
    window.run_steps(3);
    click(&mut window, "Open");
    assert!(window.query_by_label_contains("There is no file").is_some());
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&shipped("bright_sky").display().to_string());
    window.run_steps(3);
    click(&mut window, "Open");
    assert!(window.state().dialogs.open.is_none());
    wait(&mut window, "the other scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name.starts_with("Bright sky")));
}

#[test]
fn a_picture_is_replaced_only_by_the_button_that_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shot.png");
    std::fs::write(&path, "what was there").expect("it is written");
    let mut window = window("furnace");
    *window.state_mut().last_saved_mut() = Some(path.clone());
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    let suggested = window.state().dialogs.save.as_ref().map(|dialog| dialog.path().to_owned());
    assert_eq!(suggested, Some(folder.path().join("shot-2.png").display().to_string()));
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    assert!(window.query_by_label("This file exists. Replace it?").is_some() && window.query_by_label("Save").is_none());
    window.get_by_role(Role::TextInput).focus();
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert!(window.state().dialogs.save.is_some(), "Enter replaces nothing");
    *window.state_mut().last_saved_mut() = None;
    click(&mut window, "Replace");
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    assert!(image_file::read(&path).is_ok());
}

#[test]
fn a_typed_name_replaces_the_suggested_one_and_enter_saves_after_a_click_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("furnace");
    *window.state_mut().last_saved_mut() = Some(folder.path().join("shot.exr"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    window.event(egui::Event::Text("mine".to_owned()));
    window.run_steps(3);
    let typed = window.state().dialogs.save.as_ref().map(|dialog| dialog.path().to_owned());
    assert_eq!(typed, Some(folder.path().join("mine").display().to_string()));
    let above = window.get_by_role(Role::TextInput).rect().center_top() - vec2(0.0, 10.0);
    click_at(&mut window, above);
    window.run_steps(3);
    *window.state_mut().last_saved_mut() = None;
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert!(window.state().dialogs.save.is_none());
    let path = folder.path().join("mine.png");
    wait(&mut window, "the file", |app| app.last_saved().as_ref() == Some(&path));
    assert!(image_file::read(&path).is_ok());
}
