//! Every control changes the setting that it names, every key does what it says, and no other.
use std::sync::Arc;

use noisefall::{
    render::{Region, colour_map::ColourMap, view::View as Shown},
    scene::{Camera, RenderSettings},
};

use super::*;
use crate::viewer::canvas::drawing::Split;
use crate::viewer::instruments::{compare::comparison::CompareLayout, tabs::InstrumentTab};

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
}

/// Sets the field of numbers of this name that has this place.
fn set(window: &mut Window, label: &str, place: usize, value: f64) {
    let field = window.get_all_by_role_and_label(Role::SpinButton, label).nth(place).expect("there is such a field");
    field.set_value_accesskit(value);
    window.run_steps(2);
}

fn check_box(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::CheckBox, label).click();
    window.run_steps(2);
}

/// What has changed in the settings, as the scene's with one change.
fn sets(window: &mut Window, label: &str, expected: RenderSettings) {
    click(window, label);
    assert_eq!(window.state().session.settings, expected, "{label}");
}

#[test]
fn every_choice_of_the_estimate_sets_what_it_names() {
    let mut window = window("cornell_spheres");
    let mut expected = window.state().session.settings;
    for (label, estimator) in [("Path", Estimator::Path), ("Light", Estimator::Light), ("MIS", Estimator::Mis)] {
        expected.estimator = estimator;
        sets(&mut window, label, expected);
    }
    for (label, directions) in [("Uniform", Directions::Uniform), ("BSDF", Directions::Bsdf), ("Cosine", Directions::Cosine)] {
        expected.directions = directions;
        sets(&mut window, label, expected);
    }
    for (label, reuse) in [("Always", Reuse::On), ("Auto", Reuse::Auto), ("Never", Reuse::Off)] {
        expected.reuse = reuse;
        sets(&mut window, label, expected);
    }
    for (label, sampler) in [
        ("Independent", Sampler::Independent),
        ("Stratified", Sampler::Stratified),
        ("Sobol (Owen)", Sampler::Sobol),
        ("Sobol, blue noise", Sampler::BlueNoise),
    ] {
        choose(&mut window, "Sampler", label);
        expected.sampler = sampler;
        assert_eq!(window.state().session.settings, expected, "{label}");
    }
    for (label, roulette) in
        [("Off", Roulette::Off), ("Fixed probability", Roulette::fixed(0.8)), ("By throughput", Roulette::BY_THROUGHPUT)]
    {
        choose(&mut window, "Roulette", label);
        expected.roulette = roulette;
        assert_eq!(window.state().session.settings, expected, "{label}");
    }
    check_box(&mut window, "Bounce cap");
    set(&mut window, "Bounce cap", 0, 3.0);
    expected.max_bounces = Some(3);
    assert_eq!(window.state().session.settings, expected);
    set(&mut window, "Bounce cap", 0, -5.0);
    assert_eq!(window.state().session.settings.max_bounces, Some(0), "what is out of range is brought into it");
    check_box(&mut window, "Bounce cap");
    expected.max_bounces = None;
    check_box(&mut window, "Adaptive");
    expected.adaptive = true;
    assert_eq!(window.state().session.settings, expected);
}

#[test]
fn every_number_of_the_camera_is_its_own() {
    let mut window = window("cornell_spheres");
    let start = window.state().session.camera;
    let mut expected = start;
    for (i, label) in ["Eye", "Look at", "Up"].into_iter().enumerate() {
        for axis in 0..3 {
            // Up stays away from the direction of view.
            let value = 0.125 * (1 + 3 * i + axis) as f64 + if i == 2 && axis == 1 { 5.0 } else { 0.0 };
            set(&mut window, label, axis, value);
            [&mut expected.eye, &mut expected.look_at, &mut expected.up][i][axis] = value;
            assert_eq!(window.state().session.camera, expected, "{label} {axis}");
        }
    }
    for (axis, side) in [72, 40].into_iter().enumerate() {
        set(&mut window, "Resolution", axis, f64::from(side));
        expected.resolution[axis] = side;
        assert_eq!(window.state().session.camera, expected);
    }
    for (label, filter) in [("Tent", Filter::TENT), ("Gaussian", Filter::GAUSSIAN), ("Box", Filter::Box)] {
        click(&mut window, label);
        expected.filter = filter;
        assert_eq!(window.state().session.camera, expected, "{label}");
    }
    set(&mut window, "Lens radius", 0, 0.25);
    let distance = expected.eye.distance(expected.look_at);
    assert_eq!(window.state().session.camera.lens, Some(Lens { radius: 0.25, focus: distance }), "in focus is what is looked at");
    set(&mut window, "Focus", 0, 7.0);
    // Not by the pointer: beside a number that has just become shorter the button moves.
    window.get_by_label("Look-at point").click_accesskit();
    window.run_steps(3);
    assert_eq!(window.state().session.camera.lens, Some(Lens { radius: 0.25, focus: distance }));
    let width = expected.width_at_look_at();
    click(&mut window, "Orthographic");
    assert_eq!(window.state().session.camera, Camera { orthographic: Some(width), ..expected });
    set(&mut window, "Width", 0, 3.5);
    assert_eq!(window.state().session.camera.orthographic, Some(3.5));
    click(&mut window, "Perspective");
    window.state_mut().session.camera.resolution = start.resolution;
    assert_eq!(window.state().session.camera, Camera { resolution: start.resolution, ..expected });
    click(&mut window, "Back to the scene's camera");
    let home = window.state().session.opened.as_ref().expect("it is open").scene.camera;
    assert_eq!(window.state().session.camera, home);
}

