//! The list of scenes, black images, and images that cannot be rendered.
use super::*;
use crate::viewer::panels::{panel_tabs::PanelTab, subject::Subject};

/// A file of a scene in which this is replaced by that.
fn changed(folder: &tempfile::TempDir, scene: &str, this: &str, that: &str) -> PathBuf {
    let text = std::fs::read_to_string(shipped(scene)).expect("it is shipped");
    assert!(text.contains(this));
    let path = folder.path().join("changed.toml");
    std::fs::write(&path, text.replace(this, that)).expect("it is written");
    path
}

fn opened(path: PathBuf) -> Window {
    let mut window = open(Some(path));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [48, 32];
    wait(&mut window, "an image", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 48));
    window
}

#[test]
fn a_long_name_of_an_object_does_not_widen_the_panel() {
    let folder = tempfile::tempdir().expect("a folder");
    let name = "a wall with a name that is far longer than any panel of a window could ever be wide";
    let mut window = opened(changed(&folder, "furnace", "name = \"wall\"", &format!("name = \"{name}\"")));
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.state_mut().selection.select(Some(Subject::Object(0)));
    window.run_steps(3);
    let rights = ["a wall with a name that is far longer", "Rename", "Material"].map(|text| {
        let nodes = window.query_all_by_label_contains(text).map(|node| node.rect().right());
        nodes.fold(0.0, f32::max)
    });
    assert!(rights[0] > 0.0 && rights.iter().all(|right| *right < 1280.0), "{rights:?}");
    assert!(window.get_by_label("Open…").rect().right() < 1280.0);
}

#[test]
fn a_black_picture_is_told_with_its_likely_cause() {
    let mut window = opened(shipped("inside_lit_outside"));
    wait(&mut window, "samples", |app| app.status().spp >= 2 && app.results.black);
    window.run_steps(2);
    assert!(window.query_by_label("no light found yet").is_some() && window.query_by_label_contains("noise").is_none());
    assert!(window.query_by_label("The camera is inside “wall”.").is_some());
    let mut window = opened(shipped("furnace"));
    window.run_steps(2);
    assert!(window.query_by_label("no light found yet").is_none());
}

#[test]
fn a_true_picture_of_another_size_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut first = opened(shipped("furnace"));
    wait(&mut first, "a full image", App::can_save);
    first.state_mut().save_to(folder.path().join("true.exr"));
    wait(&mut first, "the file", |app| app.last_saved().is_some());
    let text = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    let reference = text.find("[reference]").expect("it has one");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("{}[reference]\nimage = \"true.exr\"\n", &text[..reference])).expect("it is written");
    let mut window = opened(path);
    wait(&mut window, "the error", |app| app.measured_error().is_some());
    window.state_mut().camera_mut().resolution = [40, 32];
    wait(&mut window, "another size", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 40));
    window.run_steps(2);
    assert!(window.query_by_label("error unknown").is_some());
}

#[test]
fn a_camera_that_cannot_be_leaves_the_last_picture_as_it_is() {
    let mut window = window("cornell_spheres");
    let shape = |window: &Window| window.state().picture_view().drawn_zoom;
    let before = shape(&window);
    never_restarts(&mut window, |w| {
        let camera = &mut w.state_mut().camera_mut();
        (camera.resolution, camera.look_at) = ([64, 640], camera.eye);
    });
    assert_eq!(shape(&window), before);
    assert!(window.query_by_label("Invalid settings").is_some() && window.query_by_label("unbiased").is_none());
    never_restarts(&mut window, |w| {
        let camera = &mut w.state_mut().camera_mut();
        (camera.look_at, camera.up) = (DVec3::ZERO, DVec3::ZERO);
    });
    assert!(window.query_by_label_contains("“up” is zero").is_some());
}

#[test]
fn the_list_marks_the_open_scene_however_it_was_named_and_knows_those_from_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    // Tests run in the folder of the package.
    let mut window = opened(PathBuf::from("scenes/furnace.toml"));
    window.get_by_role_and_label(Role::ComboBox, "Scene").click();
    window.run_steps(3);
    let is_marked = |window: &Window, name: &str| {
        let rows: Vec<_> = window.get_all_by_role_and_label(Role::Button, name).collect();
        rows.iter().any(|row| row.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True))
    };
    assert!(is_marked(&window, "Furnace") && !is_marked(&window, "Depth of field"));
    window.key_press(Key::Escape);
    window.run_steps(3);
    let path = changed(&folder, "furnace", "title = \"Furnace\"", "title = \"A furnace of mine\"");
    window.state_mut().look_mut().display.exposure = 3.0;
    window.state_mut().loader_mut().open(Some(path));
    wait(&mut window, "my scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "A furnace of mine"));
    assert_eq!(window.state().look().display.exposure, 0.0, "what suited the other scene");
    assert!(window.state().catalogue.iter().any(|entry| entry.name == "A furnace of mine"));
}

/// Messages lie in the middle of the image, beside the panel and above the tabs.
#[test]
fn messages_lie_over_the_picture() {
    let mut window = window("furnace");
    window.state_mut().tell("something to say".to_owned(), true);
    window.run_steps(3);
    let notice = window.get_by_label("something to say").rect();
    assert!((notice.center().x - (SIZE.x - 336.0) / 2.0).abs() < 60.0, "{notice:?}");
    assert!((SIZE.y - 120.0..SIZE.y - 60.0).contains(&notice.bottom()), "{notice:?}");
    window.state_mut().dialogs.scene_error = Some("it is broken".to_owned());
    window.run_steps(3);
    let report = window.get_by_label("it is broken").rect();
    assert!(report.right() < SIZE.x - 336.0 && report.left() > 0.0, "{report:?}");
}
