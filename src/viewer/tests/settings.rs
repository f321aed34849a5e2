//! Settings: the changes that start a new image, and those that do not.
use noisefall_base::declare::{Declare, Dice};
use noisefall_scene::scene::{PathReuse, RenderSettings};
use rand::{SeedableRng, rngs::SmallRng};

use super::*;

#[test]
fn every_setting_of_the_estimate_starts_a_new_picture() {
    let mut window = window("cornell_spheres");
    restarts(&mut window, "stratified", |w| choose(w, "Sampler", "Stratified"));
    assert_eq!(window.state().settings().sampler, Sampler::Stratified);
    restarts(&mut window, "light sampling alone", |w| choose(w, "Estimator", "Light sampling"));
    assert_eq!(window.state().settings().estimator, Estimator::Light);
    restarts(&mut window, "paths alone", |w| choose(w, "Estimator", "BSDF sampling"));
    assert_eq!(window.state().settings().estimator, Estimator::Path);
    restarts(&mut window, "uniform directions", |w| click(w, "Uniform"));
    assert_eq!(window.state().settings().directions, Directions::Uniform);
    restarts(&mut window, "cosine directions", |w| click(w, "Cosine"));
    restarts(&mut window, "reused suffixes", |w| choose(w, "Path reuse", "Suffixes"));
    assert_eq!(window.state().settings().reuse, Reuse::Suffixes);
    restarts(&mut window, "adaptive samples", |w| {
        w.get_by_role_and_label(Role::CheckBox, "Adaptive").click();
        w.run_steps(2);
    });
    assert!(window.state().settings().adaptive);
    restarts(&mut window, "fixed roulette", |w| choose(w, "Roulette", "Fixed probability"));
    assert!(matches!(window.state().settings().roulette, Roulette::Fixed(_)));
    restarts(&mut window, "another survival probability", |w| {
        w.get_by_role_and_label(Role::Slider, "Survival").set_value_accesskit(0.5);
        w.run_steps(2);
    });
    assert_eq!(window.state().settings().roulette, Roulette::fixed(0.5));
    assert!(window.query_by_label("infinite variance?").is_some(), "walls of albedo 0.75 keep more than 0.5 of the square");
    restarts(&mut window, "no roulette", |w| choose(w, "Roulette", "Off"));
    assert!(window.query_by_label("infinite variance?").is_none(), "weights of cosine directions never grow");
    restarts(&mut window, "a cap", |w| {
        w.get_by_role_and_label(Role::CheckBox, "Bounce cap").click();
        w.run_steps(2);
    });
    assert!(window.query_by_label("biased: cap at 8").is_some(), "the badge says what the cap does");
    restarts(&mut window, "another seed", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Seed").set_value_accesskit(42.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().settings().seed, 42);
}

#[test]
fn every_setting_has_a_row_an_undo_step_and_words_in_the_legend() {
    let mut window = window("cornell_spheres");
    let mut random = SmallRng::seed_from_u64(56);
    let mut other = window.state().settings();
    while RenderSettings::TABLE.iter().any(|setting| !setting.differs(&other, &window.state().settings())) {
        other.parameters(&mut Dice::new(&mut random));
    }
    for setting in RenderSettings::TABLE {
        assert!(window.query_by_label(&setting.label()).is_some(), "{setting:?} has no row");
        let before = window.state().settings();
        *window.state_mut().settings_mut() = setting.with(&before, &other);
        window.run_steps(2);
        let app = window.state();
        let [undo, _] = app.history.names();
        assert_eq!(undo, Some(format!("change of {}", setting.name())));
        let legend = crate::viewer::instruments::convergence::history::name(&app.settings(), &before, PathReuse::Off);
        let is_told = legend.contains(&setting.words(&other));
        assert!(is_told || setting == RenderSettings::REUSE, "{setting:?}: {legend}");
    }
}

#[test]
fn no_row_is_wider_than_the_panel() {
    for (scene, says) in
        [("cornell_spheres", "reused suffixes"), ("room_window", "reused suffixes and outliers"), ("bright_sky", "no path reuse")]
    {
        let mut window = window(scene);
        wait(&mut window, "samples", |app| app.status().spp >= 1);
        window.run_steps(3);
        let note = window.get_by_label(says).rect();
        let label = window.get_by_label("Path reuse").rect();
        let toolbar = window.get_by_label("Help").rect();
        assert!(note.right() <= 1280.0, "{scene}: {note:?}");
        assert!(label.left() > toolbar.right(), "{scene}: {label:?} is cut off at {toolbar:?}");
    }
}

#[test]
fn display_settings_zoom_and_target_never_restart() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        w.get_by_role_and_label(Role::Slider, "Exposure").set_value_accesskit(2.0);
        choose(w, "Tone map", "Reinhard");
    });
    assert_eq!(window.state().look().display.exposure, 2.0);
    assert_eq!(window.state().look().display.tone_map, ToneMap::Reinhard);
    let fitted = window.state().picture_view().drawn_zoom;
    never_restarts(&mut window, |w| scroll(w, [400.0, 400.0], 50.0));
    assert!(window.state().picture_view().drawn_zoom > fitted);
    never_restarts(&mut window, |w| drag(w, PointerButton::Primary, [400.0, 400.0], [300.0, 400.0]));
    assert!(window.state().picture_view().offset.x > 0.0);
    never_restarts(&mut window, |w| click(w, "1:1"));
    assert_eq!(window.state().picture_view().drawn_zoom, 1.0);
    never_restarts(&mut window, |w| {
        w.get_by_role_and_label(Role::CheckBox, "Stop at").click();
        w.run_steps(2);
    });
    assert_eq!(window.state().budget().max_spp, Some(1024));
}

