//! Random edits, undo, saves and changes by other programs: in the end the image is that of the saved file.
use noisefall_base::declare::OneOf;
use noisefall_edit::edit::{Document, Tree};
use noisefall_render::render::Budget;
use noisefall_scene::{
    material::Material,
    scene::{RenderSettings, built_in, description::SceneDescription},
    shape::ShapeKind,
};
use rand::{Rng, SeedableRng, rngs::SmallRng, seq::IndexedRandom};

use super::{
    reloading::{settle, write},
    scene_files::{save, window_of_copy},
    *,
};
use crate::viewer::panels::outliner::{Action, New};

const EVENTS: usize = 150;
/// Sets another number of events, for a longer run.
const LONGER: &str = "NOISEFALL_RANDOM_EDITS";
/// More objects, or more materials and textures, would only be slow.
const MOST_OBJECTS: usize = 20;
const MOST_MATERIALS: usize = 30;
/// The rows of the inspector, in the side panel.
const ROWS: [[f32; 2]; 2] = [[1000.0, 1270.0], [420.0, 1280.0]];

fn description(window: &Window) -> &SceneDescription {
    window.state().editor.as_ref().expect("a scene is open").document.description()
}

/// Something a user might do to the scene.
fn event(window: &mut Window, random: &mut SmallRng, path: &PathBuf) {
    let count = description(window).objects.len();
    match random.random_range(0..12) {
        0 if count < MOST_OBJECTS => add_object(window, random),
        0 | 1 => act(window, random, Action::Delete),
        2 => add_material(window, random),
        3 => act(window, random, Action::Duplicate),
        4 => {
            let materials: Vec<String> = description(window).materials.keys().cloned().collect();
            let material = materials.choose(random).cloned();
            act(window, random, Action::AssignMaterial(material));
        }
        5 => change_material(window, random),
        6 | 7 => drag_in_inspector(window, random),
        8 | 9 => undo(window),
        10 => redo(window),
        _ if random.random() => save_over_changes(window, random, path),
        _ => change_outside(window, random, path),
    }
    window.run_steps(1);
}

fn add_object(window: &mut Window, random: &mut SmallRng) {
    let kinds = ["sphere", "cuboid", "cylinder", "disk", "rectangle", "triangle", "ellipsoid"];
    let kind = *kinds.choose(random).expect("there are kinds");
    let kind = ShapeKind::alternatives().iter().map(OneOf::name).find(|name| *name == kind).unwrap_or("sphere");
    window.state_mut().add(if random.random_range(0..4) == 0 { New::AreaLight(kind) } else { New::Shape(kind) });
}

fn add_material(window: &mut Window, random: &mut SmallRng) {
    let SceneDescription { materials, textures, .. } = description(window);
    if materials.len() + textures.len() < MOST_MATERIALS {
        return window.state_mut().add(if random.random() { New::Material } else { New::Texture });
    }
    let names = materials.keys().cloned().map(Subject::Material).chain(textures.keys().cloned().map(Subject::Texture));
    let names: Vec<Subject> = names.collect();
    // Those that something uses stay.
    window.state_mut().act_on(names.choose(random).expect("there are many").clone(), Action::Delete);
}

fn random_object(window: &Window, random: &mut SmallRng) -> Option<Subject> {
    let count = description(window).objects.len();
    (count > 0).then(|| Subject::Object(random.random_range(0..count)))
}

fn act(window: &mut Window, random: &mut SmallRng, action: Action) {
    if let Some(object) = random_object(window, random) {
        window.state_mut().act_on(object, action);
    }
}

fn change_material(window: &mut Window, random: &mut SmallRng) {
    let names: Vec<String> = description(window).materials.keys().cloned().collect();
    let kinds: Vec<&str> = Material::alternatives().iter().map(OneOf::name).collect();
    if let (Some(name), Some(kind)) = (names.choose(random), kinds.choose(random)) {
        window.state_mut().act_on(Subject::Material(name.clone()), Action::ChangeKind(kind));
    }
}

