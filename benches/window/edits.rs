//! Edits of a scene: from the change of the description to its image on the screen, while the renderer has all cores but one.
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

use egui::pos2;
use egui_kittest::Harness;
use glam::DVec3;
use noisefall_base::{declare::Precision, math::SimdLevel};
use noisefall_render::render::{
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    material::{Dielectric, Lambertian, Plastic},
    scene::{
        Camera, Scene, describe,
        description::{ObjectDescription, SceneDescription, Transform},
    },
};

use super::viewer::App;

/// Edits of each kind.
const EDITS: usize = 40;
/// Frames of the window come every few milliseconds: the delay of a screen of 60 Hz is not in the figures.
const BETWEEN: Duration = Duration::from_millis(2);

type Window = Harness<'static, Option<App>>;
/// Makes the edit of this number.
type Change = fn(&mut SceneDescription, f64);

/// The kinds of edits, with the scene that each is made in.
const KINDS: [(&str, &str, Change); 8] = [
    ("cornell_spheres", "a colour", |scene, x| {
        scene.add_material("amber", Lambertian { albedo: [x as f32, 0.5, 0.5].into() });
    }),
    ("cornell_spheres", "roughness of plastic", |scene, x| {
        scene.add_material("amber", Plastic::new([0.5; 3], 1.5, x as f32));
    }),
    ("cornell_spheres", "roughness of glass", |scene, x| {
        scene.add_material("amber", Dielectric::new(1.5, x as f32, true));
    }),
    ("cornell_spheres", "a light", |scene, x| emission_of_first_light(scene, 1.0 + x)),
    ("cornell_spheres", "the pose of a ball", |scene, x| shift(object(scene, "amber ball"), x)),
    ("million_triangles", "roughness of the mesh", |scene, x| {
        scene.add_material("clay", Plastic::new([0.6, 0.2, 0.1], 1.5, x as f32));
    }),
    ("million_triangles", "a light", |scene, x| emission_of_first_light(scene, 1.0 + x)),
    ("million_triangles", "the pose of the mesh", |scene, x| shift(object(scene, "knot"), x)),
];

fn object<'s>(scene: &'s mut SceneDescription, name: &str) -> &'s mut ObjectDescription {
    scene.objects.iter_mut().find(|object| object.name == name).expect("the scene has it")
}

fn emission_of_first_light(scene: &mut SceneDescription, scale: f64) {
    scene.objects.iter_mut().find_map(|object| object.emission.as_mut()).expect("the scene has a light").scale = scale;
}

fn shift(object: &mut ObjectDescription, x: f64) {
    object.transform.push(Transform::Translate(DVec3::X * 0.1 * x));
}

/// Times of one kind of edit.
#[derive(Default)]
struct Times {
    /// From the edit to the image on the screen.
    shown: Vec<Duration>,
    /// Of them, the compile.
    compile: Vec<Duration>,
    /// From the edit to the result, without the compile: stopping the old image, and the frame of the window that asks.
    stop: Vec<Duration>,
    /// The last report of a compile.
    report: String,
}

/// Prints a table of the times of every kind of edit.
pub fn print() {
    println!("\n{:<20} {:<22} {:>14} {:>12} {:>12}  last compile", "scene", "edit", "shown p50, p95", "compile p50", "stop p95");
    let mut scenes: Vec<&str> = KINDS.iter().map(|(scene, ..)| *scene).collect();
    scenes.dedup();
    for name in scenes {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml"));
        let text = fs::read_to_string(&path).expect("the scene can be read");
        let description = describe(&path.display().to_string(), text).expect("the scene is valid");
        let mut window = super::open(Some(path));
        until(&mut window, |app| app.session.opened.is_some());
        for (_, edit, change) in KINDS.iter().filter(|(scene, ..)| *scene == name) {
            let times = times(&mut window, &description, *change);
            let [shown, late] = [0.5, 0.95].map(|part| quantile(&times.shown, part));
            let [compile, stop] = [quantile(&times.compile, 0.5), quantile(&times.stop, 0.95)];
            println!("{name:<20} {edit:<22} {shown:>7.1} {late:>6.1} {compile:>12.2} {stop:>12.2}  {}", times.report);
        }
        check(&window, &description, KINDS.iter().rfind(|(scene, ..)| *scene == name).expect("it has edits").2);
    }
}

fn quantile(times: &[Duration], part: f64) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort();
    sorted[((sorted.len() - 1) as f64 * part).round() as usize].as_secs_f64() * 1e3
}

/// Frames of the window until a condition holds.
fn until(window: &mut Window, condition: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !window.state().as_ref().is_some_and(&condition) {
        assert!(start.elapsed() < Duration::from_secs(60), "it never came");
        std::thread::sleep(BETWEEN);
        window.step();
    }
}

fn app(window: &mut Window) -> &mut App {
    window.state_mut().as_mut().expect("the window has drawn a frame")
}

fn is_shown(app: &App) -> bool {
    let shown = app.results.shown.as_ref().map_or(0, |frame| frame.generation);
    !app.background.worker.is_editing() && app.session.waiting_edit.is_none() && shown == app.background.worker.generation()
}

/// The place of an edit in a drag to and fro.
fn place(edit: usize) -> f64 {
    0.2 + 0.6 * (edit % 20) as f64 / 20.0
}

/// Drags: every edit is made when the one before is on the screen, and its image has been rendered for a while.
fn times(window: &mut Window, description: &SceneDescription, change: Change) -> Times {
    // On the status bar, where nothing is dragged: as long as the button is down, the drag goes on.
    let pointer = pos2(640.0, 796.0);
    window.drag_at(pointer);
    let mut times = Times::default();
    for edit in 0..EDITS {
        for _ in 0..5 {
            std::thread::sleep(BETWEEN);
            window.step();
        }
        let mut description = description.clone();
        change(&mut description, place(edit));
        let start = Instant::now();
        app(window).edit_scene(Arc::new(description));
        window.step();
        until(window, |app| !app.background.worker.is_editing() && app.session.waiting_edit.is_none());
        let result = start.elapsed();
        until(window, is_shown);
        times.shown.push(start.elapsed());
        let compiled = &app(window).session.opened.as_ref().expect("it is open").scene.compiled;
        times.compile.push(compiled.took);
        times.stop.push(result.saturating_sub(compiled.took));
        times.report = compiled.to_string();
    }
    window.drop_at(pointer);
    window.step();
    times
}

/// The exact scene after the last edit gives the same bits as one that is compiled from scratch.
fn check(window: &Window, description: &SceneDescription, last: Change) {
    let mut description = description.clone();
    last(&mut description, place(EDITS - 1));
    let opened = window.state().as_ref().and_then(|app| app.session.opened.as_ref()).expect("it is open");
    let exact = Arc::new(description.clone()).rebuild(&PathBuf::new(), &opened.scene, Precision::Exact).expect("it is valid");
    let new = description.build(Path::new("")).expect("it is valid");
    assert_eq!(picture(&exact), picture(&new), "an edited scene has the image of a new one");
}

fn picture(scene: &Scene) -> Vec<[u32; 3]> {
    let camera = Camera { resolution: [96, 64], ..scene.camera };
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let mut film = Film::new(camera.resolution);
    threads.pass(PassJob { scene, rays: &scene.rays(&camera), settings: &scene.settings }, &mut film, 2, &|| false);
    let frame = noisefall_render::render::Frame::of_film(&film, 0, camera.resolution, camera.resolution);
    frame.radiance.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}
