//! New objects are as large as suits the view where they are placed.
use std::path::Path;

use noisefall_base::declare::OneOf;
use noisefall_scene::{
    light::punctual_light::PunctualLightKind,
    scene::{Object, Scene},
    shape::ShapeKind,
};

use super::{edited::description, *};
use crate::viewer::{canvas::projection::project, panels::outliner::New};

/// The template Studio: a ball of 1.2 m on a backdrop of 48 m.
fn studio() -> Window {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("crates/edit/src/edit/templates/studio.toml");
    let mut window = open(Some(path));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [96, 64];
    wait(&mut window, "an image", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 96));
    window
}

fn compiled(window: &Window) -> Scene {
    description(window).build(Path::new("")).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// Fails unless the object that was added last is a visible part of the image, and the camera is outside.
fn suits_the_view(window: &Window, what: &str) {
    let (scene, camera) = (compiled(window), window.state().camera());
    let last = description(window).objects.len() - 1;
    let spheres = scene.objects[scene.objects_of(last)].iter().map(|object: &Object| object.shape.swept_sphere(&object.motion));
    let (center, radius) = framing::around(spheres).expect("it has a shape");
    assert!(camera.eye.distance(center) > 2.0 * radius, "{what}: {radius} m around {center}");
    let [x, y] = project(&camera, center).expect("it is before the camera");
    assert!((0.0..96.0).contains(&x) && (0.0..64.0).contains(&y), "{what}: {x} {y}");
    let [_, edge] = project(&camera, center + camera.axes()[1] * radius).expect("it is before the camera");
    let part = 2.0 * (y - edge) / 64.0;
    // The sphere around a mesh is larger than the mesh, which may stand nearer than the surface that was clicked.
    assert!((0.04..1.2).contains(&part), "{what}: {part} of the height");
}

#[test]
fn shapes_and_lights_suit_the_visible_objects_before_a_far_backdrop() {
    let mut window = studio();
    // The wall behind, the floor before the ball, and the ball.
    for pixel in [[10, 8], [48, 60], [48, 34]] {
        window.state_mut().selection.clicked = Some(pixel);
        for kind in ShapeKind::alternatives() {
            for new in [New::Shape(kind.name()), New::AreaLight(kind.name())] {
                // An object far up or at the edge may be out of the image, but is never around the camera.
                let is_middle = pixel[0] == 48 && matches!(new, New::Shape(_));
                window.state_mut().add(new);
                if is_middle {
                    suits_the_view(&window, kind.name());
                }
                let (scene, eye) = (compiled(&window), window.state().camera().eye);
                let last = description(&window).objects.len() - 1;
                for object in &scene.objects[scene.objects_of(last)] {
                    let (center, radius) = object.shape.swept_sphere(&object.motion);
                    assert!(center.distance(eye) > radius, "{} at {pixel:?}", kind.name());
                }
                window.state_mut().discard_edit();
            }
        }
        for kind in PunctualLightKind::alternatives() {
            window.state_mut().add(New::PunctualLight(kind.name()));
            let punctual_light = description(&window).punctual_lights.last().expect("it is there").clone();
            let eye = window.state().camera().eye;
            assert!(punctual_light.position().is_none_or(|at| at.distance(eye) < 60.0 && at.y < 12.0), "{punctual_light:?}");
            window.state_mut().discard_edit();
        }
    }
}

#[test]
fn meshes_of_any_unit_suit_the_view() {
    for unit in [0.001, 1.0, 30.0, 1000.0] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut window = studio();
        let count = description(&window).objects.len();
        let path = folder.path().join("crate.obj");
        let half = 0.5 * unit;
        let corners = format!("v -{half} 0 -{half}\nv {half} 0 -{half}\nv 0 0 {half}\nv 0 {unit} 0\n");
        std::fs::write(&path, format!("{corners}f 1 2 4\nf 2 3 4\nf 3 1 4\n")).expect("it is written");
        drop_file(&mut window, path);
        wait(&mut window, "the mesh", |app| app.editor.as_ref().is_some_and(|e| e.document.description().objects.len() > count));
        suits_the_view(&window, &format!("{unit} m"));
    }
}

#[test]
fn shift_a_adds_where_the_pointer_is() {
    let mut window = window("cornell_spheres");
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.hover_at(Pos2::new(472.0, 800.0));
    window.run_steps(2);
    let pixel = window.state().hovered().expect("it is over the image");
    window.key_press_modifiers(Modifiers::SHIFT, Key::A);
    window.run_steps(2);
    // The pointer goes to the menu.
    window.hover_at(Pos2::new(1100.0, 300.0));
    window.run_steps(2);
    assert_eq!(window.state().selection.clicked, Some(pixel));
    let [at, _] = window.state().surface_at(Some(pixel)).expect("there is a surface");
    window.state_mut().add(New::Shape("sphere"));
    let scene = compiled(&window);
    let added = scene.objects_of(description(&window).objects.len() - 1);
    let (center, radius) = scene.objects[added.start].shape.swept_sphere(&scene.objects[added.start].motion);
    // It stands on the floor before the wall that was hit.
    let [beside, before] = [center.x - at.x, center.z - at.z];
    assert!(beside.hypot(before) < 1.01 * radius, "{center} {radius} {at}");
}
