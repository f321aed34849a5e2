//! Labels of given figures: each in its place, with its unit.
use std::sync::Arc;

use noisefall_kernel::measure::LogRatio;
use noisefall_render::render::{Frame, Series, pass::SampleId};
use noisefall_scene::scene::{CompileReport, PathReuse, RenderSettings, built_in};

use super::*;
use crate::viewer::background::{
    catalogue::SceneRequest,
    display_image::ReferenceComparison,
    opened_scene::{GivenScene, OpenedScene},
};
use crate::viewer::dialogs::save_target::SaveTarget as File;
use crate::viewer::instruments::{convergence::curve::Moment, convergence::history::Quantity, tabs::InstrumentTab};
use crate::viewer::panels::views;

/// An app whose fields nobody changes: it shows what it is told.
pub(super) fn app() -> App {
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    let mut app = App::new(&egui::Context::default(), threads, GivenScene::default(), Preferences::default());
    let (scene, materials) = (Arc::new(built_in()), Arc::from([]));
    let description = Arc::default();
    app.session.opened = Some(OpenedScene {
        scene,
        name: String::new(),
        path: None,
        reference: None,
        description,
        materials,
        warnings: Vec::new(),
        kept: None,
        remarks: Arc::default(),
    });
    app
}

/// The labels of a part of the window, in their order.
fn said(app: &mut App, mut part: impl FnMut(&mut App, &mut egui::Ui)) -> Vec<String> {
    let harness = Harness::builder().with_size(SIZE).build_ui(|ui| part(app, ui));
    let labels = harness.root().children_recursive().filter(|node| node.accesskit_node().role() == Role::Label);
    labels.filter_map(|label| label.accesskit_node().value()).collect()
}

fn assert_says(texts: &[String], expected: &[&str]) {
    for text in expected {
        assert!(texts.iter().any(|said| said == text), "{text:?} is not in {texts:?}");
    }
}

/// Two pixels, the second of which is coloured and has more samples.
fn frame() -> Arc<Frame> {
    Arc::new(Frame {
        width: 2,
        height: 1,
        full_resolution: [2, 1],
        radiance: vec![[0.0; 3], [0.1, 0.2, 0.3]],
        standard_error: vec![0.0, 0.05],
        spp: 3,
        counts: vec![3, 5],
        ..Frame::default()
    })
}

#[test]
fn the_line_at_the_bottom_has_every_figure_in_its_unit() {
    let mut app = app();
    let status = app.status_mut();
    (status.spp, status.samples, status.elapsed) = (7, 5_000_000, Duration::from_secs(2));
    (status.region_spp, status.rel_mse_estimate) = (Some(12), Some(0.0016));
    app.budget_mut().max_spp = Some(64);
    app.results.comparison = Some(ReferenceComparison { rel_mse: 0.0025, bias: None });
    (app.results.shown, app.window.hovered) = (Some(frame()), Some([1, 0]));
    let texts = said(&mut app, App::status_bar);
    assert_says(&texts, &["7 / 64 spp, 12 in the region", "2.5 M samples/s", "2.0 s", "estimated error 4.00 %", "error 5.00 %"]);
    assert_says(&texts, &["(1, 0)  RGB 0.100 0.200 0.300  Y 0.186 ± 0.050 W·sr⁻¹·m⁻²"]);
}

#[test]
fn samples_that_are_no_numbers_and_paths_that_were_cut_are_counted() {
    let mut app = app();
    let status = app.status_mut();
    (status.invalid_samples, status.first_invalid, status.cut_paths) = (3, Some(SampleId { pixel: [4, 5], sample: 6 }), 1);
    let texts = said(&mut app, App::status_bar);
    assert_says(&texts, &["3 invalid samples", "paths cut after 4096 bounces"]);
}

#[test]
fn a_pixel_has_its_own_estimate_and_samples() {
    let mut app = app();
    (app.results.shown, app.instruments.path.pixel) = (Some(frame()), Some([1, 0]));
    assert_says(&said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Path)), &["L = 0.1860 ± 0.0500, N = 5"]);
}

#[test]
fn a_bounce_states_its_share_the_sum_up_to_it_and_the_loss_of_a_cap() {
    let mut app = app();
    let shares = [0.5, 0.2, 0.12].into_iter().chain([0.01; 18]).collect();
    let series = Some(Series { terms: Vec::new(), shares });
    app.results.second_frame = Some(Arc::new(Frame { spp: 7, series, ..Frame::default() }));
    app.session.bounces.k = 2;
    let texts = said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Bounces));
    assert_says(&texts, &["k = 2 contributes 12.00 % of the light; up to k it is 82.00 %. A cap of 2 would lose 18.00 %."]);
}

