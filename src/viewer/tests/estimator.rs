//! Panel and status line say which estimator renders, and why.
use noisefall_render::render::RenderTask;
use noisefall_scene::scene::Strategy;

use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

/// Whether the window shows a text.
fn shows(window: &Window, text: &str) -> bool {
    window.query_all_by_label(text).count() > 0
}

#[test]
fn an_estimator_that_the_scene_allows_is_named_once_in_the_line_below() {
    let mut window = window("cornell_spheres");
    wait(&mut window, "samples", |app| app.status().spp >= 1);
    restarts(&mut window, "light sampling", |w| choose(w, "Estimator", "Light sampling"));
    assert!(shows(&window, "Light sampling") && window.query_by_label_contains("Light sampling, not").is_none());
}

#[test]
fn the_choice_by_trial_names_its_result_and_the_reason() {
    let mut window = window("cornell_spheres");
    restarts(&mut window, "a trial", |w| choose(w, "Estimator", "Auto"));
    let scene = window.state().opened().as_ref().expect("it is open").scene.clone();
    wait(&mut window, "the trial", |_| scene.estimator_by_trial.get().is_some());
    window.run_steps(3);
    let best = scene.estimator_by_trial.get().expect("it has been tried").title();
    assert!(shows(&window, &format!("{best}: lowest error in a trial")), "the panel names {best}");
    assert!(shows(&window, &format!("{best} (Auto)")), "the line below names {best}");
    // Nothing stops paths now, so they are not connected, and the trial no longer counts.
    restarts(&mut window, "endless paths", |w| choose(w, "Roulette", "Off"));
    assert!(window.query_by_label_contains("MIS: with so little roulette").is_some() && shows(&window, "MIS (Auto)"));
}

#[test]
fn an_estimator_that_the_scene_does_not_allow_names_its_substitute() {
    let mut window = window("textures_and_bump");
    restarts(&mut window, "light paths", |w| choose(w, "Estimator", "Light tracing"));
    wait(&mut window, "samples", |app| app.status().spp >= 1);
    window.run_steps(3);
    assert!(
        shows(&window, "MIS: the scene has smooth meshes, bump or normal maps")
            && shows(&window, "MIS (Light tracing unavailable)")
    );
}

#[test]
fn instruments_say_that_they_show_paths_from_the_camera_alone() {
    let mut window = window("cornell_spheres");
    let says = |window: &mut Window, text: &str| {
        window.run_steps(2);
        window.query_by_label_contains(text).is_some()
    };
    for (estimator, traces) in [("MIS", false), ("Bidirectional", true)] {
        choose(&mut window, "Estimator", estimator);
        *window.state_mut().tab_mut() = Some(InstrumentTab::Bounces);
        wait(&mut window, "the series", |app| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some()));
        assert_eq!(says(&mut window, "by camera paths (MIS)"), traces, "{estimator}");
        *window.state_mut().tab_mut() = Some(InstrumentTab::Path);
        window.state_mut().path_inspector_mut().look_at([40, 30]);
        wait(&mut window, "its samples", |app| app.path_inspector().histogram().is_some());
        assert_eq!(says(&mut window, "Samples lack the light that light paths bring"), traces, "{estimator}");
    }
}

/// The strategy that is rendered beside the image.
fn strategy_beside(app: &App) -> Option<Strategy> {
    match app.second_view() {
        Some(RenderTask::Picture(request)) => request.settings.strategy,
        _ => None,
    }
}

#[test]
fn bounces_show_the_image_of_a_single_strategy() {
    let mut window = window("cornell_box");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Bounces);
    let has_series = |app: &App| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some());
    wait(&mut window, "the series", has_series);
    window.get_by_label("Strategies (s, t)").click();
    let has_frame = |app: &App| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_none() && frame.spp >= 1);
    wait(&mut window, "light samples", has_frame);
    assert_eq!(strategy_beside(window.state()), Some(Strategy { s: 1, t: 2, weighted: true }));
    window.get_by_label("2, 1").click();
    window.run_steps(3);
    window.get_by_label("Weighted").click();
    window.run_steps(3);
    assert_eq!(strategy_beside(window.state()), Some(Strategy { s: 2, t: 1, weighted: false }));
    window.get_by_label("Bounce k alone").click();
    wait(&mut window, "the series", has_series);
    assert_eq!(strategy_beside(window.state()), None);
}

#[test]
fn a_scene_without_paths_from_lights_has_no_strategies_to_show() {
    let mut window = window("leaves");
    // Bidirectional paths do not count crossings.
    window.state_mut().settings_mut().count_crossings = true;
    *window.state_mut().tab_mut() = Some(InstrumentTab::Bounces);
    window.state_mut().session.bounces.strategy = Some(Strategy { s: 1, t: 2, weighted: true });
    wait(&mut window, "the series", |app| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some()));
    assert_eq!(window.state().strategy(), None);
}

#[test]
fn the_path_inspector_lists_the_strategies_of_a_sample() {
    let mut window = window("cornell_spheres");
    choose(&mut window, "Estimator", "Bidirectional");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Path);
    window.state_mut().path_inspector_mut().look_at([40, 30]);
    wait(&mut window, "its sample", |app| {
        app.path_inspector().replay().is_some_and(|(_, replay)| replay.bidirectional.is_some())
    });
    window.run_steps(2);
    assert!(
        shows(&window, "L = Σ w C over the strategies with t ≥ 2.") && shows(&window, "connected at") && shows(&window, "Sample")
    );
}
