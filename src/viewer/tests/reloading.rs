//! Other programs change the files of the open scene.
use noisefall_scene::scene::description::SceneDescription;

use super::{
    scene_files::{grow, save, window_of_copy},
    *,
};

fn description(app: &App) -> &SceneDescription {
    app.editor.as_ref().expect("a scene is open").document.description()
}

/// Waits until what has changed is taken up, compiled and shown.
pub fn settle(window: &mut Window) {
    wait(window, "rest", |app| {
        let waits = app.worker().is_editing() || app.session.waiting_edit.is_some();
        let shown = app.shown_frame().as_ref().is_some_and(|frame| frame.generation == app.worker().generation());
        app.outside.is_settled() && app.saving.is_none() && !waits && shown
    });
    window.run_steps(2);
}

/// Writes a file as a text editor does, and reports it as the file system does.
pub fn write(window: &mut Window, path: &PathBuf, text: &str) {
    settle(window);
    std::fs::write(path, text).expect("it is written");
    window.state().background.files.report(path);
    window.run_steps(2);
    settle(window);
}

/// The text with a larger amber ball.
fn with_radius(text: &str, radius: &str) -> String {
    let ball = text.find("amber ball").expect("it is there");
    let (before, rest) = text.split_at(ball);
    let start = rest.find("radius = ").expect("it has one") + "radius = ".len();
    let end = start + rest[start..].find([' ', '}', '\n']).expect("it ends");
    format!("{before}{}{radius}{}", &rest[..start], &rest[end..])
}

fn radius(app: &App) -> f64 {
    let noisefall_scene::shape::ShapeKind::Sphere(ball) = &description(app).objects[5].shape else { panic!("it is a ball") };
    ball.radius
}

#[test]
fn a_change_by_another_program_is_shown_and_camera_and_settings_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    window.state_mut().camera_mut().eye.x = 0.5;
    window.state_mut().settings_mut().seed = 7;
    window.run_steps(2);
    let camera = window.state().camera();
    let before = generation(&window);
    write(&mut window, &path, &with_radius(&text, "0.21"));
    let app = window.state();
    assert_eq!((radius(app), app.has_unsaved_changes()), (0.21, false));
    assert!(generation(&window) > before && app.history.names()[0].as_deref() == Some("reload of the file"));
    assert_eq!((app.camera(), app.settings().seed), (camera, 7));
    let opened = app.opened().as_ref().expect("it is open");
    assert_eq!(&*opened.description, description(app), "the new scene is rendered");
    // Changes of the file are applied: the camera as a whole, without the resolution.
    let wider = with_radius(&text, "0.21").replace("fov = 36", "fov = 50");
    assert_ne!(wider, with_radius(&text, "0.21"));
    write(&mut window, &path, &wider);
    let app = window.state();
    assert_eq!((app.camera().fov, app.camera().eye.x, app.camera().resolution), (50.0, 0.0, [96, 64]));
    assert_eq!(app.settings().seed, 7);
    // Each reload is one step.
    undo(&mut window);
    settle(&mut window);
    assert_eq!((window.state().camera().fov, window.state().has_unsaved_changes()), (36.0, true));
    redo(&mut window);
    settle(&mut window);
    assert_eq!((window.state().camera().fov, window.state().has_unsaved_changes()), (50.0, false));
}

#[test]
fn a_comment_by_another_program_does_not_restart_the_render() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    let commented = format!("{text}\n# seen from outside\n");
    settle(&mut window);
    never_restarts(&mut window, |w| write(w, &path, &commented));
    assert!(!window.state().has_unsaved_changes());
    grow(&mut window);
    save(&mut window);
    assert!(std::fs::read_to_string(&path).expect("it is there").ends_with("# seen from outside\n"));
}