#[test]
fn pause_step_resume_and_restart_do_so() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Pause");
    wait(&mut window, "the pause", |app| app.status().state == State::Paused);
    let paused = window.state().status().clone();
    window.key_press(Key::Period);
    wait(&mut window, "a step", |app| app.status().spp == paused.spp + 1);
    never_restarts(&mut window, |w| click(w, "Resume"));
    wait(&mut window, "more samples", |app| app.status().spp > paused.spp + 2);
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
}

#[test]
fn a_reached_target_is_named_and_a_higher_one_goes_on() {
    let mut window = window("bright_sky");
    window.state_mut().budget_mut().max_spp = Some(3);
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
    wait(&mut window, "the target", |app| matches!(app.status().state, State::Done(_)));
    assert_eq!(window.state().status().spp, 3);
    assert!(window.query_by_label("Stopped at 3 spp").is_some());
    window.state_mut().budget_mut().max_spp = Some(5);
    let mut titles = Vec::new();
    let done = |app: &App| app.status().spp == 5 && matches!(app.status().state, State::Done(_));
    let start = Instant::now();
    while !done(window.state()) {
        assert!(start.elapsed() < Duration::from_secs(60), "the next target never came");
        window.step();
        titles.extend(window.output().viewport_output[&egui::ViewportId::ROOT].commands.iter().filter_map(
            |command| match command {
                egui::ViewportCommand::Title(title) => Some(title.clone()),
                _ => None,
            },
        ));
    }
    window.run_steps(1);
    assert!(window.query_by_label("Stopped at 5 spp").is_some());
    let last = titles.last().expect("a title");
    assert!(last.ends_with(" (stopped at 5 spp) – Noisefall"), "{titles:?}");
    window.state_mut().budget_mut().noise = Some(0.5);
    never_restarts(&mut window, |w| w.state_mut().budget_mut().max_spp = None);
    wait(&mut window, "the noise target", |app| app.status().state == State::Done(Target::Noise(0.5)));
    window.run_steps(1);
    assert!(window.query_by_label("Error target 50 % reached").is_some());
}

#[test]
fn a_setting_has_one_name_on_both_pages_of_the_panel() {
    const NAMES: [&str; 9] =
        ["Estimator", "Sampler", "Directions", "Path reuse", "Adaptive", "Roulette", "Bounce cap", "Seed", "Stop at"];
    let mut window = window("cornell_spheres");
    for page in [PanelTab::Render, PanelTab::Edit] {
        *window.state_mut().panel_mut() = page;
        window.state_mut().selection.select(Some(Subject::Presentation));
        window.run_steps(3);
        for name in NAMES {
            assert!(window.query_all_by_label_contains(name).count() > 0, "{name} is not on {page:?}");
        }
    }
    assert_eq!(window.query_all_by_label_contains("Max bounces").count(), 0);
}
