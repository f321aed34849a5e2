//! Unsaved changes survive the end of the program.
use std::path::Path;

use super::{
    scene_files::{grow, save, window_of_copy},
    *,
};
use crate::viewer::background::recovery_keeper::RecoveryKeeper;

/// The recovery files in a folder, without locks.
fn kept(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

/// A window on a file, which keeps its changes in a folder.
fn reopened(path: Option<PathBuf>, folder: &Path) -> Window {
    let folder = folder.to_owned();
    let mut window = open_with(path, move |app| app.background.recovery = RecoveryKeeper::in_folder(&folder));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [96, 64];
    window
}

/// A window with unsaved changes that is lost. Returns its scene file.
fn lose(folder: &Path, kept_in: &Path) -> PathBuf {
    let (mut window, path, _) = window_of_copy(folder);
    window.state_mut().background.recovery = RecoveryKeeper::in_folder(kept_in);
    grow(&mut window);
    wait(&mut window, "the recovery file", |_| kept(kept_in).len() == 1);
    path
}

fn radius(window: &Window) -> f64 {
    let description = window.state().editor.as_ref().expect("a scene is open").document.description();
    let noisefall_scene::shape::ShapeKind::Sphere(ball) = &description.objects[5].shape else { panic!("it is a ball") };
    ball.radius
}

#[test]
fn changes_of_a_lost_window_are_offered_and_restored() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept_in = folder.path().join("recovery");
    let path = lose(folder.path(), &kept_in);
    // At the next opening, and once more after "later"; in a window without a scene too.
    for start in [Some(path.clone()), None] {
        let mut window = reopened(start, &kept_in);
        wait(&mut window, "the question", |app| app.dialogs.recovery.is_some());
        window.run_steps(2);
        assert!(window.query_by_label_contains("Restore unsaved changes of “mine” from").is_some());
        press(&mut window, Key::Escape);
        assert!(window.state().dialogs.recovery.is_none() && kept(&kept_in).len() == 1);
    }
    let mut window = reopened(Some(path.clone()), &kept_in);
    wait(&mut window, "the question", |app| app.dialogs.recovery.is_some());
    window.run_steps(2);
    let before = kept(&kept_in);
    click(&mut window, "Restore changes");
    wait(&mut window, "the changes", |app| app.has_unsaved_changes() && !app.loader().is_busy());
    assert_eq!((radius(&window), window.state().session.path()), (0.25, Some(&*path)));
    wait(&mut window, "a file of this window", |_| kept(&kept_in).len() == 1 && kept(&kept_in) != before);
    save(&mut window);
    assert!(std::fs::read_to_string(&path).expect("it is there").contains("radius = 0.25"));
    wait(&mut window, "no file", |_| kept(&kept_in).is_empty());
}

#[test]
fn the_view_comes_back_with_the_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept_in = folder.path().join("recovery");
    let (mut window, path, _) = window_of_copy(folder.path());
    window.state_mut().background.recovery = RecoveryKeeper::in_folder(&kept_in);
    grow(&mut window);
    let session = &mut window.state_mut().session;
    session.camera.eye.x += 0.125;
    (session.settings.seed, session.look.display.exposure) = (7, 1.5);
    let camera = session.camera;
    let holds_view = |file: &PathBuf| std::fs::read_to_string(file).is_ok_and(|text| text.contains("\"exposure\":1.5"));
    wait(&mut window, "the view in the file", |_| kept(&kept_in).iter().any(holds_view));
    drop(window);
    let mut window = reopened(Some(path), &kept_in);
    wait(&mut window, "the question", |app| app.dialogs.recovery.is_some());
    window.run_steps(2);
    click(&mut window, "Restore changes");
    wait(&mut window, "the changes", |app| app.has_unsaved_changes() && !app.loader().is_busy());
    let session = &window.state().session;
    assert_eq!((session.camera, session.settings.seed, session.look.display.exposure), (camera, 7, 1.5));
}

#[test]
fn changes_that_are_discarded_are_not_offered_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept_in = folder.path().join("recovery");
    let path = lose(folder.path(), &kept_in);
    let mut window = reopened(Some(path), &kept_in);
    wait(&mut window, "the question", |app| app.dialogs.recovery.is_some());
    window.run_steps(2);
    click(&mut window, "Discard changes");
    wait(&mut window, "no file", |_| kept(&kept_in).is_empty());
    assert!(!window.state().has_unsaved_changes());
}

#[test]
fn the_recovery_file_goes_with_the_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept_in = folder.path().join("recovery");
    let (mut window, _, _) = window_of_copy(folder.path());
    window.state_mut().background.recovery = RecoveryKeeper::in_folder(&kept_in);
    let appears = |window: &mut Window| wait(window, "the recovery file", |_| kept(&kept_in).len() == 1);
    let goes = |window: &mut Window| wait(window, "no file", |_| kept(&kept_in).is_empty());
    grow(&mut window);
    appears(&mut window);
    undo(&mut window);
    goes(&mut window);
    redo(&mut window);
    appears(&mut window);
    save(&mut window);
    goes(&mut window);
    undo(&mut window);
    appears(&mut window);
    // Discarded on quitting.
    let viewport = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    viewport.events.push(egui::ViewportEvent::Close);
    window.run_steps(2);
    click(&mut window, "Discard changes");
    drop(window);
    assert!(kept(&kept_in).is_empty());
}
