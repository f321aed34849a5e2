//! The window itself, driven as a user would: change a control, see the effect.
mod adding;
mod advice;
mod bindings;
mod camera;
mod collision;
mod comparing;
mod denoising;
mod desktop;
mod dialogs;
mod dragging;
mod driven;
mod driving;
mod dropping;
mod edited;
mod editing;
mod estimator;
mod exports;
mod exposure;
mod fields;
mod foreign_scenes;
mod gizmo_keys;
mod glyphs;
mod image_menu;
mod instruments;
mod keyboard;
mod labels;
mod layout;
mod manners;
mod messages;
mod minified;
mod mouse;
mod new_bump;
mod open_dialog;
mod opening;
mod painted;
mod parts;
mod path;
mod popups;
mod presets;
mod progress;
mod random_edits;
mod rasteriser;
mod ratios;
mod recovery;
mod reference;
mod references;
mod reloading;
mod saving;
mod scene_edits;
mod scene_files;
mod scene_parts;
mod scenes;
mod selection;
mod settings;
mod snapshots;
mod soak;
mod steady;
mod table;
mod toolbar;
mod undo;
mod unedited;
mod unused;
mod wording;

use std::{
    ops::{Deref, DerefMut},
    path::PathBuf,
    time::{Duration, Instant},
};

use egui::{Key, Modifiers, PointerButton, Pos2, accesskit::Role, vec2};
use egui_kittest::{
    Harness,
    kittest::{NodeT, Queryable},
};
use glam::DVec3;
use noisefall_base::math::SimdLevel;
use noisefall_render::render::{State, Target, ToneMap, image_file, threads::Threads};
use noisefall_scene::{
    sampling::{Directions, Filter, Sampler},
    scene::{Estimator, Lens, Projection, Reuse, Roulette},
};

use self::driving::*;
use super::{
    app::App,
    background::preferences::Preferences,
    canvas::{framing, interaction::Tool},
    panels::{panel_tabs::PanelTab, subject::Subject},
};

/// As tall as all panels together: what is scrolled out of sight cannot be clicked.
const SIZE: egui::Vec2 = vec2(1280.0, 1380.0);

type Window = Harness<'static, Lazy>;

/// The app, made in the first frame: it needs the context that the harness makes.
struct Lazy(Option<App>);

impl Deref for Lazy {
    type Target = App;
    fn deref(&self) -> &App {
        self.0.as_ref().expect("the harness has drawn a frame")
    }
}

impl DerefMut for Lazy {
    fn deref_mut(&mut self) -> &mut App {
        self.0.as_mut().expect("the harness has drawn a frame")
    }
}

fn shipped(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml"))
}

/// A window in which nothing has happened yet.
fn open(scene: Option<PathBuf>) -> Window {
    open_with(scene, |_| {})
}

/// A window whose app is prepared before its first frame.
fn open_with(scene: Option<PathBuf>, prepare: impl Fn(&mut App) + 'static) -> Window {
    let builder = Harness::builder().with_size(SIZE).renderer(rasteriser::Blind);
    builder.build_ui_state(drawing(scene, prepare), Lazy(None))
}

/// Draws an app that renders on one thread and is prepared before its first frame.
fn drawing(scene: Option<PathBuf>, prepare: impl Fn(&mut App) + 'static) -> impl FnMut(&mut egui::Ui, &mut Lazy) {
    move |ui, app| {
        let make = || {
            let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
            let mut app = App::new(ui.ctx(), threads, scene.clone().into(), Preferences::default());
            prepare(&mut app);
            app
        };
        app.0.get_or_insert_with(make).show(ui);
    }
}

/// A window with a small image of a scene.
fn window(scene: &str) -> Window {
    let mut window = open(Some(shipped(scene)));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [96, 64];
    wait(&mut window, "an image", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 96));
    window
}

/// Frames of the window until a condition holds. The time limit is for a machine that is busy otherwise.
fn wait(window: &mut Window, what: &str, condition: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !condition(window.state()) {
        let error = window.state().dialogs.scene_error.as_deref().unwrap_or_default();
        assert!(start.elapsed() < Duration::from_secs(60), "{what} never came; {:?} {error}", window.state().status());
        std::thread::sleep(Duration::from_millis(2));
        window.step();
    }
}

#[test]
fn the_objects_of_the_scene_are_listed_with_their_materials() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Edit");
    let listed =
        |name: &str| window.get_all_by_role(Role::Button).any(|row| row.accesskit_node().label().as_deref() == Some(name));
    for (name, kind) in [("light", "sphere, no material"), ("amber ball", "sphere, amber"), ("back wall", "sphere, white")] {
        assert!(listed(&format!("{name}{kind}")), "{name}");
    }
    assert_eq!(window.query_all_by_label_contains("sphere, ").count(), 8);
    // The selected one has its size as it was compiled.
    window.state_mut().selection.select(Some(Subject::Object(5)));
    window.run_steps(3);
    assert!(window.query_by_label("0.76 × 0.76 × 0.76 m").is_some());
}

