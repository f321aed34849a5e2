//! Nothing is cut off or overlaps in a small window, and in one of scale 2.
use std::sync::Arc;

use egui::{Rect, Vec2};
use noisefall_formats::import::{Remark, Remarks};
use noisefall_scene::scene::RenderSettings;

use super::{rasteriser::Blind, *};
use crate::viewer::background::display_image::ReferenceComparison;
use crate::viewer::dialogs::{save_target::SaveTarget, unsaved::Leaving};
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::panels::presets::Preset;
use crate::viewer::widgets::style::PANEL_WIDTH;

/// Sizes in points, and pixels per point.
const SIZES: [(Vec2, f32); 2] = [(vec2(900.0, 600.0), 1.0), (vec2(800.0, 500.0), 2.0)];

/// A window of this size with a small image.
fn sized(size: Vec2, scale: f32) -> Window {
    let builder = Harness::builder().with_size(size).with_pixels_per_point(scale).renderer(Blind);
    let mut window = builder.build_ui_state(drawing(Some(shipped("cornell_spheres")), |_| {}), Lazy(None));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    window.state_mut().camera_mut().resolution = [48, 48];
    wait(&mut window, "an image", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.width == 48));
    window.run_steps(3);
    window
}

/// The buttons with a name, and their places.
fn buttons(window: &Window) -> Vec<(String, Rect)> {
    let nodes = window.query_all_by_role(Role::Button);
    let named = nodes.filter_map(|node| Some((node.accesskit_node().label().filter(|name| !name.is_empty())?, node.rect())));
    named.collect()
}

/// No button is cut off at a side. What lies in the side panel scrolls, everything else lies in the window.
fn assert_whole(window: &Window, size: Vec2, what: &str) {
    for (name, rect) in buttons(window) {
        assert!(rect.left() >= -0.5 && rect.right() <= size.x + 0.5, "{what}: {name} is cut off at {rect:?}");
        let is_in_panel = rect.left() >= size.x - PANEL_WIDTH - 1.0;
        let is_inside = rect.top() >= -0.5 && rect.bottom() <= size.y + 0.5;
        assert!(is_in_panel || is_inside, "{what}: {name} lies outside of the window at {rect:?}");
    }
}

/// The first button of each name is there, left of the side panel, and no two of them overlap.
fn assert_apart(window: &Window, size: Vec2, names: &[&str]) {
    let all = buttons(window);
    let place = |name: &&str| all.iter().find(|(label, _)| label == name).unwrap_or_else(|| panic!("{name} is missing")).1;
    let rects: Vec<Rect> = names.iter().map(place).collect();
    for (i, rect) in rects.iter().enumerate() {
        assert!(rect.right() <= size.x - PANEL_WIDTH + 1.0, "{} reaches under the panel: {rect:?}", names[i]);
        for (j, other) in rects[..i].iter().enumerate() {
            let common = rect.intersect(*other);
            assert!(!common.is_positive(), "{} and {} overlap: {rect:?} {other:?}", names[i], names[j]);
        }
    }
}

#[test]
fn toolbar_tabs_and_instruments_fit_a_small_window() {
    for (size, scale) in SIZES {
        let mut window = sized(size, scale);
        window.state_mut().budget_mut().region = Some(noisefall_render::render::Region::between([4, 4], [40, 40]));
        for tab in [
            None,
            Some(InstrumentTab::Convergence),
            Some(InstrumentTab::Compare),
            Some(InstrumentTab::Bounces),
            Some(InstrumentTab::Path),
        ] {
            *window.state_mut().tab_mut() = tab;
            window.run_steps(4);
            assert_whole(&window, size, &format!("{tab:?}"));
            let bar = ["Pause", "Step", "Restart", "Undo", "Redo", "Region", "Inspect", "Clear", "Home", "Fit", "1:1"];
            let ends = ["Compare with…", "Save…", "Help", "Convergence", "Compare", "Bounces", "Pixel"];
            assert_apart(&window, size, &[&bar[..], &ends[..]].concat());
        }
    }
}

#[test]
fn a_comparison_and_the_samples_of_a_pixel_fit_a_small_window() {
    for (size, scale) in SIZES {
        let mut window = sized(size, scale);
        let other = RenderSettings { seed: 3, ..window.state().settings() };
        window.state_mut().start_comparison(other);
        window.run_steps(4);
        assert_whole(&window, size, "a comparison");
        assert_apart(&window, size, &["Wipe", "Side by side", "Difference", "Swap", "Keep B", "Keep A", "End comparison"]);
        *window.state_mut().compared_with_mut() = None;
        *window.state_mut().tab_mut() = Some(InstrumentTab::Bounces);
        window.run_steps(4);
        assert_apart(&window, size, &["Bounce k alone", "Bounces up to k"]);
        let bars: Vec<(String, Rect)> = buttons(&window).into_iter().filter(|(name, _)| name.contains(" bounce")).collect();
        let last = &bars.iter().find(|(name, _)| name.starts_with("16 and more")).expect("the last bar").1;
        assert!(last.right() <= size.x - PANEL_WIDTH, "{last:?}");
    }
}