/// Drags across the rows of a part, wherever they are.
fn drag_in_inspector(window: &mut Window, random: &mut SmallRng) {
    let names: Vec<String> = description(window).materials.keys().cloned().collect();
    let material = names.choose(random).cloned().map(Subject::Material);
    let subject = if random.random() { material } else { random_object(window, random) };
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.state_mut().selection.select(subject);
    window.run_steps(2);
    let mut place = || ROWS.map(|[from, to]| random.random_range(from..to));
    let from = place();
    let to = [place()[0], from[1]];
    drag(window, PointerButton::Primary, from, to);
    // Closes a menu that the click may have opened.
    window.key_press(Key::Escape);
    window.run_steps(2);
}

fn save_over_changes(window: &mut Window, random: &mut SmallRng, path: &PathBuf) {
    save(window);
    answer(window, random);
    let text = std::fs::read_to_string(path).expect("it is there");
    let read = Document::open(path, &text);
    assert!(read.is_ok(), "{}\n{text}", read.err().map(|error| error.report()).unwrap_or_default());
}

fn change_outside(window: &mut Window, random: &mut SmallRng, path: &PathBuf) {
    let text = std::fs::read_to_string(path).expect("it is there");
    let [x, y] = [(); 2].map(|()| random.random_range(-0.4..0.4));
    let added = format!("{text}\n[[objects]]\nname = 'outside'\nshape.sphere = {{ center = [{x}, {y}, 0.0], radius = 0.05 }}\n");
    write(window, path, &added);
    answer(window, random);
}

/// Answers the question about the file, if it is asked.
fn answer(window: &mut Window, random: &mut SmallRng) {
    settle(window);
    if let Some(conflict) = &window.state().dialogs.conflict {
        let uses = conflict.file.is_ok() && random.random();
        click(window, if uses { "Use the file" } else { "Keep mine" });
        settle(window);
    }
}

/// The image of a few samples per pixel without path reuse, which is decided by a trial.
fn image(window: &mut Window) -> Vec<[f32; 3]> {
    let session = &mut window.state_mut().session;
    session.settings = RenderSettings { reuse: Reuse::Off, adaptive: false, ..RenderSettings::default() };
    session.camera = built_in().camera;
    session.camera.resolution = [48, 32];
    session.budget = Budget { max_spp: Some(2), ..Budget::default() };
    window.run_steps(3);
    settle(window);
    wait(window, "two samples", |app| {
        app.shown_frame().as_ref().is_some_and(|frame| frame.spp == 2 && frame.generation == app.worker().generation())
    });
    window.state().shown_frame().as_ref().expect("it is shown").radiance.clone()
}

/// Why the scene as it is edited cannot be compiled.
fn uncompiled(window: &Window) -> Option<String> {
    let notices = &window.state().dialogs.notices.0;
    notices.iter().map(|notice| &notice.text).find(|text| text.starts_with("The image shows the scene before")).cloned()
}

#[test]
fn the_image_after_random_edits_is_that_of_the_saved_file() {
    let events = std::env::var(LONGER).ok().and_then(|count| count.parse().ok()).unwrap_or(EVENTS);
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path, _) = window_of_copy(folder.path());
    let mut random = SmallRng::seed_from_u64(11);
    for _ in 0..events {
        event(&mut window, &mut random, &path);
    }
    settle(&mut window);
    // An error that only compiling finds leaves the image of the earlier scene.
    while let Some(reason) = uncompiled(&window) {
        assert!(["add up to", "two sides", "nested deeper"].iter().any(|known| reason.contains(known)), "{reason}");
        assert!(window.state().history.names()[0].is_some(), "{reason}");
        undo(&mut window);
        settle(&mut window);
    }
    // A light that is surely there.
    window.state_mut().add(New::AreaLight("sphere"));
    save(&mut window);
    if window.state().dialogs.conflict.is_some() {
        click(&mut window, "Keep mine");
    }
    settle(&mut window);
    assert!(!window.state().has_unsaved_changes());
    let edited = image(&mut window);
    let mut fresh = open(Some(path));
    wait(&mut fresh, "the saved scene", |app| app.opened().is_some());
    let [of_edits, of_file] = [&window, &fresh].map(|window| Tree::of(&mut description(window).clone()));
    assert!(of_edits.is_identical(&of_file));
    let saved = image(&mut fresh);
    // In a longer run the camera may end inside an object.
    assert!(events != EVENTS || edited.iter().flatten().any(|value| *value > 0.0));
    assert!(edited == saved, "the image after {events} events is another one than that of the file");
}
