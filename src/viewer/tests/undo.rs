//! Undo and redo: a stray click or drag costs no work.
use noisefall_base::declare::{OwnedValue, Path, Textured};
use noisefall_edit::edit::Edit;
use noisefall_render::render::view::View as Shown;
use noisefall_scene::scene::Camera;

use super::{edited::edits, *};

/// Sets the number of samples to stop at, which is no step here.
fn stop_at(window: &mut Window, spp: u32) {
    let app = window.state_mut();
    app.budget_mut().max_spp = Some(spp);
    let controls = app.session.controls();
    app.history.adopt(controls);
}

/// Waits until every pixel has so many samples, and stops there. A quick machine has more by now, so the image begins anew.
fn rendered(window: &mut Window, spp: u32) {
    stop_at(window, spp);
    let before = window.state().worker().generation();
    let begins_anew = window.state().status().spp > 0;
    if begins_anew {
        window.state_mut().worker_mut().restart();
    }
    // It begins anew with the next frame of the window. What is shown now may happen to have as many samples.
    wait(window, "the samples", |app| {
        let generation = app.worker().generation();
        let is_begun = !begins_anew || generation > before;
        is_begun && app.shown_frame().as_ref().is_some_and(|frame| frame.spp == spp && frame.generation == generation)
    });
}

#[test]
fn settings_that_are_undone_come_back_with_their_samples() {
    let mut window = window("cornell_spheres");
    rendered(&mut window, 40);
    let first = window.state().shown_frame().clone().expect("it is shown");
    restarts(&mut window, "a stray click", |w| choose(w, "Estimator", "Light sampling"));
    rendered(&mut window, 41);
    stop_at(&mut window, 40);
    restarts(&mut window, "the way back", undo);
    assert_eq!(window.state().settings().estimator, Estimator::Mis);
    wait(&mut window, "the samples as they were", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 40));
    let again = window.state().shown_frame().clone().expect("it is shown");
    assert_eq!(again.elapsed, first.elapsed, "the very same samples");
    assert!(again.radiance == first.radiance, "the very same samples");
    restarts(&mut window, "forth again", redo);
    assert_eq!(window.state().settings().estimator, Estimator::Light);
    wait(&mut window, "its samples", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 41));
    // Restart is meant as it is said.
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
    wait(&mut window, "new samples", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp < 40));
}

#[test]
fn an_edit_that_is_undone_gives_its_samples_back() {
    let mut window = window("cornell_spheres");
    rendered(&mut window, 40);
    let first = window.state().shown_frame().clone().expect("it is shown");
    let darker = OwnedValue::Textured(Textured::Constant([0.25; 3]));
    let edit = Edit::set(Path::of("materials.amber.lambertian.albedo"), darker);
    edits(&mut window, "a darker ball", |w| {
        w.state_mut().edit(&edit);
        w.run_steps(1);
    });
    rendered(&mut window, 41);
    stop_at(&mut window, 40);
    edits(&mut window, "the way back", undo);
    wait(&mut window, "the samples as they were", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 40));
    let again = window.state().shown_frame().clone().expect("it is shown");
    assert_eq!(again.elapsed, first.elapsed, "the very same samples");
    assert!(again.radiance == first.radiance, "the very same samples");
    edits(&mut window, "forth again", redo);
    wait(&mut window, "its samples", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 41));
    // An edit that is undone at once is never rendered.
    never_restarts(&mut window, |w| {
        let brighter = OwnedValue::Textured(Textured::Constant([0.75; 3]));
        w.state_mut().edit(&Edit::set(Path::of("materials.amber.lambertian.albedo"), brighter));
        w.state_mut().undo();
    });
    wait(&mut window, "the scene", |app| !app.worker().is_editing() && app.session.waiting_edit.is_none());
    assert_eq!(window.state().status().generation, generation(&window));
}

#[test]
fn one_drag_of_the_camera_is_one_step() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    rendered(&mut window, 30);
    *window.state_mut().tool_mut() = Tool::Camera;
    restarts(&mut window, "a drag", |w| drag(w, PointerButton::Primary, [400.0, 400.0], [460.0, 420.0]));
    let first = window.state().camera();
    restarts(&mut window, "another drag", |w| drag(w, PointerButton::Primary, [400.0, 400.0], [380.0, 380.0]));
    let second = window.state().camera();
    assert!(start != first && first != second);
    for expected in [first, start] {
        undo(&mut window);
        assert_eq!(window.state().camera(), expected);
    }
    wait(&mut window, "its samples", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 30));
    for expected in [first, second, second] {
        redo(&mut window);
        assert_eq!(window.state().camera(), expected);
    }
    restarts(&mut window, "the wheel", |w| scroll(w, [400.0, 400.0], 40.0));
    undo(&mut window);
    assert_eq!(window.state().camera(), second, "turns of the wheel are one step");
}

