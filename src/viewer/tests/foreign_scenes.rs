//! Scenes of other programs in the window: remarks, saving, dropping.
use std::{path::Path as FilePath, sync::Arc};

use noisefall_formats::import::{Remark, Remarks};

use super::*;
use crate::viewer::dialogs::open::OpenDialog;

const TENT: &str = "v -0.5 0 0\nv 0.5 0 0.1\nv 0 0.75 -0.3\nf 1 2 3\n";

fn tent(folder: &FilePath) -> PathBuf {
    let path = folder.join("tent.obj");
    std::fs::write(&path, TENT).expect("it is written");
    path
}

fn is_open(window: &mut Window, path: &FilePath) {
    wait(window, "the scene", |app| app.session.path() == Some(path) && !app.loader().is_busy());
}

#[test]
fn remarks_are_counted_at_the_bottom_and_listed() {
    let mut window = window("furnace");
    assert!(window.query_by_label("2 remarks").is_none());
    let remark = |found: &str| Remark {
        place: "/a/long/way/a.xml:1:1".to_owned(),
        found: found.to_owned(),
        used: "plastic".to_owned(),
        effect: "it looks smooth".to_owned(),
    };
    let remarks: Remarks = ["`hair`", "`cloth`", "`hair`"].map(remark).into_iter().collect();
    window.state_mut().opened_mut().as_mut().expect("it is open").remarks = Arc::new(remarks);
    window.run_steps(2);
    click(&mut window, "2 remarks");
    assert!(window.state().dialogs.remarks);
    window.get_by_label("a.xml:1:1 and another place: “hair” → plastic: it looks smooth");
    window.get_by_label("a.xml:1:1: “cloth” → plastic: it looks smooth");
    press(&mut window, Key::Escape);
    assert!(!window.state().dialogs.remarks);
}

#[test]
fn saving_a_scene_of_another_program_goes_on_with_the_written_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = tent(folder.path());
    let mut window = open(Some(mesh.clone()));
    is_open(&mut window, &mesh);
    let kept = std::fs::read(&mesh).expect("it is there");
    window.state_mut().camera_mut().eye.x += 0.125;
    window.run_steps(2);
    let camera = window.state().camera();
    window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    assert!(window.state().dialogs.save.is_some(), "it asks for a name");
    let path = folder.path().join("new.toml");
    window.state_mut().dialogs.save = None;
    window.state_mut().save_scene_to(&path);
    is_open(&mut window, &path);
    let app = window.state();
    assert!(path.is_file() && !app.has_unsaved_changes() && app.dialogs.scene_error.is_none());
    assert_eq!(app.camera(), camera, "the view stays");
    assert_eq!(std::fs::read(&mesh).expect("it is there"), kept);
}

#[test]
fn a_mesh_that_is_dropped_while_a_scene_is_asked_for_is_the_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = tent(folder.path());
    let mut window = window("furnace");
    window.state_mut().dialogs.open = Some(OpenDialog::new(None, Vec::new()));
    drop_file(&mut window, mesh.clone());
    is_open(&mut window, &mesh);
    assert!(window.state().dialogs.open.is_none());
}

#[test]
fn a_scene_of_another_program_is_opened_again_when_its_file_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = tent(folder.path());
    let mut window = open_with(Some(mesh.clone()), App::use_disk);
    is_open(&mut window, &mesh);
    wait(&mut window, "the watch", |app| app.outside.watched.is_some());
    let corners = |app: &App| app.opened().as_ref().map(|opened| opened.scene.objects[0].shape.corners());
    let before = corners(window.state());
    std::fs::write(&mesh, TENT.replace("0.75", "1.5")).expect("it is written");
    wait(&mut window, "the changed mesh", move |app| corners(app) != before);
    assert!(window.state().dialogs.unsaved.is_none());
}

#[test]
fn it_is_opened_again_when_a_file_that_it_includes_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let (room, ball) = (folder.path().join("room.xml"), folder.path().join("ball.xml"));
    let write = |path: &FilePath, text: &str| std::fs::write(path, text).expect("it is written");
    let radius = |radius: f64| {
        format!("<scene version=\"3.0.0\"><shape type=\"sphere\"><float name=\"radius\" value=\"{radius}\"/></shape></scene>")
    };
    write(&ball, &radius(1.0));
    write(&room, "<scene version=\"3.0.0\"><include filename=\"ball.xml\"/></scene>");
    let mut window = open_with(Some(room.clone()), App::use_disk);
    is_open(&mut window, &room);
    wait(&mut window, "the watch", |app| app.outside.watched.is_some());
    let corners = |app: &App| app.opened().as_ref().map(|opened| opened.scene.objects[0].shape.corners());
    let before = corners(window.state());
    write(&ball, &radius(2.0));
    wait(&mut window, "the changed ball", move |app| corners(app) != before);
}
