//! Selecting objects in the image.
use egui::Shape;
use noisefall_render::render::Region;

use super::*;
use crate::viewer::canvas::projection::project;

pub const AMBER_BALL: usize = 5;
const LEFT_WALL: usize = 0;

/// Where the window shows a point of the scene.
pub fn seen(window: &mut Window, p: DVec3) -> Pos2 {
    let at = Pos2::new(430.0, 430.0);
    window.hover_at(at);
    window.run_steps(2);
    let hovered = window.state().hovered().expect("it is over the image");
    let pixel = project(&window.state().camera(), p).expect("it is in front");
    let zoom = window.state().picture_view().drawn_zoom;
    at + vec2(pixel[0] - hovered[0] as f32, pixel[1] - hovered[1] as f32) * zoom
}

pub fn ball() -> DVec3 {
    DVec3::new(-0.44, 0.38, -0.35)
}

fn meshes(window: &Window) -> usize {
    window.output().shapes.iter().filter(|clipped| matches!(clipped.shape, Shape::Mesh(_))).count()
}

#[test]
fn a_click_selects_an_object_and_outlines_it_without_a_restart() {
    let mut window = window("cornell_spheres");
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.run_steps(2);
    let at = seen(&mut window, ball());
    let camera = window.state().camera();
    let scene = window.state().opened().as_ref().expect("it is open").scene.clone();
    assert!(!window.state().background.features.has(&scene, &camera), "nothing is looked at while nothing is selected");
    let before = meshes(&window);
    never_restarts(&mut window, |w| click_at(w, at));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    wait(&mut window, "the objects of the pixels", |app| app.background.features.has(&scene, &camera));
    let start = Instant::now();
    while meshes(&window) == before {
        assert!(start.elapsed() < Duration::from_secs(60), "the outline never came");
        std::thread::sleep(Duration::from_millis(2));
        window.step();
    }
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert_eq!((window.state().selection.object(), meshes(&window)), (None, before));
}

#[test]
fn the_camera_looks_at_the_selected_object_unless_it_is_larger_than_the_scene() {
    let mut window = window("cornell_spheres");
    let direction = window.state().camera().axes()[2];
    *window.state_mut().selected_mut() = Some(Subject::Object(AMBER_BALL));
    restarts(&mut window, "a look at the ball", |w| {
        w.key_press(Key::L);
        w.run_steps(3);
    });
    let camera = window.state().camera();
    assert!(camera.look_at.distance(ball()) < 1e-9 && camera.axes()[2].distance(direction) < 1e-9);
    *window.state_mut().selected_mut() = Some(Subject::Object(LEFT_WALL));
    never_restarts(&mut window, |w| {
        w.key_press(Key::L);
        w.run_steps(3);
    });
    assert!(window.query_by_label("This object is larger than the scene").is_some());
}

#[test]
fn escape_gives_the_selection_up_before_the_region_and_another_scene_has_none() {
    let mut window = window("cornell_spheres");
    let select = |window: &mut Window| *window.state_mut().selected_mut() = Some(Subject::Object(AMBER_BALL));
    select(&mut window);
    window.state_mut().budget_mut().region = Some(Region::between([1, 1], [20, 20]));
    for left in [(false, true), (false, false)] {
        window.key_press(Key::Escape);
        window.run_steps(3);
        let app = window.state();
        assert_eq!((app.selected().is_some(), app.budget().region.is_some()), left);
    }
    select(&mut window);
    window.state_mut().loader_mut().open(Some(shipped("furnace")));
    wait(&mut window, "the other scene", |app| app.selected().is_none());
}

#[test]
fn a_part_that_is_selected_in_the_image_is_scrolled_into_sight() {
    let mut window = window("sphere_field");
    click(&mut window, "Edit");
    window.run_steps(3);
    let count = window.state().editor.as_ref().expect("it is open").document.description().objects.len();
    let rows = |window: &Window| {
        window
            .query_all_by_role(Role::Button)
            .filter(|row| row.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True))
            .count()
    };
    let marked_tabs = rows(&window);
    window.state_mut().selection.select(Some(Subject::Object(count - 1)));
    window.run_steps(30);
    assert_eq!(rows(&window), marked_tabs + 2, "its row is shown, and marked, and so is the mode of the handles");
}