#[test]
fn every_bar_is_named_by_its_bounces_and_the_last_has_the_rest() {
    let mut app = app();
    let shares = std::iter::repeat_n(0.05, 20).collect();
    let series = Some(Series { terms: Vec::new(), shares });
    app.results.second_frame = Some(Arc::new(Frame { spp: 7, series, ..Frame::default() }));
    let harness = Harness::builder().with_size(SIZE).build_ui(|ui| app.instrument(ui, InstrumentTab::Bounces));
    let buttons = harness.root().children_recursive().filter(|node| node.accesskit_node().role() == Role::Button);
    let bars: Vec<String> = buttons
        .filter_map(|button| button.accesskit_node().label())
        .filter(|name| name.contains(" bounces: ") || name.starts_with("1 bounce: "))
        .collect();
    assert_eq!(bars.len(), 17);
    for (k, bar) in bars[..16].iter().enumerate() {
        assert_eq!(*bar, format!("{k} bounce{}: 5.00 %", if k == 1 { "" } else { "s" }));
    }
    assert_eq!(bars[16], "16 and more bounces: 20.00 %");
}

#[test]
fn bars_and_lines_of_the_bounces_stay_while_there_are_no_figures() {
    let mut app = app();
    let rects = |app: &mut App| {
        let harness = Harness::builder().with_size(SIZE).build_ui(|ui| app.instrument(ui, InstrumentTab::Bounces));
        let nodes = harness.root().children_recursive().filter(|node| node.accesskit_node().role() == Role::Button);
        let bars: Vec<egui::Rect> = nodes.map(|node| node.rect()).collect();
        let line = ["Available after one", "After 1 sample per pixel"]
            .map(|text| harness.query_by_label_contains(text).map(|label| label.rect().left_top()));
        (bars, line[0].or(line[1]).expect("it says how many samples there are"))
    };
    let before = rects(&mut app);
    let series = Some(Series { terms: Vec::new(), shares: vec![0.05; 20] });
    app.results.second_frame = Some(Arc::new(Frame { spp: 1, series, ..Frame::default() }));
    assert_eq!(rects(&mut app), before);
}

#[test]
fn each_side_of_a_comparison_has_its_own_figures_in_their_columns() {
    let mut app = app();
    let against = |rel_mse| Some(ReferenceComparison { rel_mse, bias: None });
    for (status, spp, milliseconds, rel_mse) in
        [(&mut app.results.status, 7, 2500, 0.0016), (&mut app.results.second_status, 9, 3000, 0.0004)]
    {
        (status.spp, status.elapsed, status.rel_mse_estimate) = (spp, Duration::from_millis(milliseconds), Some(rel_mse));
    }
    (app.results.comparison, app.results.second_comparison) = (against(0.0025), against(0.01));
    app.start_comparison(RenderSettings { max_bounces: Some(2), ..app.settings() });
    let texts = said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Compare));
    for row in [
        ["A", "MIS, Sobol (Owen), no path reuse", "7", "2.5 s", "4.00 %", "5.00 %", "160", "the solution"],
        ["B", "cap of 2 bounces, no path reuse", "9", "3.0 s", "2.00 %", "10.00 %", "33.3", "biased: cap at 2"],
    ] {
        assert!(texts.windows(row.len()).any(|cells| cells == row), "{row:?} is not in {texts:?}");
    }
    assert_says(&texts, &["No difference yet."]);
    // The error of A is a quarter of that of B, in 2.5 s of 3.
    let ratio = LogRatio { value: 0.25f64.ln(), standard_error: 0.01, degrees: 1e6, model_error: 0.0 };
    app.results.error_ratio = Some(ratio);
    let texts = said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Compare));
    assert_says(&texts, &["A is 4.8 times as efficient (95 % interval 4.7 to 4.9)."]);
    app.results.error_ratio = Some(LogRatio { value: 4f64.ln(), ..ratio });
    std::mem::swap(&mut app.results.comparison, &mut app.results.second_comparison);
    // 1/(0.01 · 2.5) and 1/(0.0025 · 3).
    assert_says(
        &said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Compare)),
        &["B is 3.3 times as efficient (95 % interval 3.3 to 3.4)."],
    );
}

