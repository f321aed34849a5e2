//! Keys, lists and buttons do what they say.
use noisefall_render::render::{colour_map::ColourMap, view::View as Shown};

use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

#[test]
fn lists_buttons_and_keys_choose_the_view() {
    let mut window = window("cornell_spheres");
    for (map, name, _) in ColourMap::CHOICE.into_iter().rev() {
        click(&mut window, name);
        assert_eq!(window.state().look().map, map);
    }
    for (tone_map, name) in ToneMap::ALL.map(|map| (map, map.title())).into_iter().rev() {
        choose(&mut window, "Tone map", name);
        assert_eq!(window.state().look().display.tone_map, tone_map);
    }
    for view in Shown::ALL.into_iter().skip(1).chain([Shown::ALL[0]]) {
        press(&mut window, Key::V);
        assert_eq!(window.state().look().view, view);
    }
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.run_steps(3);
    assert_eq!(window.state().look().view, Shown::ALL[Shown::ALL.len() - 1], "the one before");
    for (key, tab) in [
        (Key::F2, InstrumentTab::Convergence),
        (Key::F3, InstrumentTab::Compare),
        (Key::F4, InstrumentTab::Bounces),
        (Key::F5, InstrumentTab::Path),
    ] {
        press(&mut window, key);
        assert_eq!(window.state().tab(), Some(tab));
        press(&mut window, key);
        assert_eq!(window.state().tab(), None);
    }
    for (label, tab) in [
        ("Convergence", InstrumentTab::Convergence),
        ("Compare", InstrumentTab::Compare),
        ("Bounces", InstrumentTab::Bounces),
        ("Pixel", InstrumentTab::Path),
    ] {
        window.get_by_role_and_label(Role::Button, label).click();
        window.run_steps(3);
        assert_eq!(window.state().tab(), Some(tab), "{label}");
    }
    press(&mut window, Key::F5);
    let tools = [("Region", Key::B, Tool::Region), ("Inspect", Key::I, Tool::Inspect), ("Camera", Key::C, Tool::Camera)];
    for (label, key, tool) in tools.into_iter().chain([("Image", Key::P, Tool::Picture)]) {
        press(&mut window, key);
        assert_eq!(window.state().tool(), tool);
        press(&mut window, if tool == Tool::Picture { Key::C } else { Key::P });
        window.get_all_by_role_and_label(Role::Button, label).next().expect("the toolbar comes first").click();
        window.run_steps(3);
        assert_eq!(window.state().tool(), tool, "{label}");
    }
    window.get_by_role_and_label(Role::CheckBox, "Frame times").scroll_to_me();
    window.run_steps(3);
    check_box(&mut window, "Frame times");
    assert!(window.state().frame_times.shown);
    press(&mut window, Key::F12);
    assert!(!window.state().frame_times.shown);
}

#[test]
fn buttons_of_the_toolbar_work_as_labelled() {
    let mut window = window("cornell_spheres");
    wait(&mut window, "samples", |app| app.status().spp >= 1);
    click(&mut window, "Step");
    assert!(window.state().budget().paused && window.state().budget().steps == 1);
    click(&mut window, "Resume");
    assert!(!window.state().budget().paused);
    click(&mut window, "1:1");
    click(&mut window, "Fit");
    assert_eq!(window.state().picture_view().zoom, None);
    wait(&mut window, "a full image", App::can_save);
    click(&mut window, "Save image…");
    assert!(window.query_by_label("Save image").is_some());
    click(&mut window, "EXR");
    assert!(window.state().dialogs.save.as_ref().is_some_and(|dialog| dialog.path().ends_with(".exr")));
    click(&mut window, "PNG");
    assert!(window.state().dialogs.save.as_ref().is_some_and(|dialog| dialog.path().ends_with(".png")));
    click(&mut window, "Cancel");
    assert!(window.state().dialogs.save.is_none());
    click(&mut window, "Help");
    assert!(window.state().dialogs.help);
    click(&mut window, "Help");
    assert!(!window.state().dialogs.help);
    click(&mut window, "Gallery");
    assert!(window.state().dialogs.gallery.open);
    press(&mut window, Key::Escape);
    click(&mut window, "Open…");
    click(&mut window, "Cancel");
    assert!(window.state().dialogs.open.is_none());
    // A target that is reached has nothing to step to.
    *window.state_mut().budget_mut() = noisefall_render::render::Budget { max_spp: Some(1), ..Default::default() };
    wait(&mut window, "the target", |app| app.worker().latest().status.spp >= 1 && !matches!(app.status().state, State::Running));
    press(&mut window, Key::Period);
    assert!(window.state().budget().steps == 0 && !window.state().budget().paused);
}

#[test]
fn threads_and_tour_work_as_labelled() {
    let mut window = window("cornell_spheres");
    window.state_mut().session.threads = 2;
    wait(&mut window, "threads", |app| app.worker().threads() == 2);
    window.get_by_role_and_label(Role::Slider, "Threads").set_value_accesskit(1.0);
    wait(&mut window, "a thread", |app| app.worker().threads() == 1);
    window.state_mut().preferences = Preferences::default();
    window.state_mut().start_tour();
    window.run_steps(3);
    restarts(&mut window, "the button of the tour, and not that of the toolbar", |w| {
        w.query_all_by_label("Restart").last().expect("a button").click();
        w.run_steps(2);
    });
    click(&mut window, "Next");
    click(&mut window, "Show bounce 2 alone");
    assert_eq!((window.state().session.bounces.k, window.state().session.bounces.up_to), (2, false));
    click(&mut window, "Back");
    assert_eq!((window.state().dialogs.tour, window.state().tab()), (Some(0), Some(InstrumentTab::Convergence)));
    click(&mut window, "End tour");
    assert!(window.state().dialogs.tour.is_none() && window.state().preferences.now.toured);
    press(&mut window, Key::F6);
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, "Cornell box of spheres").click();
    window.run_steps(2);
    let is_open = |app: &App| app.session.path().is_some_and(|path| path.ends_with("cornell_spheres.toml"));
    wait(&mut window, "the scene of the card", is_open);
}
