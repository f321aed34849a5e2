//! The keyboard belongs to one part of the window at a time, and nothing that is typed is lost.
use egui::Event;
use noisefall_render::render::view::View;

use super::*;
use crate::viewer::dialogs::unsaved::Leaving;

fn pressed(key: Key, modifiers: Modifiers) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
}

/// Events that come in one frame, as the window system gives them.
fn at_once(window: &mut Window, events: Vec<Event>) {
    let ctx = window.ctx.clone();
    let mut input = egui::RawInput { events, ..egui::RawInput::default() };
    loop {
        eframe::App::raw_input_hook(&mut **window.state_mut(), &ctx, &mut input);
        window.input_mut().events = std::mem::take(&mut input.events);
        window.step();
        if window.state().window.later_events.is_empty() {
            break;
        }
    }
    window.run_steps(3);
}

fn typed(text: &str) -> Vec<Event> {
    text.chars().map(|letter| Event::Text(letter.to_string())).collect()
}

/// The widget that has the keyboard.
fn focus(window: &Window) -> Option<egui::Id> {
    window.ctx.memory(egui::Memory::focused)
}

#[test]
fn a_number_keeps_its_last_digits_when_tab_or_a_press_comes_in_the_same_frame() {
    let mut window = window("furnace");
    window.state_mut().budget_mut().paused = true;
    let pos = Pos2::new(300.0, 300.0);
    let button = |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    let tab = vec![pressed(Key::Tab, Modifiers::NONE)];
    for (number, leaves) in [(240.0, tab), (360.0, vec![button(true), button(false)])] {
        window.get_all_by_role_and_label(Role::SpinButton, "Resolution").next().expect("there is such a field").click();
        window.run_steps(4);
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.run_steps(2);
        let mut events = typed(&f64::to_string(&number));
        events.extend(leaves);
        at_once(&mut window, events);
        assert_eq!(f64::from(window.state().camera().resolution[0]), number);
    }
}

#[test]
fn a_list_that_keys_open_closes_when_they_choose() {
    let mut window = window("furnace");
    let enter = |window: &mut Window, role, name: &str| {
        window.get_by_role_and_label(role, name).focus();
        window.run_steps(2);
        press(window, Key::Enter);
    };
    enter(&mut window, Role::ComboBox, "Tone map");
    assert!(egui::Popup::is_any_open(&window.ctx));
    enter(&mut window, Role::Button, "AgX");
    assert!(!egui::Popup::is_any_open(&window.ctx));
    assert_eq!(window.state().look().display.tone_map, ToneMap::Agx);
}

#[test]
fn a_question_has_the_keyboard_and_enter_gives_its_first_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, _) = scene_files::window_of_copy(folder.path());
    scene_files::grow(&mut window);
    window.get_all_by_role_and_label(Role::SpinButton, "Seed").next().expect("there is such a field").focus();
    window.run_steps(2);
    window.state_mut().ask_to_leave(Leaving::Open(Some(shipped("furnace"))));
    window.run_steps(4);
    let is_focused = |window: &Window, name: &str| window.get_by_label(name).accesskit_node().is_focused();
    assert!(is_focused(&window, "Save changes"));
    for name in ["Discard changes", "Cancel", "Save changes"] {
        // The button that closes the window is a step too.
        for _ in 0..2 {
            if !is_focused(&window, name) {
                press(&mut window, Key::Tab);
            }
        }
        assert!(is_focused(&window, name), "{name}");
    }
    press(&mut window, Key::Enter);
    assert!(window.state().dialogs.unsaved.is_none());
    wait(&mut window, "the file", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace"));
    assert!(std::fs::read_to_string(&path).expect("it is there").contains("radius = 0.25"));
}

