//! The window itself, driven as a user would: change a control, see the effect.
mod fields;
mod scenes;

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
use noisefall::{
    math::SimdLevel,
    render::{State, ToneMap, image_file, pass::Threads},
    sampling::{Directions, Filter, Sampler},
    scene::{Estimator, Lens, Roulette},
};

use super::{app::App, canvas::Tool};

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
    let draw = move |ui: &mut egui::Ui, app: &mut Lazy| {
        let make = || App::new(ui.ctx(), Threads::new(1, SimdLevel::best()).expect("a thread can be had"), scene.clone());
        app.0.get_or_insert_with(make).show(ui);
    };
    Harness::builder().with_size(vec2(1280.0, 800.0)).build_ui_state(draw, Lazy(None))
}

/// A window with a small picture of a scene.
fn window(scene: &str) -> Window {
    let mut window = open(Some(shipped(scene)));
    wait(&mut window, "the scene", |app| app.opened.is_some());
    window.state_mut().camera.resolution = [96, 64];
    wait(&mut window, "a picture", |app| app.shown.as_ref().is_some_and(|frame| frame.width == 96));
    window
}

/// Frames of the window until a condition holds. The time limit is for a machine that is busy otherwise.
fn wait(window: &mut Window, what: &str, condition: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !condition(window.state()) {
        assert!(start.elapsed() < Duration::from_secs(60), "{what} never came; {:?}", window.state().status);
        std::thread::sleep(Duration::from_millis(2));
        window.step();
    }
}

#[test]
fn the_objects_of_the_scene_are_listed_with_their_materials() {
    let window = window("cornell_spheres");
    assert!(window.query_by_label("black, lamp").is_some());
    assert_eq!(window.query_all_by_label("lambertian").count(), 7);
}

#[test]
fn a_long_title_does_not_push_the_panel_out_of_the_window() {
    let mut window = window("truncation");
    window.run_steps(3);
    let (label, button) = (window.get_by_label("Scene").rect(), window.get_by_label("Open…").rect());
    assert!(label.left() > 1280.0 - 336.0 && button.right() < 1280.0, "{label:?} {button:?}");
}

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn choose(window: &mut Window, combo: &str, item: &str) {
    window.get_by_role_and_label(Role::ComboBox, combo).click();
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, item).click();
    window.run_steps(3);
}

fn generation(window: &Window) -> u64 {
    window.state().status.generation
}

/// Does something and waits for a picture of what it asked for.
fn restarts(window: &mut Window, what: &str, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    act(window);
    wait(window, what, |app| app.shown.as_ref().is_some_and(|frame| frame.generation > before));
}

