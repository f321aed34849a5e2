//! Compares the window in its main states with images in `tests/snapshots`. `UPDATE_SNAPSHOTS=1` redraws them.
use egui_kittest::{SnapshotOptions, image_snapshot_options};

use super::{rasteriser::Rasteriser, *};
use crate::viewer::instruments::tabs::InstrumentTab;

/// Where the figures change with every run: the line at the bottom.
const STATUS_BAR: u32 = 34;

/// A window as large as the smallest that is meant to be comfortable, with an image of so many samples.
fn at_rest(scene: &str, spp: u32, change: impl FnOnce(&mut App)) -> Window {
    let builder = Harness::builder().with_size(vec2(1280.0, 800.0)).renderer(Rasteriser::default());
    let mut window = builder.build_ui_state(drawing(Some(shipped(scene)), |_| {}), Lazy(None));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    let app = window.state_mut();
    app.camera_mut().resolution = [60, 60];
    app.budget_mut().max_spp = Some(spp);
    change(app);
    wait(&mut window, "the image", |app| {
        let shown = app.shown_frame().as_ref().is_some_and(|frame| frame.spp == spp && frame.width == 60);
        let beside = app.second_view().is_none() || app.second_frame().as_ref().is_some_and(|frame| frame.spp == spp);
        shown
            && beside
            && (app.path_inspector().pixel.is_none()
                || app.path_inspector().histogram().is_some_and(|histogram| histogram.samples.len() == spp as usize))
    });
    // Pending results arrive.
    for _ in 0..30 {
        window.step();
        std::thread::sleep(Duration::from_millis(2));
    }
    window
}

fn compare(window: &mut Window, name: &str) {
    let mut picture = window.render().expect("it is drawn");
    let (width, height) = picture.dimensions();
    for y in height - STATUS_BAR..height {
        (0..width).for_each(|x| picture.put_pixel(x, y, image::Rgba([0, 0, 0, 255])));
    }
    image_snapshot_options(&picture, name, &SnapshotOptions::default().max_failed_pixels(40));
}

#[test]
fn the_window_looks_as_it_did_in_both_themes() {
    let mut window = at_rest("cornell_spheres", 8, |_| {});
    compare(&mut window, "converged");
    window.ctx.set_theme(egui::Theme::Light);
    window.run_steps(3);
    compare(&mut window, "converged_light");
}

#[test]
fn the_instruments_look_as_they_did() {
    compare(&mut at_rest("cornell_spheres", 8, |app| app.window.tab = Some(InstrumentTab::Bounces)), "bounces");
    let inspected = |app: &mut App| {
        app.window.tab = Some(InstrumentTab::Path);
        app.instruments.path.look_at([38, 45]);
    };
    compare(&mut at_rest("glass_and_mirror", 16, inspected), "pixel");
    let scored = |app: &mut App| app.look_mut().view = noisefall_render::render::view::View::ZScore;
    compare(&mut at_rest("furnace", 64, scored), "z_score");
}
