//! The window rests when there is nothing to do, uses other threads, and joins moves of a drag; the tour and the gallery.
use noisefall_render::render::{RenderRequest, RenderTask};
use noisefall_scene::scene::RenderSettings;

use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

#[test]
fn a_hidden_window_renders_nothing_and_goes_on_when_it_is_seen() {
    let mut window = window("cornell_spheres");
    window.state_mut().hide(true);
    wait_without_frames(&window, |app| app.worker().latest().status.state == State::Paused);
    let samples = window.state().worker().latest().status.samples;
    // The worker takes its orders in their order: when it has rendered another image's first sample, which a pause does not hold
    // back, whatever else it meant to do with this one would be done.
    let app = window.state_mut();
    let request = app.worker().request().cloned().expect("it was asked for");
    let settings = RenderSettings { seed: 5, ..request.settings };
    let other = RenderTask::Picture(RenderRequest { settings, ..request.clone() });
    app.background.worker.update(request, Some(other), 0.0);
    wait_without_frames(&window, |app| app.worker().latest_second().frame.generation == app.worker().second_generation());
    assert_eq!(window.state().worker().latest().status.samples, samples, "a hidden window works");
    wait(&mut window, "more samples", |app| app.status().samples > samples && app.status().state == State::Running);
}

#[test]
fn a_window_that_is_minimized_is_hidden() {
    let mut window = window("furnace");
    for (minimized, occluded, hidden) in [(true, false, true), (false, false, false), (false, true, true)] {
        let viewport = window.input_mut().viewports.get_mut(&egui::ViewportId::ROOT).expect("the window");
        (viewport.minimized, viewport.occluded) = (Some(minimized), Some(occluded));
        window.step();
        let ctx = window.ctx.clone();
        eframe::App::logic(&mut **window.state_mut(), &ctx, &mut eframe::Frame::_new_kittest());
        assert_eq!(window.state().window.hidden, hidden, "minimized: {minimized}, occluded: {occluded}");
    }
}