/// Does something and makes sure that the render went on.
fn never_restarts(window: &mut Window, act: impl FnOnce(&mut Window)) {
    let before = generation(window);
    act(window);
    for _ in 0..20 {
        window.step();
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(generation(window), before, "the render was restarted");
}

#[test]
fn the_built_in_scene_appears_and_refines() {
    let mut window = open(None);
    wait(&mut window, "a first picture", |app| app.shown.is_some());
    wait(&mut window, "samples", |app| app.status.spp >= 2);
    assert_eq!(window.state().status.state, State::Running);
    assert!(window.query_by_label("Running").is_some() && window.query_by_label("unbiased").is_some());
}

#[test]
fn every_setting_of_the_estimate_starts_a_new_picture() {
    let mut window = window("cornell_spheres");
    restarts(&mut window, "stratified", |w| choose(w, "Sampler", "Stratified"));
    assert_eq!(window.state().settings.sampler, Sampler::Stratified);
    restarts(&mut window, "light sampling alone", |w| click(w, "Light"));
    assert_eq!(window.state().settings.estimator, Estimator::Light);
    restarts(&mut window, "paths alone", |w| click(w, "Path"));
    assert_eq!(window.state().settings.estimator, Estimator::Path);
    restarts(&mut window, "uniform directions", |w| click(w, "Uniform"));
    assert_eq!(window.state().settings.directions, Directions::Uniform);
    restarts(&mut window, "cosine directions", |w| click(w, "Cosine"));
    restarts(&mut window, "fixed roulette", |w| choose(w, "Roulette", "Fixed probability"));
    assert!(matches!(window.state().settings.roulette, Roulette::Fixed(_)));
    restarts(&mut window, "another survival probability", |w| {
        w.get_by_role_and_label(Role::Slider, "Survival").set_value_accesskit(0.5);
        w.run_steps(2);
    });
    assert_eq!(window.state().settings.roulette, Roulette::Fixed(0.5));
    restarts(&mut window, "no roulette", |w| choose(w, "Roulette", "Off"));
    restarts(&mut window, "a cap", |w| {
        w.get_by_role_and_label(Role::CheckBox, "Bounce cap").click();
        w.run_steps(2);
    });
    assert!(window.query_by_label("biased: cap at 8").is_some(), "the badge says what the cap does");
    restarts(&mut window, "another seed", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Seed").set_value_accesskit(42.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().settings.seed, 42);
}

#[test]
fn the_camera_moves_by_numbers_by_mouse_and_by_keys() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera;
    restarts(&mut window, "another field of view", |w| {
        w.get_by_role_and_label(Role::Slider, "Field of view").set_value_accesskit(60.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera.fov, 60.0);
    restarts(&mut window, "a pixel filter", |w| click(w, "Gaussian"));
    assert_eq!(window.state().camera.filter, Filter::GAUSSIAN);
    restarts(&mut window, "a lens", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Lens radius").set_value_accesskit(0.05);
        w.run_steps(2);
    });
    restarts(&mut window, "another focus", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Focus").set_value_accesskit(2.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera.lens, Some(Lens { radius: 0.05, focus: 2.0 }));
    restarts(&mut window, "parallel rays", |w| click(w, "Orthographic"));
    assert!(window.state().camera.orthographic.is_some() && window.state().camera.lens.is_none());
    restarts(&mut window, "perspective", |w| click(w, "Perspective"));
    window.get_by_role_and_label(Role::Button, "Camera").click();
    window.run_steps(3);
    assert_eq!(window.state().tool, Tool::Camera);
    restarts(&mut window, "an orbit", |w| drag(w, PointerButton::Primary, [400.0, 400.0], [440.0, 420.0]));
    let orbited = window.state().camera;
    assert!((orbited.eye.distance(orbited.look_at) - start.eye.distance(start.look_at)).abs() < 1e-9);
    assert_ne!(orbited.eye, start.eye);
    restarts(&mut window, "a pan", |w| drag(w, PointerButton::Secondary, [400.0, 400.0], [380.0, 400.0]));
    assert_ne!(window.state().camera.look_at, start.look_at);
    let distance = |window: &Window| window.state().camera.eye.distance(window.state().camera.look_at);
    let before = distance(&window);
    restarts(&mut window, "a dolly", |w| scroll(w, [400.0, 400.0], 40.0));
    assert!(distance(&window) < before);
    let before = window.state().camera;
    restarts(&mut window, "flight", |w| {
        w.key_down(Key::W);
        w.run_steps(5);
        w.key_up(Key::W);
        w.run_steps(2);
    });
    let moved = window.state().camera.eye - before.eye;
    assert!(moved.normalize().dot(before.axes()[2]) > 0.999, "W flies forwards");
    restarts(&mut window, "the scene's camera", |w| {
        w.key_press(Key::Home);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera.eye, start.eye);
}

#[test]
fn eye_look_at_up_and_resolution_can_be_typed() {
    let mut window = window("cornell_spheres");
    for (what, label) in [("an eye", "Eye"), ("a look-at", "Look at"), ("an up", "Up")] {
        restarts(&mut window, what, |w| {
            w.get_all_by_role_and_label(Role::SpinButton, label).next().expect("x comes first").set_value_accesskit(0.25);
            w.run_steps(2);
        });
    }
    let camera = window.state().camera;
    assert_eq!((camera.eye.x, camera.look_at.x, camera.up.x), (0.25, 0.25, 0.25));
    restarts(&mut window, "a width", |w| {
        w.get_all_by_role_and_label(Role::SpinButton, "Resolution")
            .next()
            .expect("the width comes first")
            .set_value_accesskit(120.0);
        w.run_steps(2);
    });
    wait(&mut window, "the new width", |app| app.shown.as_ref().is_some_and(|frame| frame.width == 120 && frame.height == 64));
}

#[test]
fn display_settings_zoom_and_target_never_restart() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        w.get_by_role_and_label(Role::Slider, "Exposure").set_value_accesskit(2.0);
        choose(w, "Tone map", "Reinhard");
    });
    assert_eq!(window.state().display.exposure, 2.0);
    assert_eq!(window.state().display.tone_map, ToneMap::Reinhard);
    let fitted = window.state().view.drawn_zoom;
    never_restarts(&mut window, |w| scroll(w, [400.0, 400.0], 50.0));
    assert!(window.state().view.drawn_zoom > fitted);
    never_restarts(&mut window, |w| drag(w, PointerButton::Primary, [400.0, 400.0], [300.0, 400.0]));
    assert!(window.state().view.offset.x > 0.0);
    never_restarts(&mut window, |w| click(w, "1:1"));
    assert_eq!(window.state().view.drawn_zoom, 1.0);
    never_restarts(&mut window, |w| {
        w.get_by_role_and_label(Role::CheckBox, "Stop at").click();
        w.run_steps(2);
    });
    assert_eq!(window.state().budget.max_spp, Some(1024));
}

#[test]
fn pause_step_resume_and_restart_do_so() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Pause");
    wait(&mut window, "the pause", |app| app.status.state == State::Paused);
    let paused = window.state().status.clone();
    window.key_press(Key::Period);
    wait(&mut window, "a step", |app| app.status.spp == paused.spp + 1);
    never_restarts(&mut window, |w| click(w, "Resume"));
    wait(&mut window, "more samples", |app| app.status.spp > paused.spp + 2);
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
}

