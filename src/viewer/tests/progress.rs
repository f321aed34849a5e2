//! Renders that are kept, and continued.
use std::path::Path;

use noisefall_render::render::checkpoint::CheckpointFile;

use super::{exports::open_export, *};
use crate::viewer::background::progress_checkpoints::ProgressCheckpoints;

/// Whether the window continues the render of a file.
fn continues(window: &mut Window, file: &Path) {
    let seconds = CheckpointFile::open(file).expect("it is whole").header().counters.seconds;
    assert!(seconds > 0.0);
    wait(window, "the render", |app| app.opened().is_some() && app.status().spp > 0);
    let status = &window.state().status();
    assert!(status.elapsed.as_secs_f64() > seconds, "{:?} follows {seconds} s", status.elapsed);
    let session = &window.state().session;
    assert_eq!(session.camera.resolution, [96, 64]);
    let scene_has_its_own = session.opened.as_ref().is_some_and(|opened| opened.scene.camera != session.camera);
    assert!(scene_has_its_own, "by which it is tried what pixels share");
    assert!(window.state().dialogs.scene_error.is_none() && !window.state().has_unsaved_changes());
}

#[test]
fn a_render_that_was_saved_continues_when_its_file_is_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("spheres.nf");
    let mut window = window("cornell_spheres");
    wait(&mut window, "a while", |app| app.status().elapsed.as_secs_f64() > 0.5);
    open_export(&mut window, "Save checkpoint…");
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    click(&mut window, "Save");
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    drop(window);
    let mut window = open_with(Some(path.clone()), |_| {});
    continues(&mut window, &path);
}

#[test]
fn a_render_without_samples_or_by_another_name_is_not_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("furnace");
    open_export(&mut window, "Save checkpoint…");
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&folder.path().join("a.png").display().to_string());
    window.run_steps(3);
    click(&mut window, "Save");
    assert!(window.query_by_label_contains("The name must end in .nf.").is_some());
    press(&mut window, Key::Escape);
    window.state_mut().status_mut().spp = 0;
    assert!(window.state().render_to_keep().is_err());
}

#[test]
fn the_render_of_a_lost_window_is_offered_and_continues() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = |of: &Path| {
        let entries = std::fs::read_dir(of).into_iter().flatten().flatten().map(|entry| entry.path());
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "nf")).collect::<Vec<_>>()
    };
    let mut lost = window("cornell_spheres");
    let ctx = lost.state().ctx.clone();
    lost.state_mut().background.progress = ProgressCheckpoints::in_folder(&ctx, folder.path());
    lost.run_steps(2);
    let render = lost.state().render_to_keep().expect("it has samples");
    let (worker, elapsed) = (lost.state().worker().keep_handle(), lost.state().status().elapsed);
    lost.state_mut().background.progress.keep(render, worker, elapsed);
    wait(&mut lost, "the file", |_| files(folder.path()).len() == 1);
    drop(lost);
    let of_window = folder.path().to_owned();
    let with_keeper = move |app: &mut App| app.background.progress = ProgressCheckpoints::in_folder(&app.ctx, &of_window);
    let mut window = open_with(None, with_keeper);
    wait(&mut window, "the question", |app| app.dialogs.unfinished.is_some());
    window.run_steps(2);
    assert!(window.query_by_label_contains("Continue the render of “Cornell box of spheres” from").is_some());
    click(&mut window, "Continue render");
    wait(&mut window, "the scene", |app| !app.loader().is_busy() && app.camera().resolution == [96, 64]);
    continues(&mut window, &files(folder.path())[0]);
    // It goes when the window ends in order.
    let viewport = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    viewport.events.push(egui::ViewportEvent::Close);
    window.run_steps(2);
    assert!(files(folder.path()).is_empty());
}