#[test]
fn the_gallery_has_the_keyboard_and_begins_at_the_open_scene() {
    let mut window = window("furnace");
    window.key_press(Key::F6);
    window.run_steps(6);
    let card = |window: &Window, name: &str| window.get_by_role_and_label(Role::Button, name).accesskit_node().is_focused();
    assert!(card(&window, "Furnace"));
    let at = window.get_by_label("Open a file…").rect();
    assert!(at.bottom() < SIZE.y, "{at:?}");
    let eye = window.state().camera().eye;
    press(&mut window, Key::ArrowLeft);
    assert!(!card(&window, "Furnace") && focus(&window).is_some());
    assert_eq!(window.state().camera().eye, eye);
    press(&mut window, Key::Enter);
    wait(&mut window, "the card before it", |app| app.opened().as_ref().is_some_and(|opened| opened.name != "Furnace"));
}

#[test]
fn the_gallery_lies_where_it_stays_from_its_first_frame() {
    let mut window = window("furnace");
    window.key_press(Key::F6);
    window.run_steps(2);
    let place = |window: &Window| window.get_by_label("Open a file…").rect();
    let first = place(&window);
    window.run_steps(6);
    assert!((place(&window).center() - first.center()).length() < 1.0, "{first:?} {:?}", place(&window));
}

#[test]
fn escape_in_the_gallery_leaves_the_tour_behind_it_open() {
    let mut window = window("cornell_spheres");
    let last = crate::viewer::dialogs::tour::COUNT - 1;
    window.state_mut().dialogs.tour = Some(last);
    window.run_steps(3);
    click(&mut window, "Open the gallery");
    window.run_steps(4);
    press(&mut window, Key::Escape);
    assert_eq!((window.state().dialogs.gallery.open, window.state().dialogs.tour), (false, Some(last)));
    press(&mut window, Key::Escape);
    assert_eq!(window.state().dialogs.tour, None);
}

#[test]
fn keys_without_text_work_after_tab_has_reached_a_button() {
    let mut window = window("cornell_spheres");
    window.get_by_label("Fit").focus();
    window.run_steps(3);
    assert!(focus(&window).is_some());
    press(&mut window, Key::C);
    assert_eq!(window.state().tool(), Tool::Camera);
    let before = window.state().camera();
    window.key_down(Key::W);
    window.run_steps(3);
    window.key_up(Key::W);
    window.run_steps(1);
    assert_ne!(window.state().camera().eye, before.eye);
    press(&mut window, Key::Space);
    assert!(!window.state().budget().paused, "it pressed the button");
}

#[test]
fn a_quick_shift_v_goes_back_though_shift_is_up_when_the_frame_ends() {
    let mut window = window("furnace");
    let before = window.state().look().view;
    assert_eq!(before, View::Radiance);
    window.input_mut().events = vec![pressed(Key::V, Modifiers::SHIFT)];
    window.step();
    let back = window.state().look().view;
    window.input_mut().events = vec![pressed(Key::V, Modifiers::NONE)];
    window.step();
    assert_ne!(back, before);
    assert_eq!(window.state().look().view, before);
}

#[test]
fn a_path_that_is_typed_replaces_the_folder_that_open_begins_with() {
    let mut window = window("furnace");
    window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    window.run_steps(4);
    window.event(Event::Text("/elsewhere/a.toml".to_owned()));
    window.run_steps(3);
    assert_eq!(window.state().dialogs.open.as_ref().expect("it is open").form.field.path, "/elsewhere/a.toml");
}

#[test]
fn up_is_never_zero_and_home_keeps_the_resolution() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    set(&mut window, "Up", 1, 0.0);
    assert_eq!(window.state().camera().up, start.up);
    // The message is measured before it is shown.
    window.run_steps(2);
    assert!(window.query_by_label_contains("A direction must not be zero").is_some());
    window.state_mut().camera_mut().eye.x = 0.5;
    window.run_steps(3);
    press(&mut window, Key::Home);
    assert_eq!(window.state().camera(), start);
}

#[test]
fn a_part_that_is_added_has_the_normal_of_the_surface_that_was_clicked() {
    let mut window = window("cornell_spheres");
    window.state_mut().selection.clicked = Some([48, 62]);
    let [at, normal] = window.state().surface_at(None).expect("the floor is there");
    assert!(normal.distance(DVec3::Y) < 0.01 && at.y.abs() < 0.01, "{at} {normal}");
}
