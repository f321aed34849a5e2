//! Path reuse and presets: experiments compare what they say they compare.
use noisefall_scene::scene::{Estimator, PathReuse, RenderSettings};

use super::*;
use crate::viewer::{instruments::tabs::InstrumentTab, panels::presets::Preset};

/// Whether a button is marked as the chosen one.
fn is_marked(window: &Window, label: &str) -> bool {
    let button = window.get_by_role_and_label(Role::Button, label);
    button.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
}

/// The estimator that Auto has chosen.
fn in_force(window: &Window) -> Option<Estimator> {
    let session = &window.state().session;
    let opened = session.opened.as_ref().expect("a scene is open");
    opened.scene.estimator_in_force(&session.settings).map(|in_force| in_force.estimator)
}

fn names(window: &Window) -> Vec<String> {
    let history = &window.state().curves();
    history.curves.iter().map(|curve| history.name(curve)).collect()
}

#[test]
fn path_reuse_stays_as_it_is_while_other_settings_change_and_every_curve_names_it() {
    let mut window = window("cornell_spheres");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Convergence);
    let sampled =
        |window: &mut Window| wait(window, "samples", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.spp >= 2));
    sampled(&mut window);
    assert!(window.state().status().path_reuse == PathReuse::Suffixes);
    restarts(&mut window, "independent samples", |w| choose(w, "Sampler", "Independent"));
    sampled(&mut window);
    restarts(&mut window, "paths alone", |w| choose(w, "Estimator", "BSDF sampling"));
    sampled(&mut window);
    restarts(&mut window, "a cap", |w| w.state_mut().settings_mut().max_bounces = Some(4));
    sampled(&mut window);
    assert!(window.state().status().path_reuse == PathReuse::Suffixes, "the decision is that of the scene");
    restarts(&mut window, "no path reuse", |w| choose(w, "Path reuse", "Off"));
    sampled(&mut window);
    window.run_steps(3);
    let names = names(&window);
    assert_eq!(names.iter().filter(|name| name.contains("reused suffixes")).count(), 4, "{names:?}");
    assert_eq!(names.iter().filter(|name| name.contains("no path reuse")).count(), 1, "{names:?}");
    let table = window.state().curves().csv().expect("it is written");
    let table = String::from_utf8(table).expect("it is text");
    assert!(table.starts_with("name,settings,path_reuse,") && table.contains(",suffixes,") && table.contains(",off,"), "{table}");
}

#[test]
fn both_sides_of_a_comparison_name_their_path_reuse() {
    let mut window = window("cornell_spheres");
    let other = RenderSettings { reuse: Reuse::Off, ..window.state().settings() };
    window.state_mut().start_comparison(other);
    wait(&mut window, "both", |app| app.status().spp >= 2 && app.second_status().spp >= 2);
    window.run_steps(3);
    assert!(window.query_by_label("MIS, Sobol (Owen), reused suffixes").is_some());
    assert!(window.get_all_by_label("no path reuse").next().is_some());
}

#[test]
fn a_preset_changes_its_settings_and_the_panel_marks_the_one_in_force() {
    let mut window = window("cornell_spheres");
    let app = window.state_mut();
    app.session.settings = RenderSettings { sampler: Sampler::Stratified, max_bounces: Some(6), ..RenderSettings::default() };
    window.run_steps(3);
    assert!(window.query_by_label("Custom").is_some());
    let before = window.state().settings();
    restarts(&mut window, "the textbook estimator", |w| click(w, "Teaching"));
    assert_eq!(window.state().settings(), RenderSettings { reuse: Reuse::Off, adaptive: false, ..before });
    assert!(is_marked(&window, "Teaching") && !is_marked(&window, "Fastest") && window.query_by_label("Custom").is_none());
    wait(&mut window, "its samples", |app| app.status().spp >= 1 && app.status().path_reuse == PathReuse::Off);
    restarts(&mut window, "the fastest one", |w| click(w, "Fastest"));
    assert!(is_marked(&window, "Fastest") && !is_marked(&window, "Teaching"));
    let settings = window.state().settings();
    assert_eq!((Preset::of(&settings), settings.max_bounces), (Some(Preset::Fastest), Some(6)), "a cap is no matter of speed");
    wait(&mut window, "its samples", |app| app.status().spp >= 1 && app.status().path_reuse == PathReuse::Suffixes);
    assert_eq!(in_force(&window), Some(Estimator::Mis), "bidirectional paths cost more in this room");
    window.get_by_role_and_label(Role::CheckBox, "Adaptive").click();
    window.run_steps(3);
    assert!(window.query_by_label("Custom").is_some() && !is_marked(&window, "Fastest"));
}

#[test]
fn fastest_takes_bidirectional_paths_where_they_are_measured_to_be_faster() {
    let mut window = window("glass_ball_caustic");
    window.state_mut().settings_mut().estimator = Estimator::Mis;
    restarts(&mut window, "the fastest one", |w| click(w, "Fastest"));
    wait(&mut window, "its samples", |app| app.status().spp >= 1);
    assert_eq!(in_force(&window), Some(Estimator::Bidirectional));
}

#[test]
fn the_panel_says_that_adaptive_sampling_is_not_used_where_pixels_share_paths() {
    const NOTE: &str = "not used: reused suffixes";
    let mut window = window("cornell_spheres");
    let sampled = |window: &mut Window| wait(window, "samples", |app| app.status().spp >= 1);
    sampled(&mut window);
    assert!(window.query_by_label(NOTE).is_none(), "nobody asked for it");
    restarts(&mut window, "adaptive sampling", |w| w.get_by_role_and_label(Role::CheckBox, "Adaptive").click());
    sampled(&mut window);
    window.run_steps(3);
    assert!(window.query_by_label(NOTE).is_some());
    restarts(&mut window, "no path reuse", |w| choose(w, "Path reuse", "Off"));
    sampled(&mut window);
    window.run_steps(3);
    assert!(window.query_by_label_contains("not used").is_none());
}

#[test]
fn advice_tries_the_other_path_reuse() {
    let mut window = window("cornell_box");
    restarts(&mut window, "no path reuse", |w| choose(w, "Path reuse", "Off"));
    wait(&mut window, "an image", |app| app.status().spp >= 1);
    click(&mut window, "What should I use here?");
    wait(&mut window, "the advice", |app| !app.is_studying());
    let advice = window.state().background.adviser.as_ref().and_then(|adviser| adviser.advice.as_ref());
    let advice = advice.expect("it is there").as_ref().expect("no failure");
    assert!(advice.candidates.iter().any(|candidate| candidate.settings.reuse == Reuse::Suffixes));
    let best = PathReuse::asked(advice.best().settings.reuse);
    assert!(best.has_suffixes(), "here path reuse is several times as efficient: {advice:?}");
}