#[test]
fn figures_of_the_line_below_end_in_the_window() {
    for (size, scale) in SIZES {
        let mut window = sized(size, scale);
        window.state_mut().settings_mut().max_bounces = Some(3);
        wait(&mut window, "figures", |app| app.status().spp >= 4);
        window.state_mut().budget_mut().region = Some(noisefall_render::render::Region::between([4, 4], [40, 40]));
        window.run_steps(5);
        let labels = window.query_all_by_role(Role::Label);
        let line: Vec<Rect> = labels.map(|label| label.rect()).filter(|rect| rect.top() > size.y - 30.0).collect();
        assert!(line.len() >= 4 && line.iter().all(|rect| rect.right() <= size.x), "{line:?}");
    }
}

#[test]
fn every_figure_of_the_line_below_has_room_at_scale_2_on_a_common_screen() {
    const LONGEST: [&str; 5] = ["Done", "Bidirectional", "1024 / 4096 spp", "error 5.00 %", "biased: cap at 3"];
    let size = vec2(960.0, 540.0);
    let mut app = labels::app();
    while app.loader().is_busy() {
        drop(app.background.loader.take());
        std::thread::yield_now();
    }
    app.session.settings = RenderSettings { max_bounces: Some(3), ..Preset::Fastest.applied_to(&app.settings()) };
    app.budget_mut().max_spp = Some(4096);
    let scene = &app.opened().as_ref().expect("it is open").scene;
    let traces = RenderSettings { estimator: Estimator::Bidirectional, ..app.settings() };
    assert!(scene.traces_light_paths(&traces));
    scene.estimator_by_trial.set(Estimator::Bidirectional).expect("there was no trial");
    let status = app.status_mut();
    (status.spp, status.rel_mse_estimate, status.state) = (1024, Some(0.0016), State::Done(Target::Samples(1024)));
    app.results.comparison = Some(ReferenceComparison { rel_mse: 0.0025, bias: None });
    let window = Harness::builder().with_size(size).build_ui(|ui| app.status_bar(ui));
    for text in LONGEST {
        let label = window.query_by_label(text).unwrap_or_else(|| panic!("{text} is not there"));
        // A cut text is as wide as its room.
        assert!(label.rect().right() < size.x - 100.0, "{text}: {:?}", label.rect());
    }
}

#[test]
fn a_comparison_that_has_not_begun_leaves_the_room_to_the_image() {
    let (size, scale) = SIZES[1];
    let mut window = sized(size, scale);
    let zoom = |window: &Window| window.state().picture_view().drawn_zoom;
    let alone = zoom(&window);
    *window.state_mut().tab_mut() = Some(InstrumentTab::Compare);
    window.run_steps(6);
    assert!(window.query_by_label_contains("Choose settings to compare with").is_some());
    let beside = zoom(&window);
    assert!(beside > 0.8 * alone && beside < alone, "{alone} {beside}");
}

type Open = (&'static str, fn(&mut App), &'static [&'static str]);

/// Dialogs over the image, and their buttons.
const DIALOGS: [Open; 9] = [
    ("open", |app| app.open_scene(crate::viewer::background::catalogue::SceneRequest::Browse), &["Open", "Cancel", "Browse…"]),
    ("save", |app| app.open_save_dialog(SaveTarget::Picture), &["Save", "Cancel", "Browse…", "Send to tev…"]),
    ("frames", |app| app.open_export(crate::viewer::dialogs::save::OtherExport::Sequence), &["Render frames", "Cancel"]),
    ("tev", |app| app.open_export(crate::viewer::dialogs::save::OtherExport::Tev), &["Connect", "Cancel"]),
    ("help", |app| app.dialogs.help = true, &["Take the tour"]),
    ("gallery", |app| app.dialogs.gallery.open = true, &["Open a file…"]),
    ("question", |app| app.dialogs.unsaved = Some(Leaving::Quit), &["Save changes", "Discard changes", "Cancel"]),
    ("error", |app| app.dialogs.scene_error = Some("wrong\n".repeat(60)), &["Copy"]),
    ("message", |app| app.tell("A long message about something. ".repeat(12), true), &["Copy"]),
];

#[test]
fn dialogs_lie_in_a_small_window_with_all_their_buttons() {
    for (size, scale) in SIZES {
        let mut window = sized(size, scale);
        let screen = Rect::from_min_size(Pos2::ZERO, size).expand(0.5);
        for (what, open, names) in DIALOGS {
            open(window.state_mut());
            window.run_steps(8);
            for name in names {
                let places: Vec<Rect> =
                    buttons(&window).into_iter().filter(|(label, _)| label == name).map(|(_, rect)| rect).collect();
                assert!(!places.is_empty(), "{what}: there is no {name}");
                assert!(places.iter().any(|rect| screen.contains_rect(*rect)), "{what}: {name} at {places:?}");
            }
            let dialogs = &mut window.state_mut().dialogs;
            (dialogs.open, dialogs.save, dialogs.sequence, dialogs.tev, dialogs.unsaved) = (None, None, None, None, None);
            (dialogs.help, dialogs.gallery.open, dialogs.scene_error) = (false, false, None);
            dialogs.notices.0.clear();
            window.run_steps(2);
        }
        let remark = |number: usize| Remark {
            place: format!("a.xml:{number}:1"),
            found: format!("`a shape that has a long name {number}`"),
            used: "nothing".to_owned(),
            effect: "it is missing in the image".to_owned(),
        };
        let remarks: Remarks = (0..40).map(remark).collect();
        window.state_mut().opened_mut().as_mut().expect("it is open").remarks = Arc::new(remarks);
        window.state_mut().dialogs.remarks = true;
        window.run_steps(8);
        assert!(screen.contains_rect(window.get_by_label("Copy").rect()));
    }
}
