//! How long the window's own frames take while the renderer has all cores but one: half of them and all but one in a hundred.
//!
//! `cargo bench --bench window`. Frames come at 60 a second, as on a screen; what is timed is the layout of a frame, which is what
//! the window's thread does besides handing triangles to the graphics system.
use std::time::Duration;

use egui::{Key, vec2};
use egui_kittest::Harness;
use noisefall::{math::SimdLevel, render::pass::Threads};

#[path = "../src/viewer/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the program uses the rest")]
mod viewer;

use viewer::{App, Preferences};

const FRAMES: usize = 600;
const BETWEEN: Duration = Duration::from_millis(16);

fn main() {
    let states: [(&str, &[Key]); 6] = [
        ("only the picture", &[]),
        ("convergence", &[Key::F2]),
        ("bounces", &[Key::F4]),
        ("pixel", &[Key::F5]),
        ("a view of numbers", &[Key::V]),
        ("gallery", &[Key::F6]),
    ];
    println!("{:<20} {:>9} {:>9}", "1280 x 800, showing", "p50 ms", "p99 ms");
    for (name, keys) in states {
        let [half, most] = frame_times(keys).map(|time| time.as_secs_f64() * 1e3);
        println!("{name:<20} {half:>9.2} {most:>9.2}");
    }
}

/// Quantiles of the frames after the first second.
fn frame_times(keys: &[Key]) -> [Duration; 2] {
    let draw = |ui: &mut egui::Ui, app: &mut Option<App>| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from).saturating_sub(1).max(1);
        let make = || {
            let threads = Threads::new(threads, SimdLevel::best()).expect("threads can be had");
            App::new(ui.ctx(), threads, None, Preferences::default())
        };
        app.get_or_insert_with(make).show(ui);
    };
    let mut window = Harness::builder().with_size(vec2(1280.0, 800.0)).build_ui_state(draw, None);
    for frame in 0..FRAMES {
        if frame == 60 {
            keys.iter().for_each(|key| window.key_press(*key));
        }
        window.step();
        std::thread::sleep(BETWEEN);
    }
    let app = window.state().as_ref().expect("frames were drawn");
    [0.5, 0.99].map(|part| app.frame_time(part))
}