/// Waits for the worker, while no frame is drawn.
fn wait_without_frames(window: &Window, condition: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !condition(window.state()) {
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", window.state().worker().latest().status);
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn nothing_is_drawn_where_nothing_changes() {
    let mut window = window("bright_sky");
    window.state_mut().budget_mut().max_spp = Some(2);
    wait(&mut window, "the target", |app| matches!(app.status().state, State::Done(_)));
    // Pending results arrive, then no frame asks for another one.
    wait(&mut window, "rest", |app| !app.ctx.has_requested_repaint());
}

#[test]
fn the_number_of_threads_never_changes_the_picture() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        w.get_by_role_and_label(Role::Slider, "Threads").set_value_accesskit(2.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().worker().threads(), 2);
    let samples = window.state().status().samples;
    wait(&mut window, "more samples", |app| app.status().samples > samples);
}

#[test]
fn a_dragged_control_asks_for_the_next_picture_when_it_has_seen_the_last() {
    let mut window = window("cornell_spheres");
    let press = |window: &Window, pos: Pos2, pressed: bool| {
        window.event(egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
    };
    let start = window.get_by_role_and_label(Role::Slider, "Field of view").rect().center();
    window.hover_at(start);
    window.run_steps(2);
    press(&window, start, true);
    window.run_steps(1);
    // An image is asked for where the last one is shown, or where the time to wait for it is over, by the clock of the window.
    let clock = |window: &Window| window.ctx.input(|input| input.time);
    let (mut waited, mut asked) = (0, 0);
    for step in 0..60 {
        let (before, asked_before) = (window.state().worker().generation(), window.state().worker().asked());
        // The harness lets a quarter of a second pass in a frame, which is longer than that.
        window.input_mut().time = Some(clock(&window) + 0.03);
        window.hover_at(start + vec2(step as f32, 0.0));
        window.step();
        let app = window.state();
        let is_shown = app.shown_frame().as_ref().is_some_and(|frame| frame.generation >= before);
        let patience_ends = clock(&window) - asked_before > 0.1 - 1e-9;
        let waits = app.worker().request().is_some_and(|request| request.camera != app.camera());
        if waits {
            assert!(!is_shown && !patience_ends, "it waits for what is there already");
            waited += 1;
        } else if app.worker().generation() > before {
            assert!(is_shown || patience_ends, "images pile up");
            asked += 1;
        }
    }
    assert!(asked > 5 && asked + waited > 30, "{asked} asked for, {waited} steps waited");
    press(&window, start + vec2(59.0, 0.0), false);
    let is_last = |app: &App| app.worker().request().is_some_and(|request| request.camera.fov == app.camera().fov);
    wait(&mut window, "the last one", |app| is_last(app) && app.status().generation == app.worker().generation());
}

#[test]
fn the_tour_shows_noise_bounces_and_roulette_and_is_not_shown_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    window.state_mut().preferences = Preferences::in_folder(folder.path());
    window.key_press(Key::F1);
    window.run_steps(3);
    click(&mut window, "Take the tour");
    let mut bottom = None;
    for (title, tab) in [
        ("This image is an estimate", InstrumentTab::Convergence),
        ("Light bounces", InstrumentTab::Bounces),
        ("Roulette ends paths without bias", InstrumentTab::Compare),
        ("Bidirectional path tracing", InstrumentTab::Compare),
        ("Your turn", InstrumentTab::Compare),
    ] {
        assert!(window.query_by_label(title).is_some(), "{title}");
        assert_eq!(window.state().tab(), Some(tab));
        if title.starts_with("Roulette") {
            window.state_mut().settings_mut().roulette = Roulette::Off;
            click(&mut window, "Compare with a cap of 3");
            let app = window.state();
            let capped = RenderSettings { max_bounces: Some(3), ..app.settings() };
            assert_eq!(app.compared_with().map(|compare| compare.other), Some(capped));
            assert_eq!(app.settings().roulette, Roulette::BY_THROUGHPUT);
        }
        if title.starts_with("Paths") {
            click(&mut window, "Compare MIS with bidirectional");
            let app = window.state();
            let other = app.compared_with().map(|compare| compare.other.estimator);
            assert_eq!((app.settings().estimator, other), (Estimator::Mis, Some(Estimator::Bidirectional)));
        }
        let next = if title == "Your turn" { "Done" } else { "Next" };
        let place = window.get_by_label(next).rect();
        assert!((place.bottom() - *bottom.get_or_insert(place.bottom())).abs() < 0.5, "{title}: {place:?}");
        click(&mut window, next);
    }
    assert!(window.state().dialogs.tour.is_none());
    wait(&mut window, "the note of it", |_| Preferences::in_folder(folder.path()).now.toured);
}

#[test]
fn the_gallery_shows_the_scenes_and_opens_one() {
    let mut window = window("furnace");
    window.key_press(Key::F6);
    window.run_steps(5);
    assert!(window.query_by_label("Open a file…").is_some());
    // The gallery begins at the open scene, which comes last.
    window.get_by_role_and_label(Role::Button, "Bright sky: fast to converge").scroll_to_me();
    window.run_steps(5);
    window.get_by_role_and_label(Role::Button, "Bright sky: fast to converge").click();
    window.run_steps(3);
    wait(&mut window, "the scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name.starts_with("Bright sky")));
    assert!(!window.state().dialogs.gallery.open);
}

#[test]
fn frame_times_are_shown() {
    let mut window = window("furnace");
    window.key_press(Key::F12);
    window.run_steps(3);
    assert_eq!(window.query_all_by_label_contains("p99").count(), 2, "layout alone, and with drawing");
}

#[test]
fn both_themes_can_be_chosen_and_are_remembered() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("furnace");
    window.state_mut().preferences = Preferences::in_folder(folder.path());
    for (name, dark, remembered) in
        [("Light", Some(false), Some("light")), ("Dark", Some(true), Some("dark")), ("As the system", None, None)]
    {
        window.get_by_role_and_label(Role::ComboBox, "Theme").scroll_to_me();
        window.run_steps(3);
        choose(&mut window, "Theme", name);
        window.run_steps(1);
        assert!(dark.is_none_or(|dark| window.ctx.global_style().visuals.dark_mode == dark), "{name}");
        let noted = || Preferences::in_folder(folder.path()).now.theme.clone();
        wait(&mut window, "the note of it", |_| noted().as_deref() == remembered);
    }
}

#[test]
fn the_interface_can_be_scaled() {
    let mut window = window("furnace");
    window.get_by_role_and_label(Role::ComboBox, "Scale").scroll_to_me();
    window.run_steps(3);
    choose(&mut window, "Scale", "150 %");
    assert_eq!(window.ctx.zoom_factor(), 1.5);
}
