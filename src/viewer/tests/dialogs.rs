//! One dialog is in front and has the keys; what only tells something makes room for a command.
use super::*;
use crate::viewer::app::front::FrontDialog;

type Opens = fn(&mut Window);

/// Returns the values that a key of the window would change behind a dialog.
fn behind(window: &Window) -> (Tool, bool, f32, Option<super::super::instruments::tabs::InstrumentTab>, u64) {
    let app = window.state();
    (app.tool(), app.budget().paused, app.look().display.exposure, app.tab(), generation(window))
}

/// The place of a dialog.
fn place(window: &Window, text: &str) -> egui::Rect {
    let places = window.query_all_by_label(text).map(|node| node.rect());
    places.max_by(|a, b| a.height().total_cmp(&b.height())).expect("it is open")
}

#[test]
fn no_key_reaches_the_window_behind_a_dialog() {
    let dialogs: [(&str, Opens); 5] = [
        ("help", |w| press(w, Key::F1)),
        ("gallery", |w| press(w, Key::F6)),
        ("open", |w| {
            w.key_press_modifiers(Modifiers::COMMAND, Key::O);
            w.run_steps(3);
        }),
        ("a question", |w| w.state_mut().dialogs.unsaved = Some(super::super::dialogs::unsaved::Leaving::Open(None))),
        ("an error", |w| w.state_mut().dialogs.scene_error = Some("It cannot be read.".to_owned())),
    ];
    let mut window = window("cornell_spheres");
    for (name, opens) in dialogs {
        opens(&mut window);
        window.run_steps(3);
        let (front, before, camera) = (window.state().front(), behind(&window), window.state().camera());
        assert!(front.is_some(), "{name}");
        for key in [Key::C, Key::B, Key::F2, Key::F4, Key::V, Key::CloseBracket, Key::W, Key::Home, Key::Period] {
            press(&mut window, key);
            assert_eq!((window.state().front(), behind(&window)), (front, before), "{name}: {key:?}");
        }
        assert_eq!(window.state().camera(), camera, "{name}");
        press(&mut window, Key::Escape);
        assert_eq!(window.state().front(), None, "{name}");
    }
}

#[test]
fn dialogs_do_not_stack() {
    let mut window = window("cornell_spheres");
    press(&mut window, Key::F1);
    press(&mut window, Key::F6);
    assert_eq!(window.state().front(), Some(FrontDialog::Gallery));
    assert!(!window.state().dialogs.help && window.query_by_label("fly down, up").is_none());
    press(&mut window, Key::F1);
    assert_eq!((window.state().front(), window.state().dialogs.gallery.open), (Some(FrontDialog::Help), false));
    // A question that comes meanwhile waits for the form that is open.
    press(&mut window, Key::Escape);
    window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    window.run_steps(3);
    window.state_mut().dialogs.scene_error = Some("It cannot be read.".to_owned());
    window.run_steps(3);
    assert!(window.query_by_label("This scene cannot be opened").is_none());
    press(&mut window, Key::Escape);
    assert!(window.query_by_label("This scene cannot be opened").is_some());
}

#[test]
fn an_error_makes_room_for_the_next_scene() {
    let mut window = window("cornell_spheres");
    window.state_mut().dialogs.scene_error = Some("It cannot be read.".to_owned());
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    window.run_steps(3);
    assert_eq!((window.state().front(), &window.state().dialogs.scene_error), (Some(FrontDialog::Open), &None));
}

#[test]
fn tab_does_not_leave_a_form() {
    let mut window = window("cornell_spheres");
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    let inside = place(&window, "Save image").expand(300.0);
    for _ in 0..12 {
        press(&mut window, Key::Tab);
        let focused = window.root().children_recursive().find(|node| node.accesskit_node().is_focused());
        let focused = focused.map(|node| node.rect());
        assert!(focused.is_none_or(|rect| inside.contains_rect(rect) && rect.right() < 940.0), "{focused:?}");
    }
    assert!(!window.state().budget().paused);
}

#[test]
fn a_later_scene_proposes_its_own_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("furnace");
    wait(&mut window, "a full image", App::can_save);
    window.state_mut().save_to(folder.path().join("first.png"));
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    window.state_mut().loader_mut().open(Some(shipped("bright_sky")));
    let path = Some(shipped("bright_sky"));
    wait(&mut window, "the other scene", |app| app.opened().as_ref().is_some_and(|opened| opened.path == path));
    window.state_mut().open_save_dialog(super::super::dialogs::save_target::SaveTarget::Picture);
    let proposed = window.state().dialogs.save.as_ref().expect("it is open").path().to_owned();
    assert_eq!(PathBuf::from(proposed), folder.path().join("bright_sky.png"));
}

#[test]
fn the_tour_explains_glass_where_there_is_some_and_its_card_can_be_moved() {
    let mut window = window("cornell_spheres");
    window.state_mut().dialogs.tour = Some(3);
    window.run_steps(4);
    assert!(window.query_by_label_contains("The glass focuses light to a caustic.").is_none());
    let card = |window: &Window| window.get_by_label("4 of 5").rect().min;
    let (before, bar) = (card(&window), place(&window, "Tour").center_top() + vec2(0.0, 16.0));
    drag(&mut window, PointerButton::Primary, bar.into(), (bar + vec2(150.0, 80.0)).into());
    window.run_steps(2);
    assert!((card(&window) - before - vec2(150.0, 80.0)).length() < 4.0, "{before:?} {:?}", card(&window));
    click(&mut window, "Open a scene with glass");
    wait(&mut window, "the glass ball", |app| {
        app.session
            .opened
            .as_ref()
            .is_some_and(|opened| opened.path.as_ref().is_some_and(|path| path.ends_with("glass_ball_caustic.toml")))
    });
    window.run_steps(4);
    assert!(window.query_by_label_contains("The glass focuses light to a caustic.").is_some());
}
