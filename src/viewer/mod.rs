//! The window. It requests images, displays what is published, and never waits.
//!
//! From the top down: [`app`] joins all parts; [`panels`] and [`dialogs`] show what they are given and return requests;
//! [`instruments`] lie below the image, which is the [`canvas`]; work that could take longer than a frame runs on threads of
//! [`environment`]; [`widgets`] are shared. Arrows between these folders point down (`tests/program/layers.rs`).
mod app;
mod background;
mod canvas;
mod dialogs;
mod instruments;
mod panels;
#[cfg(test)]
mod tests;
mod widgets;
mod window_system;

use std::panic::{AssertUnwindSafe, catch_unwind};

pub use app::App;
pub use background::{opened_scene::GivenScene, preferences::Preferences};
use noisefall_base::math::SimdLevel;
use noisefall_render::render::{pass::panic_message, threads::Threads};
use panels::window::{all_but_one, cores};

const ICON: &[u8] = include_bytes!("../../assets/icon.png");
const NO_WINDOW: &str = "use `noisefall render SCENE -o image.png` to render without a window";

/// Opens the window on a scene file, or on the built-in scene. Returns when it is closed.
pub fn run(scene: GivenScene) -> Result<(), String> {
    let displays = window_system::found();
    let system = displays.choose().map_err(|why| format!("{why}; {NO_WINDOW}"))?;
    let threads = all_but_one(cores());
    let threads = Threads::new(threads, SimdLevel::best()).map_err(|error| error.to_string())?;
    let options = options(system);
    let open = || {
        let create = |cc: &eframe::CreationContext| -> Box<dyn eframe::App> {
            // There is a window: from here on a panic is ours, and is shown as usual.
            let _ = std::panic::take_hook();
            let mut app = App::new(&cc.egui_ctx, threads, scene, Preferences::of_user());
            app.use_disk();
            app.welcome();
            Box::new(app)
        };
        eframe::run_native("Noisefall", options, Box::new(|cc| Ok(create(cc))))
    };
    // Some window systems panic where a library of theirs is missing. The message below says it in our words.
    std::panic::set_hook(Box::new(|_| {}));
    let done = catch_unwind(AssertUnwindSafe(open));
    let _ = std::panic::take_hook();
    match done {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(format!("the window cannot be opened: {}; {NO_WINDOW}", displays.explain(&error))),
        Err(panic) => Err(format!("the window failed: {}; {NO_WINDOW}", displays.without_source(&panic_message(&*panic)))),
    }
}

/// The window as it opens.
fn options(system: window_system::WindowSystem) -> eframe::NativeOptions {
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Noisefall")
            .with_app_id("noisefall")
            .with_icon(eframe::icon_data::from_png_bytes(ICON).unwrap_or_default())
            .with_inner_size([1280.0, 760.0])
            .with_min_inner_size([720.0, 480.0]),
        renderer: eframe::Renderer::Glow,
        ..Default::default()
    };
    window_system::force(system, &mut options);
    options
}