#[test]
fn a_reached_target_converges_and_a_higher_one_goes_on() {
    let mut window = window("bright_sky");
    window.state_mut().budget.max_spp = Some(3);
    restarts(&mut window, "a restart", |w| click(w, "Restart"));
    wait(&mut window, "the target", |app| app.status.state == State::Converged);
    assert_eq!(window.state().status.spp, 3);
    never_restarts(&mut window, |w| w.state_mut().budget.max_spp = Some(5));
    wait(&mut window, "the next target", |app| app.status.spp == 5 && app.status.state == State::Converged);
    assert!(window.query_by_label("Converged").is_some());
}

#[test]
fn the_pixel_under_the_pointer_is_read_out() {
    let mut window = window("furnace");
    window.hover_at(Pos2::new(400.0, 400.0));
    window.run_steps(2);
    assert!(window.state().hovered.is_some());
    assert!(
        window.get_all_by_role(Role::Label).any(|label| label.accesskit_node().value().is_some_and(|text| text.contains("RGB")))
    );
}

#[test]
fn ctrl_s_saves_what_is_shown_where_the_path_field_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shot.exr");
    let mut window = window("cornell_spheres");
    window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    window.run_steps(4);
    let field = window.get_by_role(Role::TextInput);
    field.set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    click(&mut window, "Save");
    wait(&mut window, "the file", |app| app.last_saved.is_some());
    let saved = image_file::read(&path).expect("it is a picture");
    assert_eq!([saved.width, saved.height], [96, 64]);
    assert!(window.state().notice.as_ref().is_some_and(|notice| !notice.is_error));
    window.state_mut().save_to(folder.path().join("nowhere/shot.png"));
    wait(&mut window, "the refusal", |app| app.notice.as_ref().is_some_and(|notice| notice.is_error));
}

#[test]
fn a_path_that_cannot_be_written_to_is_refused_in_the_dialog() {
    let mut window = window("furnace");
    window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).set_text_value_accesskit("/nowhere/at/all.png");
    window.run_steps(3);
    click(&mut window, "Save");
    assert!(window.state().save_dialog.is_some(), "the dialog stays");
    assert!(window.query_by_label_contains("there is no folder").is_some());
    window.key_press(Key::Escape);
    window.run_steps(2);
    assert!(window.state().save_dialog.is_none());
}

#[test]
fn saving_never_moves_the_camera() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        w.key_down_modifiers(Modifiers::COMMAND, Key::S);
        w.run_steps(1);
        // Ctrl is up again, S is still down.
        w.key_down(Key::S);
        w.run_steps(3);
    });
    assert!(window.state().save_dialog.is_some());
}

