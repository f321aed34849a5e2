//! Undo and redo.
use super::*;
use crate::edit::History;

#[test]
fn ten_thousand_edits_are_undone_and_redone() {
    const EDITS: usize = 10_000;
    let (mut document, mut history) = (room(), History::default());
    let fov = |place: usize| 20.0 + (place % 977) as f64 / 10.0;
    for place in 0..EDITS {
        history.apply(&mut document, &number("camera.fov", fov(place))).expect("it is in range");
    }
    assert_eq!(history.len(), EDITS);
    for place in (0..EDITS).rev() {
        assert_eq!(document.description().camera.fov, Some(fov(place)));
        assert!(history.undo(&mut document));
    }
    assert!(!history.undo(&mut document) && !document.has_changes());
    assert_eq!(document.text(), ROOM);
    for _ in 0..EDITS {
        assert!(history.redo(&mut document));
    }
    assert!(!history.redo(&mut document) && document.has_changes());
    assert_eq!(document.description().camera.fov, Some(fov(EDITS - 1)));
}

#[test]
fn a_drag_is_one_step() {
    let (mut document, mut history) = (room(), History::default());
    let drag = history.gesture();
    for step in 1..=100 {
        let both = Edit::All(vec![
            number("camera.lens.radius", f64::from(step) / 100.0),
            number("objects.1.shape.sphere.radius", 0.5 + f64::from(step) / 100.0),
        ]);
        history.drag(&mut document, &both, drag).expect("it is in range");
    }
    let next = history.gesture();
    history.drag(&mut document, &number("camera.fov", 10.0), next).expect("it is in range");
    // One edit of the drag stands for all.
    assert_eq!((history.len(), history.next_undo().map(|edit| edit.paths().len())), (2, Some(1)));
    history.undo(&mut document);
    assert_eq!(history.next_undo().map(|edit| edit.paths().len()), Some(2));
    history.undo(&mut document);
    assert_eq!((document.text().as_str(), document.has_changes()), (ROOM, false));
    history.redo(&mut document);
    assert_eq!(document.description().camera.lens.map(|lens| lens.radius), Some(1.0));
    // A step that was undone is not continued.
    history.drag(&mut document, &number("camera.fov", 11.0), drag).expect("it is in range");
    assert_eq!((history.len(), history.to_redo()), (2, None));
}

#[test]
fn a_drag_that_moves_is_one_step_too() {
    let (mut document, mut history) = (room(), History::default());
    let drag = history.gesture();
    for (from, to) in [(0, 1), (1, 2), (2, 1)] {
        history.drag(&mut document, &Edit::Move { path: path("objects").item(from), to }, drag).expect("there is such an object");
    }
    assert_eq!(document.description().objects[1].name, "floor");
    assert_eq!(history.len(), 1);
    history.undo(&mut document);
    assert_eq!(document.text(), ROOM);
}

#[test]
fn saving_marks_the_version() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("saved.toml");
    let (mut document, mut history) = (room(), History::default());
    history.apply(&mut document, &number("camera.fov", 30.0)).expect("it is in range");
    document.save(&file).expect("it is written");
    assert_eq!(std::fs::read_to_string(&file).expect("it is there"), document.text());
    assert_eq!((document.has_changes(), document.path(), document.folder()), (false, Some(&*file), folder.path()));
    history.undo(&mut document);
    assert!(document.has_changes());
    history.redo(&mut document);
    assert!(!document.has_changes());
    history.undo(&mut document);
    history.apply(&mut document, &number("camera.fov", 31.0)).expect("it is in range");
    assert!(document.has_changes() && !history.redo(&mut document));
}

#[test]
fn the_oldest_steps_are_forgotten() {
    let (mut document, mut history) = (room(), History::default());
    for place in 0..History::MOST + 5 {
        history.apply(&mut document, &number("camera.fov", 20.0 + (place % 100) as f64)).expect("it is in range");
    }
    assert_eq!(history.len(), History::MOST);
    while history.undo(&mut document) {}
    assert_eq!(document.description().camera.fov, Some(24.0));
}
