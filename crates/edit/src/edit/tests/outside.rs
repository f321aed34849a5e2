//! Files that change outside, and what survives a crash.
use super::*;
use crate::edit::{History, Recovery};

#[track_caller]
fn compare(document: &Document, text: &str) -> crate::edit::Outside {
    let outside = document.compare_outside(text).unwrap_or_else(|error| panic!("{}", error.report()));
    outside.expect("the text is another one")
}

#[test]
fn outside_changes_of_camera_settings_and_scene_are_told_apart() {
    let document = room();
    assert!(document.compare_outside(ROOM).expect("it is readable").is_none());
    let told = |text: &str| {
        let outside = compare(&document, text);
        assert!(!outside.conflicts);
        (outside.camera_changed, outside.settings_changed, outside.scene_changed)
    };
    assert_eq!(told(&ROOM.replace("fov = 40", "fov = 41")), (true, false, false));
    assert_eq!(told(&format!("{ROOM}[render]\nspp = 9\n")), (false, true, false));
    assert_eq!(told(&ROOM.replace("0.34", "0.33")), (false, false, true));
    assert_eq!(told(&ROOM.replace("# A room.", "# The room.")), (false, false, false));
    let error = document.compare_outside(&ROOM.replace("fov = 40", "fov = 400")).expect_err("it is out of range");
    assert_eq!(error.line_column().map(|place| place.0), Some(8));
}

#[test]
fn taking_a_file_is_a_step() {
    let (mut document, mut history) = (room(), History::default());
    let changed = ROOM.replace("radius = 0.5", "radius = 0.4");
    let outside = compare(&document, &changed);
    document.take_outside(&mut history, outside).expect("it is valid");
    assert_eq!((document.text(), document.has_changes()), (changed.clone(), false));
    history.apply(&mut document, &number("camera.fov", 30.0)).expect("it is in range");
    assert_eq!(document.text(), changed.replace("fov = 40", "fov = 30"));
    history.undo(&mut document);
    history.undo(&mut document);
    assert_eq!((document.text().as_str(), document.has_changes()), (ROOM, true));
    history.redo(&mut document);
    assert!(!document.has_changes());
}

#[test]
fn both_sides_may_change() {
    let (mut document, mut history) = (room(), History::default());
    history.apply(&mut document, &number("camera.fov", 30.0)).expect("it is in range");
    let changed = ROOM.replace("radius = 0.5", "radius = 0.4");
    let outside = compare(&document, &changed);
    assert!(outside.conflicts && outside.scene_changed && !outside.camera_changed);
    document.keep_own(outside.text());
    assert!(document.has_changes() && document.text().contains("fov = 30"));
    assert!(document.compare_outside(&changed).expect("it is readable").is_none(), "it was compared");
    history.undo(&mut document);
    assert!(document.has_changes(), "the file is another one");
    // Equal changes on both sides are no conflict.
    let outside = compare(&document, ROOM);
    assert!(!outside.conflicts);
    document.take_outside(&mut history, outside).expect("it is valid");
    assert!(!document.has_changes());
}

#[test]
fn another_format_outside_keeps_the_changes() {
    let (mut document, mut history) = (room(), History::default());
    history.apply(&mut document, &Edit::remove(path("objects.0"))).expect("nothing needs it");
    let outside = compare(&document, &ROOM.replace("# at the door", "# inside"));
    assert!(!outside.conflicts);
    document.take_outside(&mut history, outside).expect("it is valid");
    let text = document.text();
    assert!(document.has_changes() && text.contains("# inside") && !text.contains("name = \"floor\""), "{text}");
}

#[test]
fn a_comment_from_outside_survives_undo_redo_and_saving() {
    let (mut document, mut history) = (room(), History::default());
    history.apply(&mut document, &number("camera.fov", 30.0)).expect("it is in range");
    let commented = ROOM.replace("# A room.", "# The room of a friend.");
    let outside = compare(&document, &commented);
    assert!(outside.is_format && !outside.conflicts);
    document.take_outside(&mut history, outside).expect("it is valid");
    assert_eq!(history.len(), 1, "it is no step");
    let edited = commented.replace("fov = 40", "fov = 30");
    assert_eq!((document.text(), document.has_changes()), (edited.clone(), true));
    history.undo(&mut document);
    assert_eq!((document.text(), document.has_changes()), (commented, false));
    history.redo(&mut document);
    assert_eq!((document.text(), document.has_changes()), (edited, true));
}

