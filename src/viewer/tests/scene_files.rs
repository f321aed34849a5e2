//! The edited scene is saved, and unsaved changes are not lost without a question.
use std::path::Path as FilePath;

use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Edit;

use super::{
    edited::description,
    selection::{ball, seen},
    *,
};
use crate::viewer::dialogs::unsaved::Leaving;

/// A window with a scene of its own that may be written to.
pub fn window_of_copy(folder: &FilePath) -> (Window, PathBuf, String) {
    let path = folder.join("mine.toml");
    let text = std::fs::read_to_string(shipped("cornell_spheres")).expect("it is shipped");
    std::fs::write(&path, &text).expect("it is written");
    let mut window = open(Some(path.clone()));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [96, 64];
    wait(&mut window, "an image", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 96));
    (window, path, text)
}

pub fn grow(window: &mut Window) {
    let edit = Edit::set(Path::of("objects.5.shape.sphere.radius"), OwnedValue::Number(0.25));
    assert!(window.state_mut().edit(&edit));
    window.run_steps(3);
}

pub fn save(window: &mut Window) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    is_written(window);
}

/// Waits until the file is written.
fn is_written(window: &mut Window) {
    wait(window, "the end of saving", |app| app.saving.is_none());
    window.run_steps(2);
}

#[test]
fn saving_writes_the_changed_line_and_no_other_and_the_title_marks_unsaved_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    let title = |window: &Window| window.state().window.title.clone();
    assert!(title(&window).starts_with("Cornell box of spheres") && !title(&window).contains('•'));
    grow(&mut window);
    assert!(title(&window).starts_with("Cornell box of spheres (mine.toml) • "), "{}", title(&window));
    save(&mut window);
    assert!(!title(&window).contains('•'));
    let saved = std::fs::read_to_string(&path).expect("it is there");
    let changed: Vec<_> = text.lines().zip(saved.lines()).filter(|(before, after)| before != after).collect();
    assert_eq!(changed.len(), 1, "{changed:?}");
    assert!(changed[0].1.contains("radius = 0.25"), "{changed:?}");
    assert_eq!(text.lines().count(), saved.lines().count());
    assert!(window.state().dialogs.save.is_none());
    // To before the file as it is now.
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(3);
    assert!(title(&window).contains('•'));
    save(&mut window);
    assert_eq!(std::fs::read_to_string(&path).expect("it is there"), text);
}

#[test]
fn saving_a_scene_with_an_error_says_that_it_cannot_be_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, _) = window_of_copy(folder.path());
    let missing = Edit::set(Path::of("materials.amber.normal_map"), OwnedValue::Text("nowhere.png".to_owned()));
    assert!(window.state_mut().edit(&missing));
    wait(&mut window, "the error", |app| !app.shows_document());
    save(&mut window);
    let says = |window: &Window, what: &str| window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains(what));
    assert!(says(&window, &format!("Saved {}. The scene has an error", path.display())));
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    wait(&mut window, "the scene before", |app| app.shows_document() && !app.is_compiling());
    save(&mut window);
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.text == format!("Saved {}", path.display())));
}

#[test]
fn the_view_of_the_window_is_saved_when_the_scene_is_given_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    window.state_mut().camera_mut().resolution = [720, 720];
    window.state_mut().camera_mut().eye.x = 0.5;
    window.run_steps(2);
    assert!(!window.state().has_unsaved_changes(), "a move of the camera changes no scene");
    let moved = window.state().camera();
    window.state_mut().use_view();
    save(&mut window);
    let saved = std::fs::read_to_string(&path).expect("it is there");
    assert_eq!(saved, text.replace("eye = [0.0, 1.0, 4.0]", "eye = [0.5, 1.0, 4.0]"));
    wait(&mut window, "the edit", |app| app.session.waiting_edit.is_none() && !app.worker().is_editing());
    assert_eq!(window.state().camera(), moved);
}

#[test]
fn a_scene_without_a_file_asks_where_to_save() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(None);
    wait(&mut window, "the scene", |app| app.opened().is_some());
    grow(&mut window);
    save(&mut window);
    assert!(window.state().dialogs.save.is_some());
    let path = folder.path().join("new.toml");
    window.state_mut().dialogs.save = None;
    window.state_mut().save_scene_to(&path);
    is_written(&mut window);
    assert!(!window.state().has_unsaved_changes() && path.is_file());
    assert_eq!(window.state().session.path(), Some(&*path));
    grow(&mut window);
    assert!(window.state().has_unsaved_changes());
    save(&mut window);
    assert!(!window.state().has_unsaved_changes() && window.state().dialogs.save.is_none(), "now it has a file");
    window.state_mut().save_scene_to(&folder.path().join("nowhere/new.toml"));
    is_written(&mut window);
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.is_error));
}

#[test]
fn a_scene_that_names_files_stays_in_their_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("textures_and_bump");
    let path = folder.path().join("elsewhere.toml");
    window.state_mut().save_scene_to(&path);
    is_written(&mut window);
    assert!(!path.exists() && window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains("relative file paths")));
}