#[test]
fn an_error_is_shown_with_its_line_and_the_last_scene_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    settle(&mut window);
    let (start, before) = (radius(window.state()), generation(&window));
    let wrong = with_radius(&text, "'large'");
    let line = 1 + wrong[..wrong.find("'large'").expect("it is there")].matches('\n').count();
    write(&mut window, &path, &wrong);
    let error = window.state().dialogs.file_error.clone().expect("it is shown");
    assert!(error.contains(&format!("mine.toml:{line}:")), "{error}");
    assert!(window.query_by_label("This scene file cannot be reloaded").is_some());
    assert_eq!((radius(window.state()), generation(&window)), (start, before));
    let samples = window.state().status().samples;
    wait(&mut window, "more samples", |app| app.status().samples > samples);
    let unknown = format!("{text}\n[[objects]]\nmaterial = 'whit'\nshape.sphere = {{ center = [0, 0, 0], radius = 0.1 }}\n");
    write(&mut window, &path, &unknown);
    let error = window.state().dialogs.file_error.clone().expect("it is shown");
    let line = 1 + unknown[..unknown.find("'whit'").expect("it is there")].matches('\n').count();
    assert!(error.contains("whit") && error.contains(&format!("mine.toml:{line}:")), "{error}");
    // Names of nothing are found by the reader, files that are missing by the compiler: both have a line.
    let missing = format!(
        "{text}\n[textures.gone]\nimage = {{ path = 'gone.png' }}\n[materials.gone]\nlambertian.albedo = {{ texture = 'gone' }}\n[[objects]]\nname = 'last'\nmaterial = 'gone'\nshape.sphere = {{ center = [0, 0, 0], radius = 0.1 }}\n"
    );
    write(&mut window, &path, &missing);
    wait(&mut window, "the diagnosis", |app| app.dialogs.file_error.is_some());
    let error = window.state().dialogs.file_error.clone().expect("it is shown");
    let line = 1 + missing[..missing.find("'gone.png'").expect("it is there")].matches('\n').count();
    assert!(error.contains("gone.png") && error.contains(&format!("mine.toml:{line}:")), "{error}");
    assert_eq!(generation(&window), before);
    write(&mut window, &path, &with_radius(&text, "0.3"));
    assert_eq!((radius(window.state()), window.state().dialogs.file_error.as_ref()), (0.3, None));
}

/// A window with unsaved changes whose file was changed too.
fn conflict(folder: &std::path::Path) -> (Window, PathBuf, String) {
    let (mut window, path, text) = window_of_copy(folder);
    grow(&mut window);
    let outside = text.replace("fov = 36", "fov = 50");
    write(&mut window, &path, &outside);
    assert!(window.query_by_label_contains("was changed by another program").is_some());
    assert_eq!((radius(window.state()), window.state().camera().fov), (0.25, 36.0));
    (window, path, outside)
}

fn read(path: &PathBuf) -> String {
    std::fs::read_to_string(path).expect("it is there")
}

#[test]
fn in_a_conflict_the_scene_of_the_window_can_be_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, outside) = conflict(folder.path());
    click(&mut window, "Keep mine");
    settle(&mut window);
    assert!(window.state().dialogs.conflict.is_none() && window.state().has_unsaved_changes());
    assert_eq!(read(&path), outside, "nothing is written yet");
    save(&mut window);
    assert!(window.state().dialogs.conflict.is_none() && !window.state().has_unsaved_changes());
    assert!(read(&path).contains("radius = 0.25") && read(&path).contains("fov = 36"));
}

#[test]
fn in_a_conflict_the_file_can_be_used_and_undo_brings_the_changes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, outside) = conflict(folder.path());
    click(&mut window, "Use the file");
    settle(&mut window);
    let app = window.state();
    assert!(!app.has_unsaved_changes() && radius(app) != 0.25 && app.camera().fov == 50.0);
    assert_eq!(read(&path), outside);
    undo(&mut window);
    settle(&mut window);
    assert_eq!((radius(window.state()), window.state().camera().fov), (0.25, 36.0));
}

#[test]
fn in_a_conflict_the_scene_of_the_window_can_be_saved_under_another_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, outside) = conflict(folder.path());
    click(&mut window, "Save mine as…");
    assert!(window.state().dialogs.save.is_some());
    press(&mut window, Key::Escape);
    assert!(window.query_by_label("Save mine as…").is_some(), "without another name the question stays");
    click(&mut window, "Save mine as…");
    click(&mut window, "Save");
    settle(&mut window);
    let other = folder.path().join("mine-2.toml");
    assert_eq!((window.state().session.path(), window.state().has_unsaved_changes()), (Some(&*other), false));
    assert!(window.state().dialogs.conflict.is_none() && read(&other).contains("radius = 0.25"));
    assert_eq!(read(&path), outside);
}