#[test]
fn changes_survive_a_crash() {
    let folder = tempfile::tempdir().expect("a folder");
    let [scene, file] = ["room.toml", "room.recovery"].map(|name| folder.path().join(name));
    assert_eq!(Recovery::read(&file).expect("there is none"), None);
    std::fs::write(&scene, ROOM).expect("it is written");
    let mut document = Document::open(&scene, ROOM).expect("it is valid");
    does(&mut document, &number("camera.fov", 30.0));
    Recovery::of(&document, None).write(&file).expect("it is written");
    let recovery = Recovery::read(&file).expect("it is readable").expect("it is there");
    assert_eq!(recovery, Recovery { path: Some(scene.clone()), origin: None, view: None, text: document.text() });
    let recovered = recovery.open().expect("it is valid");
    assert_eq!((recovered.path(), recovered.text(), recovered.has_changes()), (Some(&*scene), document.text(), true));
    assert!(recovered.compare_outside(ROOM).expect("it is readable").is_none(), "the file is as it was");
    // It is a scene file itself.
    let text = std::fs::read_to_string(&file).expect("it is there");
    assert_eq!(noisefall_scene::scene::describe("recovery", text).expect("it is valid"), *document.description());
    std::fs::write(&file, "format = 1\n").expect("it is written");
    assert!(Recovery::read(&file).is_err());
}

#[test]
fn a_scene_without_a_file_is_recovered_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("untitled.recovery");
    let document = Document::untitled(ROOM).expect("it is valid");
    Recovery::of(&document, None).write(&file).expect("it is written");
    let recovered = Recovery::read(&file).expect("it is readable").expect("it is there").open().expect("it is valid");
    assert_eq!((recovered.path(), recovered.text().as_str(), recovered.has_changes()), (None, ROOM, true));
    let text = std::fs::read_to_string(&file).expect("it is written");
    assert!(text.starts_with("# Unsaved changes of a scene without a file\n# A room."), "{text}");
}

#[test]
fn a_scene_of_another_program_is_recovered_with_its_origin() {
    let folder = tempfile::tempdir().expect("a folder");
    let [scene, file] = ["room.gltf", "room.recovery"].map(|name| folder.path().join(name));
    let mut document =
        Document::imported(&scene, ROOM, noisefall_scene::scene::describe("room", ROOM.to_owned()).expect("it is valid"));
    does(&mut document, &number("camera.fov", 30.0));
    Recovery::of(&document, None).write(&file).expect("it is written");
    let recovery = Recovery::read(&file).expect("it is readable").expect("it is there");
    assert_eq!((recovery.file(), &recovery.path), (Some(&*scene), &None));
    let mut recovered = recovery.open().expect("it is valid");
    assert_eq!((recovered.path(), recovered.origin(), recovered.has_changes()), (None, Some(&*scene), true));
    recovered.save(folder.path().join("room.toml")).expect("it is written");
    assert_eq!(recovered.origin(), None, "it has a file of its own");
}

#[test]
fn a_version_that_was_written_in_the_background_is_saved_and_later_ones_are_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("room.toml");
    let mut document = room();
    does(&mut document, &number("camera.fov", 30.0));
    let snapshot = document.clone();
    let back = does(&mut document, &number("camera.fov", 50.0));
    let written = snapshot.write(&file).expect("it is written");
    document.note_written(written);
    assert_eq!((document.path(), document.has_changes()), (Some(&*file), true));
    let text = std::fs::read_to_string(&file).expect("it is there");
    assert!(text.contains("fov = 30") && document.on_disk() == text);
    does(&mut document, &back);
    assert!(document.compare_outside(&text).expect("it is readable").is_none(), "it is our own");
    document.save(&file).expect("it is written");
    assert!(!document.has_changes());
}
