//! The dialog that opens a scene lists the folder of the typed path, and completes it.
use super::*;

/// A folder with two scenes, a folder with a third, and a file that cannot be opened.
fn scenes() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    std::fs::create_dir(folder.path().join("rooms")).expect("it is made");
    for name in ["oven_one.toml", "oven_two.toml", "rooms/attic.toml", "oven.txt"] {
        std::fs::write(folder.path().join(name), &text).expect("it is written");
    }
    folder
}

fn text(window: &Window) -> String {
    window.state().dialogs.open.as_ref().expect("it is open").form.field.path.clone()
}

/// Opens the dialog, types a path, and waits for so many rows.
fn typed(window: &mut Window, path: &str, rows: usize) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).set_text_value_accesskit(path);
    listed(window, rows);
}

fn listed(window: &mut Window, rows: usize) {
    wait(window, "the list", |app| app.dialogs.open.as_ref().is_some_and(|dialog| dialog.form.lists(rows)));
    window.run_steps(2);
}

fn is_opened(window: &mut Window, path: &std::path::Path) {
    wait(window, "the scene", |app| app.session.path() == Some(path) && !app.loader().is_busy());
    assert!(window.state().dialogs.open.is_none());
}

#[test]
fn tab_completes_a_path_as_far_as_it_is_the_only_one() {
    let folder = scenes();
    let mut window = window("furnace");
    let path = |name: &str| folder.path().join(name).display().to_string();
    typed(&mut window, &path("ov"), 2);
    press(&mut window, Key::Tab);
    assert_eq!(text(&window), path("oven_"));
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&path("R"));
    listed(&mut window, 1);
    press(&mut window, Key::Tab);
    assert_eq!(text(&window), path("rooms/"), "a folder ends in a separator");
    listed(&mut window, 1);
    press(&mut window, Key::Tab);
    assert_eq!(text(&window), path("rooms/attic.toml"));
    press(&mut window, Key::Enter);
    is_opened(&mut window, &folder.path().join("rooms/attic.toml"));
}

#[test]
fn arrows_choose_from_the_list_and_enter_opens() {
    let folder = scenes();
    let mut window = window("furnace");
    typed(&mut window, &folder.path().join("").display().to_string(), 3);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::Enter);
    assert_eq!(text(&window), folder.path().join("rooms").join("").display().to_string(), "folders come first");
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&folder.path().join("oven").display().to_string());
    listed(&mut window, 2);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::Enter);
    is_opened(&mut window, &folder.path().join("oven_two.toml"));
    typed(&mut window, &folder.path().join("oven").display().to_string(), 2);
    click(&mut window, "oven_one.toml");
    is_opened(&mut window, &folder.path().join("oven_one.toml"));
}

#[test]
fn a_file_of_another_kind_is_refused_in_the_dialog() {
    let folder = scenes();
    let photo = folder.path().join("photo.jpg");
    std::fs::write(&photo, "not a scene").expect("it is written");
    let mut window = window("furnace");
    window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&photo.display().to_string());
    window.run_steps(3);
    press(&mut window, Key::Enter);
    let refusal = window.state().dialogs.open.as_ref().and_then(|dialog| dialog.form.field.refusal.clone());
    assert!(refusal.is_some_and(|refusal| refusal.starts_with("photo.jpg is not a scene")));
}