#[test]
fn another_scene_is_opened_after_a_question_if_changes_are_unsaved() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    let furnace = || Leaving::Open(Some(shipped("furnace")));
    grow(&mut window);
    let asks = |window: &mut Window, answer: &str| {
        window.state_mut().ask_to_leave(furnace());
        window.run_steps(3);
        assert!(window.query_by_label_contains("has changes that are not saved").is_some());
        click(window, answer);
        assert!(window.state().dialogs.unsaved.is_none());
    };
    asks(&mut window, "Cancel");
    assert!(!window.state().loader().is_busy() && window.state().has_unsaved_changes());
    asks(&mut window, "Discard changes");
    let is_furnace = |app: &App| app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace");
    wait(&mut window, "the other scene", is_furnace);
    assert_eq!(std::fs::read_to_string(&path).expect("it is there"), text);
    window.state_mut().ask_to_leave(Leaving::Open(Some(path.clone())));
    assert!(window.state().dialogs.unsaved.is_none(), "nothing is unsaved");
    wait(&mut window, "the first scene", |app| !is_furnace(app));
    grow(&mut window);
    asks(&mut window, "Save changes");
    wait(&mut window, "the other scene", is_furnace);
    assert!(std::fs::read_to_string(&path).expect("it is there").contains("radius = 0.25"));
}

#[test]
fn closing_the_window_asks_about_unsaved_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, _, _) = window_of_copy(folder.path());
    let close = |window: &mut Window| {
        let viewport = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
        viewport.events.push(egui::ViewportEvent::Close);
        window.step();
        let commands = &window.output().viewport_output[&egui::ViewportId::ROOT].commands;
        commands.contains(&egui::ViewportCommand::CancelClose)
    };
    assert!(!close(&mut window) && window.state().dialogs.unsaved.is_none());
    window.run_steps(2);
    grow(&mut window);
    assert!(close(&mut window) && window.state().dialogs.unsaved.is_some());
    window.run_steps(2);
    click(&mut window, "Discard changes");
    assert!(window.state().window.quits);
}

#[test]
fn the_exact_solution_of_a_scene_is_not_that_of_an_edited_one() {
    let mut window = window("furnace");
    assert!(window.state().exact_solution().is_some());
    let edit = Edit::set(Path::of("title"), OwnedValue::Text("Another".to_owned()));
    assert!(window.state_mut().edit(&edit) && window.state().exact_solution().is_none());
    window.state_mut().undo_edit();
    assert!(window.state().exact_solution().is_some());
}

#[test]
fn a_new_scene_begins_from_a_template() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Edit");
    click(&mut window, "New scene");
    click(&mut window, "Studio");
    wait(&mut window, "the studio", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Studio"));
    assert!(window.state().session.path().is_none() && !window.state().has_unsaved_changes());
}

/// Without a word to the file, which this test must not change if it fails: the question is all that the key may do.
#[test]
fn a_scene_that_comes_with_the_program_asks_for_a_file_of_its_own() {
    let before = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    let mut window = window("furnace");
    let edit = Edit::set(Path::of("title"), OwnedValue::Text("Another".to_owned()));
    assert!(window.state_mut().edit(&edit));
    window.state_mut().save_scene();
    assert!(window.state().saving.is_none(), "nothing is written");
    let suggested = window.state().dialogs.save.as_ref().map(|dialog| dialog.path().to_owned());
    assert_eq!(suggested, Some(shipped("furnace-2").display().to_string()));
    window.state_mut().dialogs.save = None;
    window.state_mut().ask_to_leave(Leaving::Open(None));
    window.run_steps(3);
    click(&mut window, "Save changes");
    assert!(window.state().dialogs.save.is_some() && window.state().saving.is_none());
    assert_eq!(std::fs::read_to_string(shipped("furnace")).expect("it is shipped"), before);
}

#[test]
fn a_new_scene_is_saved_under_its_title() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Edit");
    click(&mut window, "New scene");
    click(&mut window, "Studio");
    wait(&mut window, "the studio", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Studio"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    assert!(window.state().dialogs.save.as_ref().is_some_and(|dialog| dialog.path().ends_with("studio.toml")));
}

#[test]
fn saving_says_that_the_view_is_left_out_and_can_keep_it() {
    let mut window = window("cornell_spheres");
    window.state_mut().camera_mut().eye.y += 0.1;
    let eye = window.state().camera().eye;
    window.run_steps(2);
    let at = seen(&mut window, ball());
    window.state_mut().ask_where_to_save();
    window.run_steps(3);
    // The dialog has the mouse too.
    click_at(&mut window, at);
    assert_eq!(window.state().selected(), None);
    check_box(&mut window, "Save this view as the scene's camera");
    window.state_mut().keep_view();
    assert_eq!(description(&window).camera.eye, eye);
    let resolution = description(&window).camera.resolution;
    assert_ne!(resolution, [96, 64], "the resolution is no part of the view");
    window.run_steps(2);
    wait(&mut window, "the scene with this view", |app| !app.session.view_differs());
}