#[test]
fn a_save_does_not_replace_a_change_that_was_not_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    settle(&mut window);
    grow(&mut window);
    for (outside, can_use) in [(text.replace("fov = 36", "fov = 50"), true), ("format = 1\ncamera = 3\n".to_owned(), false)] {
        std::fs::write(&path, &outside).expect("it is written");
        save(&mut window);
        settle(&mut window);
        assert!(window.state().dialogs.conflict.as_ref().is_some_and(|conflict| conflict.file.is_ok() == can_use));
        assert_eq!(read(&path), outside);
        press(&mut window, Key::Escape);
        assert!(window.state().dialogs.conflict.is_none() && window.state().has_unsaved_changes());
    }
    save(&mut window);
    click(&mut window, "Keep mine");
    settle(&mut window);
    assert!(!window.state().has_unsaved_changes() && read(&path).contains("radius = 0.25"));
}

#[test]
fn our_own_save_is_no_change_by_another_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, _) = window_of_copy(folder.path());
    grow(&mut window);
    settle(&mut window);
    never_restarts(&mut window, |w| {
        w.key_press_modifiers(Modifiers::COMMAND, Key::S);
        w.step();
        // The file system reports it before or after the window knows that the file is written.
        w.state().background.files.report(&path);
        w.run_steps(2);
        settle(w);
        w.state().background.files.report(&path);
        w.run_steps(2);
        settle(w);
    });
    assert!(!window.state().has_unsaved_changes() && window.state().history.names()[0].as_deref() != Some("reload of the file"));
    undo(&mut window);
    assert!(window.state().has_unsaved_changes() && radius(window.state()) == 0.38, "a save is no step");
}

#[test]
fn an_image_of_a_texture_is_read_again_when_it_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let image = folder.path().join("wall.png");
    let paint = |side: u32, level: u8| {
        ::image::RgbImage::from_pixel(side, side, ::image::Rgb([level; 3])).save(&image).expect("it is written");
    };
    paint(2, 200);
    let (mut window, path, text) = window_of_copy(folder.path());
    let textured = format!(
        "{text}\n[textures.wall]\nimage = {{ path = 'wall.png' }}\n[materials.wall]\nlambertian.albedo = {{ texture = 'wall' }}\n[[objects]]\nname = 'last'\nmaterial = 'wall'\nshape.sphere = {{ center = [0, 1, 0], radius = 0.3 }}\n"
    );
    write(&mut window, &path, &textured);
    assert_eq!(window.state().dialogs.file_error, None);
    let made = |window: &Window| window.state().opened().as_ref().expect("it is open").scene.compiled.made("images");
    let before = generation(&window);
    paint(4, 20);
    window.state().background.files.report(&image);
    window.run_steps(2);
    settle(&mut window);
    assert!(generation(&window) > before && made(&window) == 1 && !window.state().has_unsaved_changes());
}

#[test]
fn a_save_goes_on_after_a_comment_that_was_not_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, text) = window_of_copy(folder.path());
    settle(&mut window);
    grow(&mut window);
    std::fs::write(&path, format!("{text}\n# seen late\n")).expect("it is written");
    save(&mut window);
    settle(&mut window);
    assert!(!window.state().has_unsaved_changes());
    assert!(read(&path).contains("radius = 0.25") && read(&path).ends_with("# seen late\n"));
}

#[test]
fn a_scene_whose_file_was_removed_is_not_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, _) = window_of_copy(folder.path());
    settle(&mut window);
    std::fs::remove_file(&path).expect("it is there");
    window.state().background.files.report(&path);
    window.run_steps(2);
    settle(&mut window);
    assert!(window.state().has_unsaved_changes());
    assert!(window.state().dialogs.notices.0.iter().any(|notice| notice.text.contains("mine.toml was removed")));
    save(&mut window);
    settle(&mut window);
    assert!(!window.state().has_unsaved_changes() && path.is_file());
}
