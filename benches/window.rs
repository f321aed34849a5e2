//! Frame times of the window while the renderer uses all cores but one: median and 99th percentile. Then the time from an edit of the
//! scene to its image.
//!
//! `cargo bench --bench window`, or `cargo bench --bench window -- edits` for edits only. Frames come at 60 per second, as on a screen.
//! The measured time is the work of the window's thread for one frame, up to the triangles for the graphics system.
#![allow(clippy::print_stdout, reason = "figures are printed for those who ask for them")]
use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

use egui::{Key, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use noisefall_base::math::SimdLevel;
use noisefall_render::render::threads::Threads;

#[path = "window/edits.rs"]
mod edits;
#[path = "../src/kept_scene.rs"]
mod kept_scene;
#[path = "../src/viewer/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the program uses the rest")]
mod viewer;

use viewer::{App, Preferences};

const FRAMES: usize = 600;
const BETWEEN: Duration = Duration::from_millis(16);

fn main() {
    // Cargo hands on what follows `--`.
    if std::env::args().all(|argument| argument != "edits") {
        frames();
    }
    edits::print();
}

fn frames() {
    let states: [(&str, &[Key], &[&str]); 8] = [
        ("only the image", &[], &[]),
        ("convergence", &[Key::F2], &[]),
        ("compare", &[Key::F3], &["Compare with…", "Path sampling"]),
        ("bounces", &[Key::F4], &[]),
        ("pixel", &[Key::F5], &["Use the middle pixel"]),
        ("a view of numbers", &[Key::V], &[]),
        ("gallery", &[Key::F6], &[]),
        ("inspector", &[], &["Edit", "left wallsphere, red"]),
    ];
    println!("{:<20} {:>9} {:>9}", "1280 x 800, showing", "p50 ms", "p99 ms");
    for (name, keys, buttons) in states {
        let [half, most] = frame_times(keys, buttons).map(|time| time.as_secs_f64() * 1e3);
        println!("{name:<20} {half:>9.2} {most:>9.2}");
    }
}

/// A window of 1280 × 800 with a scene, rendered on all cores but one.
fn open(scene: Option<PathBuf>) -> Harness<'static, Option<App>> {
    let draw = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from).saturating_sub(1).max(1);
        let make = || {
            let threads = Threads::new(threads, SimdLevel::best()).expect("threads can be had");
            App::new(ui.ctx(), threads, scene.clone().into(), Preferences::default())
        };
        app.get_or_insert_with(make).show(ui);
    };
    Harness::builder().with_size(vec2(1280.0, 800.0)).build_ui_state(draw, None)
}

/// Quantiles of ten seconds of frames, after the first second.
fn frame_times(keys: &[Key], buttons: &[&str]) -> [Duration; 2] {
    let mut window = open(None);
    let step = |window: &mut Harness<_>, frames: usize| -> Vec<Duration> {
        let time = |_| {
            std::thread::sleep(BETWEEN);
            let start = Instant::now();
            window.step();
            let shapes = window.output().shapes.clone();
            std::hint::black_box(window.ctx.tessellate(shapes, window.ctx.pixels_per_point()));
            start.elapsed()
        };
        (0..frames).map(time).collect()
    };
    step(&mut window, 60);
    keys.iter().for_each(|key| window.key_press(*key));
    for button in buttons {
        step(&mut window, 4);
        window.get_all_by_label(button).last().expect("the button is there").click();
    }
    let mut times = step(&mut window, FRAMES);
    times.sort();
    [0.5, 0.99].map(|part| times[(part * FRAMES as f64) as usize])
}