#[test]
fn every_single_key_does_what_the_help_says() {
    let mut window = window("cornell_spheres");
    let press = |window: &mut Window, key| {
        window.key_press(key);
        window.run_steps(3);
    };
    press(&mut window, Key::C);
    assert_eq!(window.state().tool, Tool::Camera);
    press(&mut window, Key::P);
    assert_eq!(window.state().tool, Tool::Picture);
    press(&mut window, Key::Num1);
    assert_eq!(window.state().view.drawn_zoom, 1.0);
    press(&mut window, Key::F);
    assert!(window.state().view.zoom.is_none());
    press(&mut window, Key::CloseBracket);
    press(&mut window, Key::CloseBracket);
    press(&mut window, Key::OpenBracket);
    assert_eq!(window.state().display.exposure, 0.5);
    press(&mut window, Key::Space);
    assert!(window.state().budget.paused);
    press(&mut window, Key::Space);
    assert!(!window.state().budget.paused);
    restarts(&mut window, "a restart", |w| press(w, Key::R));
    for (key, axis, sign) in
        [(Key::A, 0, -1.0), (Key::D, 0, 1.0), (Key::Q, 1, -1.0), (Key::E, 1, 1.0), (Key::S, 2, -1.0), (Key::W, 2, 1.0)]
    {
        let before = window.state().camera;
        restarts(&mut window, "flight", |w| {
            w.key_down(key);
            w.run_steps(3);
            w.key_up(key);
            w.run_steps(1);
        });
        let moved = window.state().camera.eye - before.eye;
        assert!(moved.dot(before.axes()[axis]) * sign > 0.0, "{key:?}");
    }
}

#[test]
fn exposure_and_tone_map_change_what_is_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("bright_sky");
    click(&mut window, "Pause");
    wait(&mut window, "the pause", |app| app.status.state == State::Paused && app.can_save());
    let mut pictures = Vec::new();
    for (i, map) in ["None (sRGB)", "Reinhard", "ACES-like", "False colour"].into_iter().enumerate() {
        choose(&mut window, "Tone map", map);
        let path = folder.path().join(format!("{i}.png"));
        window.state_mut().last_saved = None;
        window.state_mut().save_to(path.clone());
        wait(&mut window, "the file", |app| app.last_saved.is_some());
        pictures.push(image_file::read(&path).expect("it is a picture").radiance);
    }
    for i in 1..pictures.len() {
        assert!(pictures[..i].iter().all(|other| *other != pictures[i]), "tone map {i} shows nothing new");
    }
}

#[test]
fn a_bad_scene_shows_its_diagnostic_and_the_window_lives_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bad.toml");
    std::fs::write(&path, "format = 1\ncamera = 3\n").expect("it is written");
    let mut window = open(Some(path));
    wait(&mut window, "the diagnostic", |app| app.scene_error.is_some());
    assert!(window.state().scene_error.as_ref().is_some_and(|report| report.contains("bad.toml:2:10")));
    window.run_steps(3);
    click(&mut window, "Open the built-in scene");
    wait(&mut window, "the built-in scene", |app| app.opened.is_some() && app.shown.is_some());
}

#[test]
fn scenes_are_chosen_from_the_list() {
    let mut window = window("furnace");
    assert!(window.state().catalogue.iter().any(|entry| entry.name.starts_with("Tiny lamp")));
    window.get_by_role_and_label(Role::ComboBox, "Scene").click();
    window.run_steps(3);
    click(&mut window, "Bright sky: fast to converge");
    wait(&mut window, "the other scene", |app| app.opened.as_ref().is_some_and(|opened| opened.name.starts_with("Bright sky")));
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

fn drag(window: &mut Window, button: PointerButton, from: [f32; 2], to: [f32; 2]) {
    let [from, to] = [from, to].map(Pos2::from);
    let press = |window: &Window, pos, pressed| {
        window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    };
    window.hover_at(from);
    window.run_steps(2);
    press(window, from, true);
    window.run_steps(1);
    for part in 1..=4 {
        window.hover_at(from + (to - from) * (part as f32 / 4.0));
        window.run_steps(1);
    }
    press(window, to, false);
    window.run_steps(2);
}

fn scroll(window: &mut Window, at: [f32; 2], by: f32) {
    window.hover_at(at.into());
    window.run_steps(2);
    window.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Wheel,
        delta: vec2(0.0, by),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(10);
}
