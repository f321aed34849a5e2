//! Features of a desktop program: recent files, full screen, the clipboard, and white balance that can be reset.
use egui::{OutputCommand, ViewportCommand, ViewportId};
use noisefall_render::render::WhiteBalance;

use super::*;

/// Returns the next requests of the window to the system.
fn asked(window: &mut Window, what: &str) -> Vec<OutputCommand> {
    let start = Instant::now();
    loop {
        window.step();
        let commands = window.output().platform_output.commands.clone();
        if !commands.is_empty() {
            return commands;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "{what} never came");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn ctrl_c_copies_all_pixels_of_the_picture_as_a_png_has_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shot.png");
    let mut window = window("cornell_spheres");
    window.state_mut().look_mut().display.tone_map = ToneMap::Agx;
    window.state_mut().budget_mut().max_spp = Some(4);
    restarts(&mut window, "a restart", restart);
    wait(&mut window, "the last frame", |app| app.can_save() && app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 4));
    window.event(egui::Event::Copy);
    let commands = asked(&mut window, "the copy");
    let [OutputCommand::CopyImage(copied)] = &commands[..] else { panic!("{commands:?}") };
    window.run_steps(2);
    assert!(window.query_by_label("Copied the image, 96 × 64 pixels").is_some());
    window.state_mut().save_to(path.clone());
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    let saved = image::open(&path).expect("it is an image").into_rgba8();
    assert_eq!(copied.size, [96, 64]);
    let differing = copied.as_raw().iter().zip(saved.as_raw()).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 0);
}

#[test]
fn while_a_message_is_open_ctrl_c_copies_it() {
    let mut window = window("furnace");
    for text in ["an error", "the last error"] {
        window.state_mut().tell(text.to_owned(), true);
    }
    window.state_mut().tell("good news".to_owned(), false);
    let copied = |window: &mut Window| {
        window.event(egui::Event::Copy);
        let commands = asked(window, "the text");
        let [OutputCommand::CopyText(text)] = &commands[..] else { panic!("{commands:?}") };
        text.clone()
    };
    assert_eq!(copied(&mut window), "the last error");
    window.state_mut().dialogs.scene_error = Some("a report".to_owned());
    assert_eq!(copied(&mut window), "a report");
}

#[test]
fn in_text_ctrl_c_belongs_to_the_text() {
    let mut window = window("furnace");
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).focus();
    window.run_steps(2);
    window.event(egui::Event::Copy);
    window.run_steps(3);
    assert!(window.state().background.copying.is_none());
}

#[test]
fn f11_asks_for_the_full_screen_and_for_the_way_back() {
    let mut window = window("furnace");
    for is_full in [false, true] {
        window.input_mut().viewports.entry(ViewportId::ROOT).or_default().fullscreen = Some(is_full);
        // A step draws a frame for each event, and shows what the last one asked for.
        window.key_down(Key::F11);
        window.step();
        let commands = &window.output().viewport_output[&ViewportId::ROOT].commands;
        let asked: Vec<_> = commands.iter().filter(|command| matches!(command, ViewportCommand::Fullscreen(_))).collect();
        assert_eq!(asked, [&ViewportCommand::Fullscreen(!is_full)]);
        window.key_up(Key::F11);
        window.step();
    }
}

#[test]
fn f11_twice_is_no_change_even_if_the_window_has_not_followed_yet_and_a_held_key_is_one_press() {
    let mut window = window("furnace");
    window.input_mut().viewports.entry(ViewportId::ROOT).or_default().fullscreen = Some(false);
    let mut asked = Vec::new();
    for (pressed, repeat) in [(true, false), (true, true), (false, false), (true, false), (false, false)] {
        let modifiers = Modifiers::NONE;
        window.event(egui::Event::Key { key: Key::F11, physical_key: None, pressed, repeat, modifiers });
        window.step();
        let commands = &window.output().viewport_output[&ViewportId::ROOT].commands;
        asked.extend(commands.iter().filter_map(|command| match command {
            ViewportCommand::Fullscreen(is_full) => Some(*is_full),
            _ => None,
        }));
    }
    assert_eq!(asked, [true, false]);
}

#[test]
fn recent_files_are_listed_opened_and_disabled_when_they_are_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    let [mine, gone] = ["mine.toml", "gone.toml"].map(|name| {
        let path = folder.path().join(name);
        std::fs::write(&path, &text).expect("it is written");
        path.canonicalize().expect("it is there")
    });
    let mut window = window("cornell_spheres");
    window.state_mut().preferences = Preferences::in_folder(&folder.path().join("preferences"));
    for path in [&mine, &gone, &shipped("bright_sky")] {
        window.state_mut().loader_mut().open(Some(path.clone()));
        let path = Some(path.clone());
        wait(&mut window, "the scene", |app| app.opened().as_ref().is_some_and(|opened| opened.path == path));
    }
    let recent = window.state().preferences.now.recent.clone();
    assert_eq!(recent, [shipped("bright_sky").canonicalize().expect("it is shipped"), gone.clone(), mine.clone()]);
    std::fs::remove_file(&gone).expect("it was there");
    click(&mut window, "Open…");
    let row = |window: &Window, name: &str| {
        let rows = window.query_all_by_role(Role::Button);
        rows.map(|row| row.accesskit_node().label().unwrap_or_default()).find(|label| label.starts_with(name))
    };
    let labels = ["mine.toml", "gone.toml"].map(|name| row(&window, name).expect("it is listed"));
    assert!(window.get_by_label(&labels[1]).accesskit_node().is_disabled());
    click(&mut window, &labels[0]);
    wait(&mut window, "my scene", |app| app.opened().as_ref().is_some_and(|opened| opened.path.as_ref() == Some(&mine)));
    assert!(window.state().dialogs.open.is_none());
    assert_eq!(window.state().preferences.now.recent[0], mine);
    drop(window);
    assert_eq!(Preferences::in_folder(&folder.path().join("preferences")).now.recent[0], mine, "they are kept");
}

#[test]
fn white_balance_has_a_way_back_to_neutral_and_never_restarts() {
    let mut window = window("cornell_spheres");
    let balance = |window: &Window| window.state().look().display.white_balance;
    assert_eq!(balance(&window), WhiteBalance::NEUTRAL);
    never_restarts(&mut window, |w| {
        set(w, "White balance", 0, 3000.0);
        set(w, "White balance", 1, 12.0);
    });
    assert_eq!(balance(&window), WhiteBalance { kelvin: 3000.0, tint: 12.0 });
    never_restarts(&mut window, |w| click(w, "Neutral"));
    assert_eq!(balance(&window), WhiteBalance::NEUTRAL);
    undo(&mut window);
    assert_eq!(balance(&window).kelvin, 3000.0, "it can be undone");
    window.state_mut().loader_mut().open(Some(shipped("furnace")));
    wait(&mut window, "another scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace"));
    assert_eq!(balance(&window), WhiteBalance::NEUTRAL, "what suited the other scene");
}