#[test]
fn lines_are_estimates_points_are_true_and_clear_keeps_the_curve_that_grows() {
    let mut app = app();
    let scene = app.opened().as_ref().expect("it is open").scene.clone();
    app.instruments.history.look_at(&scene, &scene.camera, None);
    let other = RenderSettings { seed: 5, ..scene.settings };
    for (settings, generation) in [(other, 5), (scene.settings, app.worker().generation())] {
        for (spp, true_error) in [(1, None), (4, Some(0.25)), (16, None)] {
            let noise = Some(0.5 / f64::from(spp));
            app.instruments.history.record(
                &settings,
                generation,
                Moment { spp, seconds: 1.0, noise, true_error, bias: None, path_reuse: PathReuse::Off, is_lower_bound: false },
            );
        }
    }
    let mut harness = Harness::builder().with_size(SIZE).build_ui(|ui| app.instrument(ui, InstrumentTab::Convergence));
    let is_point = |shape: &egui::Shape| matches!(shape, egui::Shape::Circle(circle) if circle.radius == 2.2);
    let points = harness.output().shapes.iter().filter(|clipped| is_point(&clipped.shape)).count();
    assert_eq!(points, 2, "one of each curve");
    harness.get_by_label("Clear").click();
    harness.run_steps(3);
    drop(harness);
    let left: Vec<u64> = app.curves().curves.iter().map(|curve| curve.generation).collect();
    assert_eq!(left, [app.worker().generation()]);
}

#[test]
fn without_a_reference_the_plot_of_bias_asks_for_one() {
    let mut app = app();
    let scene = app.opened().as_ref().expect("it is open").scene.clone();
    app.instruments.history.look_at(&scene, &scene.camera, None);
    app.instruments.history.what = Quantity::Bias;
    let needs = |texts: &[String]| texts.iter().any(|text| text.starts_with("The bias needs a reference"));
    for (spp, bias, is_known) in [(1, None, false), (4, Some(0.1), true), (16, None, true)] {
        let moment = Moment {
            spp,
            seconds: 1.0,
            noise: Some(0.5),
            true_error: None,
            bias,
            path_reuse: PathReuse::Off,
            is_lower_bound: false,
        };
        app.instruments.history.record(&scene.settings, 5, moment);
        assert_eq!(needs(&said(&mut app, |app, ui| app.instrument(ui, InstrumentTab::Convergence))), !is_known, "{spp}");
    }
}

#[test]
fn frame_times_are_those_of_layout_and_of_all() {
    let mut app = app();
    app.frame_times.shown = true;
    app.frame_times.record(Duration::from_millis(5), 0.0);
    app.frame_times.record(Duration::from_millis(5), 0.25);
    app.frame_times.record_whole(Duration::from_millis(9));
    let compiled = CompileReport::default();
    let texts = said(&mut app, |app, ui| app.frame_times.show(ui.ctx(), 1, 0, Some(&compiled)));
    assert_says(&texts, &["layout      p50   5.00 ms   p99   5.00 ms", "and drawing p50   9.00 ms   p99   9.00 ms"]);
    assert_says(&texts, &["last one 250 ms ago; none while nothing changes"]);
    assert_says(&texts, &["scene compiled in 0.0 ms"]);
}

#[test]
fn a_pinned_picture_has_the_samples_of_its_own() {
    let mut pinned = Some(Arc::new(Frame { spp: 12, ..Frame::default() }));
    let rows = |app: &mut App, ui: &mut egui::Ui| {
        views::rows(ui, &mut app.look_mut().map, Some(&frame()), &mut pinned);
    };
    assert_says(&said(&mut app(), rows), &["12 spp"]);
}

#[test]
fn a_name_is_suggested_after_the_last_file_of_its_kind() {
    let mut app = app();
    for (last, target, suggested) in [
        ("shots/shot.exr", File::Picture, "shots/shot.exr"),
        ("shots/shot.exr", File::CurvesCsv, "shots/shot.csv"),
        ("shots/shot.png", File::CurvesSvg, "shots/shot.svg"),
        ("shots/curves.csv", File::Picture, "scene.png"),
    ] {
        (app.window.last_saved, app.dialogs.save) = (Some(PathBuf::from(last)), None);
        app.open_save_dialog(target);
        let path = app.dialogs.save.as_ref().map(|dialog| PathBuf::from(dialog.path()));
        assert!(path.as_ref().is_some_and(|path| path.ends_with(suggested)), "{path:?}");
    }
}

#[test]
fn a_file_is_looked_for_where_the_open_scene_lies() {
    let mut app = app();
    let path = shipped("furnace").canonicalize().expect("it is there");
    app.session.opened.as_mut().expect("it is open").path = Some(path.clone());
    app.open_scene(SceneRequest::Browse);
    let start = app.dialogs.open.map(|dialog| dialog.form.field.path);
    let folder = path.parent().expect("it lies in one").join("");
    assert_eq!(start, Some(folder.display().to_string()), "a name can be typed behind it");
}