#[test]
fn targets_are_in_the_units_that_they_say() {
    let mut window = window("bright_sky");
    window.state_mut().session.budget.paused = true;
    let scene = window.state().session.opened.as_ref().expect("it is open").scene.clone();
    assert_eq!(window.state().session.budget.max_spp, scene.spp);
    if scene.spp.is_none() {
        check_box(&mut window, "Stop at");
    }
    check_box(&mut window, "Stop after");
    check_box(&mut window, "Stop below");
    set(&mut window, "Stop at", 0, 77.0);
    set(&mut window, "Stop after", 0, 1.0);
    set(&mut window, "Stop below", 0, 2.5);
    let budget = window.state().session.budget;
    assert_eq!((budget.max_spp, budget.max_time), (Some(77), Some(Duration::from_secs(1))));
    assert!((budget.noise.expect("it is set") - 0.025).abs() < 1e-12, "percent");
    assert!(window.query_by_label("second").is_some() && window.query_by_label("spp").is_some());
    assert!(window.query_all_by_label_contains(" / 77 spp").count() > 0, "the target is in the line below");
    for label in ["Stop at", "Stop after", "Stop below"] {
        check_box(&mut window, label);
    }
    let budget = window.state().session.budget;
    assert_eq!((budget.max_spp, budget.max_time, budget.noise), (None, None, None));
}

#[test]
fn a_region_has_four_numbers_and_stays_within_the_picture() {
    let mut window = window("cornell_spheres");
    check_box(&mut window, "Region");
    assert_eq!(window.state().session.budget.region, Some(Region { from: [24, 16], to: [73, 49] }), "the middle of 96 × 64");
    for (label, value) in [("x from, in pixels", 5), ("y from, in pixels", 6), ("x to, in pixels", 70), ("y to, in pixels", 60)] {
        set(&mut window, label, 0, f64::from(value));
    }
    let region = Region { from: [5, 6], to: [70, 60] };
    assert_eq!(window.state().session.budget.region, Some(region));
    set(&mut window, "x to, in pixels", 0, 5.0);
    assert_eq!(window.state().session.budget.region, Some(region), "an empty region is none");
    window.state_mut().session.camera.resolution = [48, 32];
    window.run_steps(3);
    assert_eq!(window.state().session.budget.region, Some(Region { from: [5, 6], to: [48, 32] }));
    click(&mut window, "Clear");
    assert_eq!(window.state().session.budget.region, None);
}

