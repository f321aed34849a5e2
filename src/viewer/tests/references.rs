//! References that are rendered, taken from the image, or opened, and the legend of the curves that they are for.
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Edit;

use super::{edited::edits, *};
use crate::viewer::instruments::tabs::InstrumentTab;

fn is_compared(app: &App) -> bool {
    let is_latest = app.shown_frame().as_ref().is_some_and(|frame| frame.generation == app.worker().generation());
    is_latest && app.measured_error().is_some()
}

fn said(window: &Window, text: &str) -> bool {
    window.query_all_by_label_contains(text).count() > 0
}

#[test]
fn a_reference_is_rendered_beside_the_image_and_is_for_the_scene_as_it_was() {
    let mut window = window("cornell_spheres");
    window.state_mut().settings_mut().max_bounces = Some(1);
    window.state_mut().session.reference_noise = 0.2;
    let generation = generation(&window);
    click(&mut window, "Render a reference");
    assert!(window.state().background.reference.is_some());
    wait(&mut window, "the reference", |app| app.session.given_reference.is_some());
    wait(&mut window, "the error", is_compared);
    window.run_steps(2);
    let given = window.state().session.given_reference.as_ref().expect("it is there");
    assert!(given.reference.relative_noise().is_some_and(|noise| noise <= 0.2), "{:?}", given.reference.relative_noise());
    assert!(said(&window, "estimated error ") && said(&window, "error"));
    assert!(window.state().worker().generation() >= generation);
    // A cap of one bounce is wrong by much more than the noise of the reference.
    wait(&mut window, "a precise image", |app| app.status().spp >= 64);
    wait(&mut window, "its error", |app| app.measured_error().is_some_and(|comparison| comparison.rel_mse.sqrt() > 0.25));
    edits(&mut window, "the edit", |w| {
        let brighter = Edit::set(Path::of("objects.0.emission.radiance"), OwnedValue::Colour([3.0; 3]));
        assert!(w.state_mut().edit(&brighter));
    });
    wait(&mut window, "an image of the edit", |app| app.shown_frame().is_some());
    assert!(window.state().reference().is_none(), "it is not of the edited scene");
    undo(&mut window);
    wait(&mut window, "the error of the scene before", is_compared);
}

#[test]
fn the_image_itself_is_a_reference_unless_it_is_biased() {
    let mut window = window("cornell_spheres");
    wait(&mut window, "a full image", |app| app.why_no_reference().is_none());
    window.run_steps(2);
    click(&mut window, "Use this image as the reference");
    wait(&mut window, "the error", is_compared);
    click(&mut window, "Remove");
    assert!(window.state().reference().is_none());
    window.state_mut().settings_mut().max_bounces = Some(2);
    wait(&mut window, "the capped image", |app| app.why_no_reference().is_some_and(|why| why.contains("biased")));
}

#[test]
fn a_reference_is_opened_by_its_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.hdr");
    std::fs::write(&path, crate::viewer::background::dropped::tests::hdr(96, 64)).expect("it is written");
    let mut window = window("cornell_spheres");
    click(&mut window, "Open reference…");
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    window.get_all_by_role_and_label(Role::Button, "Open").last().expect("it is there").click();
    wait(&mut window, "the error", is_compared);
    window.run_steps(2);
    assert!(said(&window, "mine.hdr") && said(&window, "estimated error unknown"));
}

#[test]
fn an_undo_leaves_the_errors_of_all_curves() {
    let mut window = window("furnace");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Convergence);
    let measured = |app: &App, curves: usize| {
        let history = &app.curves();
        let is_long = history.curves.iter().all(|curve| curve.moments.iter().filter(|m| m.true_error.is_some()).count() >= 3);
        history.curves.len() == curves && is_long
    };
    wait(&mut window, "a curve", |app| measured(app, 1));
    choose(&mut window, "Sampler", "Independent");
    wait(&mut window, "both curves", |app| measured(app, 2));
    undo(&mut window);
    for _ in 0..20 {
        assert!(measured(window.state(), 2), "the errors stay");
        window.run_steps(1);
    }
}

#[test]
fn a_click_in_the_legend_hides_a_curve_and_a_menu_renames_and_removes_it() {
    let mut window = window("cornell_spheres");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Convergence);
    wait(&mut window, "a curve", |app| app.curves().curves.first().is_some_and(|curve| curve.moments.len() > 1));
    window.run_steps(2);
    assert!(said(&window, "estimated error") || said(&window, "estimated error "), "nothing is measured");
    let name = |window: &Window| {
        let history = &window.state().curves();
        history.name(&history.curves[0])
    };
    let entry = name(&window);
    click(&mut window, &entry);
    assert!(window.state().curves().curves[0].is_hidden);
    click(&mut window, &entry);
    assert!(!window.state().curves().curves[0].is_hidden);
    window.get_by_label(&entry).click_secondary();
    window.run_steps(3);
    click(&mut window, "Rename");
    window.get_by_role(Role::TextInput).set_text_value_accesskit("mine");
    window.run_steps(2);
    press(&mut window, Key::Enter);
    assert_eq!(name(&window), "mine");
    window.state_mut().budget_mut().paused = true;
    window.run_steps(3);
    window.get_by_label("mine").click_secondary();
    window.run_steps(3);
    let generation = window.state().curves().curves[0].generation;
    click(&mut window, "Remove");
    let curves = &window.state().curves().curves;
    assert!(
        curves.iter().all(|curve| curve.generation == generation && curve.given_name.is_none()),
        "it is gone, or begins anew"
    );
}
