//! Helpers for tests of edits.
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Tree;
use noisefall_scene::{scene::description::SceneDescription, shape::ShapeKind};

use super::*;

pub fn description(window: &Window) -> &SceneDescription {
    window.state().editor.as_ref().expect("a scene is open").document.description()
}

pub fn bits(window: &Window) -> Tree {
    Tree::of(&mut description(window).clone())
}

/// Does something and waits for the image of the edited scene.
pub fn edits(window: &mut Window, what: &str, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    act(window);
    wait(window, what, |app| {
        let waits = app.worker().is_editing() || app.session.waiting_edit.is_some();
        let shown = app.shown_frame().as_ref().map_or(0, |frame| frame.generation);
        !waits && shown > before && shown == app.worker().generation()
    });
}

pub fn select(window: &mut Window, subject: Subject) {
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.state_mut().selection.select(Some(subject));
    window.run_steps(3);
}

pub fn material(window: &Window, name: &str) -> OwnedValue {
    let mut document = description(window).clone();
    let path = Path::of("materials").key(name).key("lambertian").key("albedo");
    Tree::at(&mut document, &path).and_then(|tree| tree.value().cloned()).expect("it has an albedo")
}

pub fn center(window: &Window, object: usize) -> DVec3 {
    let ShapeKind::Sphere(sphere) = &description(window).objects[object].shape else { panic!("it is a ball") };
    sphere.center
}