#[test]
fn what_is_shown_is_chosen_by_lists_buttons_and_keys() {
    let mut window = window("cornell_spheres");
    for (map, name, _) in ColourMap::CHOICE.into_iter().rev() {
        click(&mut window, name);
        assert_eq!(window.state().session.look.map, map);
    }
    for (tone_map, name) in ToneMap::ALL.map(|map| (map, map.title())).into_iter().rev() {
        choose(&mut window, "Tone map", name);
        assert_eq!(window.state().session.look.display.tone_map, tone_map);
    }
    for view in Shown::ALL.into_iter().skip(1).chain([Shown::ALL[0]]) {
        press(&mut window, Key::V);
        assert_eq!(window.state().session.look.view, view);
    }
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.run_steps(3);
    assert_eq!(window.state().session.look.view, Shown::ALL[Shown::ALL.len() - 1], "the one before");
    for (key, tab) in [
        (Key::F2, InstrumentTab::Convergence),
        (Key::F3, InstrumentTab::Compare),
        (Key::F4, InstrumentTab::Bounces),
        (Key::F5, InstrumentTab::Path),
    ] {
        press(&mut window, key);
        assert_eq!(window.state().window.tab, Some(tab));
        press(&mut window, key);
        assert_eq!(window.state().window.tab, None);
    }
    for (label, tab) in [
        ("Convergence", InstrumentTab::Convergence),
        ("Compare", InstrumentTab::Compare),
        ("Bounces", InstrumentTab::Bounces),
        ("Pixel", InstrumentTab::Path),
    ] {
        window.get_by_role_and_label(Role::Button, label).click();
        window.run_steps(3);
        assert_eq!(window.state().window.tab, Some(tab), "{label}");
    }
    press(&mut window, Key::F5);
    let tools = [("Region", Key::G, Tool::Region), ("Inspect", Key::I, Tool::Inspect), ("Camera", Key::C, Tool::Camera)];
    for (label, key, tool) in tools.into_iter().chain([("Picture", Key::P, Tool::Picture)]) {
        press(&mut window, key);
        assert_eq!(window.state().window.tool, tool);
        press(&mut window, if tool == Tool::Picture { Key::C } else { Key::P });
        window.get_all_by_role_and_label(Role::Button, label).next().expect("the toolbar comes first").click();
        window.run_steps(3);
        assert_eq!(window.state().window.tool, tool, "{label}");
    }
    check_box(&mut window, "Frame times");
    assert!(window.state().frame_times.shown);
    press(&mut window, Key::F12);
    assert!(!window.state().frame_times.shown);
}

#[test]
fn buttons_of_the_toolbar_do_what_they_say() {
    let mut window = window("cornell_spheres");
    wait(&mut window, "samples", |app| app.results.status.spp >= 1);
    click(&mut window, "Step");
    assert!(window.state().session.budget.paused && window.state().session.budget.steps == 1);
    click(&mut window, "Resume");
    assert!(!window.state().session.budget.paused);
    click(&mut window, "1:1");
    click(&mut window, "Fit");
    assert_eq!(window.state().window.view.zoom, None);
    wait(&mut window, "a full picture", App::can_save);
    click(&mut window, "Save…");
    assert!(window.query_by_label("Save picture").is_some());
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
    window.state_mut().session.budget = noisefall::render::Budget { max_spp: Some(1), ..Default::default() };
    wait(&mut window, "the target", |app| {
        app.background.worker.latest().status.spp >= 1 && !matches!(app.results.status.state, State::Running)
    });
    press(&mut window, Key::Period);
    assert!(window.state().session.budget.steps == 0 && !window.state().session.budget.paused);
}

#[test]
fn escape_closes_one_thing_after_the_other() {
    let mut window = window("cornell_spheres");
    let app = window.state_mut();
    app.session.budget.region = Some(Region::between([1, 1], [20, 20]));
    app.tell("a message".to_owned(), true);
    app.dialogs.help = true;
    app.start_tour();
    window.run_steps(2);
    let left = |window: &Window| {
        let app = window.state();
        [app.dialogs.tour.is_some(), app.dialogs.help, !app.dialogs.notices.0.is_empty(), app.session.budget.region.is_some()]
            .map(u8::from)
    };
    assert_eq!(left(&window), [1, 1, 1, 1]);
    for expected in [[0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1], [0, 0, 0, 0]] {
        press(&mut window, Key::Escape);
        assert_eq!(left(&window), expected);
    }
}

#[test]
fn good_news_go_away_and_errors_stay_until_they_are_closed() {
    let mut window = window("furnace");
    let app = window.state_mut();
    app.tell("an error".to_owned(), true);
    app.tell("good news".to_owned(), false);
    app.tell("another error".to_owned(), true);
    app.tell("an error".to_owned(), true);
    let texts = |window: &Window| window.state().dialogs.notices.0.iter().map(|notice| notice.text.clone()).collect::<Vec<_>>();
    assert_eq!(texts(&window), ["good news", "another error", "an error"], "the same is said once");
    let start = window.ctx.input(|input| input.time);
    while window.ctx.input(|input| input.time) < start + 5.5 {
        window.step();
    }
    assert_eq!(texts(&window).len(), 3);
    while window.ctx.input(|input| input.time) < start + 7.0 {
        window.step();
    }
    assert_eq!(texts(&window), ["another error", "an error"]);
    window.get_all_by_label("Close").next().expect("each has a button").click();
    window.run_steps(2);
    assert_eq!(texts(&window), ["an error"]);
    (0..9).for_each(|number| window.state_mut().tell(format!("error {number}"), true));
    assert_eq!(texts(&window), ["error 5", "error 6", "error 7", "error 8"]);
}