#[test]
fn a_long_title_does_not_push_the_panel_out_of_the_window() {
    let mut window = window("truncation");
    window.run_steps(3);
    let (label, button) = (window.get_by_label("Scene").rect(), window.get_by_label("Open…").rect());
    assert!(label.left() > 1280.0 - 336.0 && button.right() < 1280.0, "{label:?} {button:?}");
}

/// The number of the image that was asked for last: known at once, and not only when the worker has taken it up.
fn generation(window: &Window) -> u64 {
    window.state().worker().generation()
}

/// Does something and waits for an image of what it asked for.
fn restarts(window: &mut Window, what: &str, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    act(window);
    wait(window, what, |app| app.shown_frame().as_ref().is_some_and(|frame| frame.generation > before));
}

/// Does something and makes sure that the render went on, and that of the second view if it is the same.
fn never_restarts(window: &mut Window, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    let second = |window: &Window| (window.state().second_view(), window.state().worker().second_generation());
    let second_before = second(window);
    act(window);
    // A new image is asked for in the frame that finds that it is wanted.
    window.run_steps(20);
    assert_eq!(generation(window), before, "the render was restarted");
    let second = second(window);
    assert!(second.0 != second_before.0 || second.1 == second_before.1, "the second view was restarted");
}

#[test]
fn the_built_in_scene_appears_and_refines() {
    let mut window = open(None);
    wait(&mut window, "a first image", |app| app.shown_frame().is_some());
    wait(&mut window, "samples", |app| app.status().spp >= 2);
    assert_eq!(window.state().status().state, State::Running);
    assert!(window.query_by_label("Running").is_some() && window.query_by_label("unbiased").is_some());
}

#[test]
fn the_pixel_under_the_pointer_is_read_out() {
    let mut window = window("furnace");
    window.hover_at(Pos2::new(400.0, 400.0));
    window.run_steps(2);
    assert!(window.state().hovered().is_some());
    assert!(
        window.get_all_by_role(Role::Label).any(|label| label.accesskit_node().value().is_some_and(|text| text.contains("RGB")))
    );
}

#[test]
fn every_single_key_works_as_the_help_says() {
    let mut window = window("cornell_spheres");
    press(&mut window, Key::C);
    assert_eq!(window.state().tool(), Tool::Camera);
    press(&mut window, Key::P);
    assert_eq!(window.state().tool(), Tool::Picture);
    press(&mut window, Key::Num1);
    assert_eq!(window.state().picture_view().drawn_zoom, 1.0);
    press(&mut window, Key::F);
    assert!(window.state().picture_view().zoom.is_none());
    press(&mut window, Key::CloseBracket);
    press(&mut window, Key::CloseBracket);
    press(&mut window, Key::OpenBracket);
    assert_eq!(window.state().look().display.exposure, 0.5);
    press(&mut window, Key::Space);
    assert!(window.state().budget().paused);
    press(&mut window, Key::Space);
    assert!(!window.state().budget().paused);
    restarts(&mut window, "a restart", restart);
    for (key, axis, sign) in
        [(Key::A, 0, -1.0), (Key::D, 0, 1.0), (Key::Q, 1, -1.0), (Key::E, 1, 1.0), (Key::S, 2, -1.0), (Key::W, 2, 1.0)]
    {
        let before = window.state().camera();
        restarts(&mut window, "flight", |w| {
            w.key_down(key);
            w.run_steps(3);
            w.key_up(key);
            w.run_steps(1);
        });
        let moved = window.state().camera().eye - before.eye;
        assert!(moved.dot(before.axes()[axis]) * sign > 0.0, "{key:?}");
    }
}

#[test]
fn a_bad_scene_shows_its_diagnostic_and_the_window_lives_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bad.toml");
    std::fs::write(&path, "format = 1\ncamera = 3\n").expect("it is written");
    let mut window = open(Some(path));
    wait(&mut window, "the diagnostic", |app| app.dialogs.scene_error.is_some());
    assert!(window.state().dialogs.scene_error.as_ref().is_some_and(|report| report.contains("bad.toml:2:10")));
    window.run_steps(3);
    click(&mut window, "Open the built-in scene");
    wait(&mut window, "the built-in scene", |app| app.opened().is_some() && app.shown_frame().is_some());
}

#[test]
fn scenes_are_chosen_from_the_list() {
    let mut window = window("furnace");
    assert!(window.state().catalogue.iter().any(|entry| entry.name.starts_with("Tiny light")));
    window.get_by_role_and_label(Role::ComboBox, "Scene").click();
    window.run_steps(3);
    click(&mut window, "Bright sky: fast to converge");
    wait(&mut window, "the other scene", |app| app.opened().as_ref().is_some_and(|opened| opened.name.starts_with("Bright sky")));
}

#[test]
fn f1_shows_the_keys_and_escape_hides_them() {
    let mut window = window("furnace");
    window.key_press(Key::F1);
    window.run_steps(3);
    assert!(window.query_by_label("fly down, up").is_some());
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(window.query_by_label("fly down, up").is_none());
}