#[test]
fn view_comparison_and_camera_are_undone_in_their_order_by_keys_and_buttons() {
    let mut window = window("cornell_spheres");
    let start = window.state().session.controls();
    choose(&mut window, "View", "Depth");
    let depth = window.state().session.controls();
    window.state_mut().start_comparison(noisefall_scene::scene::RenderSettings { seed: 5, ..depth.settings });
    window.run_steps(3);
    let compared = window.state().session.controls();
    window.state_mut().camera_mut().fov = 50.0;
    window.run_steps(3);
    assert_eq!((depth.look.view, compared.comparison.is_some()), (Shown::Depth, true));
    for expected in [compared, depth, start] {
        click(&mut window, "Undo");
        assert_eq!(window.state().session.controls(), expected);
    }
    // Before that the resolution was made small.
    click(&mut window, "Undo");
    assert!(window.get_by_label("Undo").accesskit_node().is_disabled());
    for expected in [start, depth] {
        click(&mut window, "Redo");
        assert_eq!(window.state().session.controls(), expected);
    }
    // A new step forgets what was undone.
    window.state_mut().camera_mut().fov = 60.0;
    window.run_steps(3);
    redo(&mut window);
    let camera = Camera { fov: 60.0, ..start.camera };
    assert_eq!(window.state().session.controls().camera, camera);
    assert!(window.get_by_label("Redo").accesskit_node().is_disabled());
}

#[test]
fn a_slider_that_is_dragged_is_one_step_and_text_has_an_undo_of_its_own() {
    let mut window = window("cornell_spheres");
    let fov = window.state().camera().fov;
    let slider = window.get_by_role_and_label(Role::Slider, "Field of view").rect().center();
    drag(&mut window, PointerButton::Primary, [slider.x, slider.y], [slider.x + 30.0, slider.y]);
    assert_ne!(window.state().camera().fov, fov);
    undo(&mut window);
    assert_eq!(window.state().camera().fov, fov);
    redo(&mut window);
    let dragged = window.state().camera().fov;
    assert_ne!(dragged, fov);
    click(&mut window, "Open…");
    window.run_steps(3);
    undo(&mut window);
    assert_eq!(window.state().camera().fov, dragged, "a dialog has the keys");
}

#[test]
fn the_stop_target_is_undone_without_a_restart() {
    let mut window = window("cornell_spheres");
    let start = window.state().budget();
    never_restarts(&mut window, |w| {
        check_box(w, "Stop at");
        set(w, "Stop at", 0, 3.0);
        check_box(w, "Stop below");
    });
    let last = window.state().budget();
    assert_eq!((last.max_spp, last.noise), (Some(3), Some(0.01)));
    never_restarts(&mut window, |w| (0..3).for_each(|_| undo(w)));
    assert_eq!(window.state().budget(), start);
    never_restarts(&mut window, |w| (0..3).for_each(|_| redo(w)));
    assert_eq!(window.state().budget(), last);
}

#[test]
fn another_scene_has_nothing_to_undo() {
    let mut window = window("cornell_spheres");
    window.state_mut().camera_mut().fov = 50.0;
    window.run_steps(2);
    window.state_mut().loader_mut().open(Some(shipped("furnace")));
    wait(&mut window, "the scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace"));
    window.run_steps(3);
    let camera = window.state().camera();
    undo(&mut window);
    assert_eq!(window.state().camera(), camera);
}

/// A curve that gets shorter never replaces a longer one of the same settings, and curves come back with their camera.
#[test]
fn a_restart_and_a_stray_drag_cost_no_curve() {
    let mut window = window("cornell_spheres");
    rendered(&mut window, 40);
    let longest = |window: &Window| {
        let curves = &window.state().curves().curves;
        curves.iter().filter_map(|curve| curve.moments.last()).map(|moment| moment.spp).max()
    };
    wait(&mut window, "the curve", |app| {
        app.curves().curves.iter().any(|curve| curve.moments.last().is_some_and(|moment| moment.spp >= 38))
    });
    let before = longest(&window);
    stop_at(&mut window, 3);
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
    rendered(&mut window, 3);
    assert_eq!(longest(&window), before);
    restarts(&mut window, "a stray drag", |w| {
        w.state_mut().camera_mut().fov = 70.0;
        w.run_steps(2);
    });
    rendered(&mut window, 3);
    assert!(longest(&window) < before);
    restarts(&mut window, "the way back", undo);
    rendered(&mut window, 3);
    assert_eq!(longest(&window), before, "with the curve of this camera");
}