#[test]
fn another_scene_takes_everything_over_and_the_same_one_keeps_the_exposure() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(shipped("furnace")).expect("it is shipped");
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, text.replace("[render]", "[render]\nspp = 5\nseed = 3")).expect("it is written");
    let mut window = window("cornell_spheres");
    wait(&mut window, "a full picture", App::can_save);
    click(&mut window, "Pin this");
    assert!(window.state().session.pinned.is_some());
    let app = window.state_mut();
    app.session.look.display.exposure = 2.0;
    app.window.view.actual_size();
    app.session.budget = noisefall::render::Budget { paused: true, steps: 7, noise: Some(0.1), ..Default::default() };
    let other = RenderSettings { seed: 8, ..app.session.settings };
    app.start_comparison(other);
    app.instruments.path.look_at([3, 4]);
    app.dialogs.scene_error = Some("the file before it was broken".to_owned());
    assert!(app.results.last_seeing.is_some());
    app.background.loader.open(Some(path.clone()));
    wait(&mut window, "my scene", |app| app.session.settings.seed == 3);
    let app = window.state();
    let scene = &app.session.opened.as_ref().expect("it is open").scene;
    assert_eq!((app.session.camera, app.session.settings), (scene.camera, scene.settings));
    assert_eq!(app.session.budget, noisefall::render::Budget { max_spp: Some(5), steps: 7, ..Default::default() });
    assert!(
        app.session.comparison.is_none()
            && app.session.pinned.is_none()
            && app.instruments.path.pixel.is_none()
            && app.window.view.zoom.is_none()
    );
    assert!(app.dialogs.scene_error.is_none() && app.results.last_seeing.is_none());
    assert_eq!(app.session.look.display.exposure, 0.0);
    window.state_mut().session.look.display.exposure = 1.5;
    window.state_mut().session.settings.seed = 9;
    window.state_mut().background.loader.open(Some(path));
    wait(&mut window, "my scene again", |app| app.session.settings.seed == 3);
    assert_eq!(window.state().session.look.display.exposure, 1.5);
}

/// A file that is dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }
    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("the window asks for the path only".to_owned())
    }
}

#[test]
fn a_dropped_file_is_a_scene_a_picture_with_its_scene_or_a_reference() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    let drop_file = |window: &mut Window, path: PathBuf| {
        window.input_mut().dropped_files.push(Arc::new(Dropped(path)));
        window.step();
    };
    wait(&mut window, "a full picture", App::can_save);
    let [reference, picture] = ["reference.EXR", "picture.png"].map(|name| {
        let path = folder.path().join(name);
        window.state_mut().save_to(path.clone());
        wait(&mut window, "the file", |app| app.window.last_saved.as_ref() == Some(&path));
        path
    });
    drop_file(&mut window, reference);
    wait(&mut window, "the reference", |app| app.session.dropped_reference.is_some());
    assert_eq!(window.state().session.dropped_reference.as_ref().map(|truth| truth.camera), Some(window.state().session.camera));
    drop_file(&mut window, shipped("furnace"));
    wait(&mut window, "the scene", |app| app.session.opened.as_ref().is_some_and(|opened| opened.name == "Furnace"));
    assert!(window.state().session.dropped_reference.is_none(), "it was of the other scene");
    drop_file(&mut window, picture.clone());
    wait(&mut window, "the scene of the picture", |app| {
        app.session.opened.as_ref().is_some_and(|opened| opened.path.as_ref() == Some(&picture))
    });
    let of_picture = window.state().session.opened.as_ref().map(|opened| opened.scene.objects.len());
    assert_eq!(of_picture, noisefall::scene::load(&shipped("cornell_spheres")).ok().map(|scene| scene.objects.len()));
}

#[test]
fn threads_and_tour_do_what_they_say() {
    let mut window = window("cornell_spheres");
    window.state_mut().session.threads = 2;
    wait(&mut window, "threads", |app| app.background.worker.threads() == 2);
    window.get_by_role_and_label(Role::Slider, "Threads").set_value_accesskit(1.0);
    wait(&mut window, "a thread", |app| app.background.worker.threads() == 1);
    window.state_mut().preferences = Preferences::default();
    window.state_mut().start_tour();
    window.run_steps(3);
    restarts(&mut window, "a start over", |w| click(w, "Start over"));
    click(&mut window, "Next");
    click(&mut window, "Show bounce 2 alone");
    assert_eq!((window.state().session.bounces.k, window.state().session.bounces.up_to), (2, false));
    click(&mut window, "Back");
    assert_eq!((window.state().dialogs.tour, window.state().window.tab), (Some(0), Some(InstrumentTab::Convergence)));
    click(&mut window, "End tour");
    assert!(window.state().dialogs.tour.is_none() && window.state().preferences.now.toured);
    press(&mut window, Key::F6);
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, "Five-sphere Cornell box (built-in)").click();
    window.run_steps(2);
    wait(&mut window, "the built-in scene", |app| app.session.opened.as_ref().is_some_and(|opened| opened.path.is_none()));
}

#[test]
fn sides_of_a_comparison_are_swapped_kept_and_laid_out() {
    let mut window = window("cornell_spheres");
    let a = window.state().session.settings;
    let b = RenderSettings { seed: 5, ..a };
    window.state_mut().start_comparison(b);
    window.run_steps(3);
    let sides = |window: &Window| {
        (window.state().session.settings.seed, window.state().session.comparison.map(|compare| compare.other.seed))
    };
    click(&mut window, "Swap");
    assert_eq!(sides(&window), (5, Some(a.seed)));
    click(&mut window, "Swap");
    for (label, layout, split) in [
        ("Side by side", CompareLayout::SideBySide, Split::SideBySide),
        ("Difference", CompareLayout::Difference, Split::None),
        ("Wipe", CompareLayout::Wipe, Split::Wipe),
    ] {
        click(&mut window, label);
        let chosen = window.state().session.comparison.expect("it compares").layout;
        assert_eq!((chosen, chosen.split()), (layout, split), "{label}");
    }
    click(&mut window, "Side by side");
    window.state_mut().start_comparison(RenderSettings { seed: 6, ..a });
    assert_eq!(
        window.state().session.comparison.map(|compare| compare.layout),
        Some(CompareLayout::SideBySide),
        "the layout stays"
    );
    window.run_steps(3);
    // Settings of A or of B: the panel changes one of them.
    for (label, expected) in [("B", (a.seed, Some(9))), ("A", (9, Some(9)))] {
        window.get_by_role_and_label(Role::Button, label).click();
        window.run_steps(2);
        set(&mut window, "Seed", 0, 9.0);
        assert_eq!(sides(&window), expected, "{label}");
    }
    window.state_mut().session.settings.seed = 1;
    click(&mut window, "Keep A");
    assert_eq!(sides(&window), (1, None));
}

#[test]
fn the_menu_of_comparisons_changes_what_it_names() {
    let mut window = window("cornell_spheres");
    let of = window.state().session.settings;
    for (label, other) in [
        ("Path sampling", RenderSettings { estimator: Estimator::Path, ..of }),
        ("Light sampling", RenderSettings { estimator: Estimator::Light, ..of }),
        ("Independent samples", RenderSettings { sampler: Sampler::Independent, ..of }),
        ("No roulette", RenderSettings { roulette: Roulette::Off, ..of }),
        ("Roulette of 0.8", RenderSettings { roulette: Roulette::fixed(0.8), ..of }),
        ("Shared paths", RenderSettings { reuse: Reuse::On, ..of }),
        ("Paths of their own", RenderSettings { reuse: Reuse::Off, ..of }),
        ("A cap of 3 bounces", RenderSettings { max_bounces: Some(3), ..of }),
        ("Another seed", RenderSettings { seed: of.seed + 1, ..of }),
    ] {
        window.get_all_by_label("Compare with…").next().expect("the toolbar has it").click();
        window.run_steps(3);
        click(&mut window, label);
        assert_eq!(window.state().session.comparison.map(|compare| compare.other), Some(other), "{label}");
        assert_eq!(window.state().session.settings, of);
    }
}

#[test]
fn advice_for_another_view_is_given_up() {
    let mut window = window("furnace");
    wait(&mut window, "a picture", |app| app.results.status.spp >= 1);
    click(&mut window, "What should I use here?");
    assert!(window.state().is_studying());
    window.state_mut().session.camera.fov = 33.0;
    window.run_steps(2);
    assert!(window.state().background.adviser.is_none());
}
