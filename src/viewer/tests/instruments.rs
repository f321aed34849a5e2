//! The instruments: convergence, comparison, bounces, views, region, targets.
use std::sync::Arc;

use noisefall_render::render::{Frame, denoise::LABEL, view::View as Shown};
use noisefall_scene::scene::RenderSettings;

use super::*;
use crate::viewer::background::display_image::render;
use crate::viewer::instruments::{compare::comparison::CompareLayout, tabs::InstrumentTab};

/// A window with a small image, most of whose height is the image's.
fn with_tab(scene: &str, tab: &str) -> Window {
    let mut window = window(scene);
    window.get_by_role_and_label(Role::Button, tab).click();
    window.run_steps(3);
    window
}

#[test]
fn curves_of_other_settings_stay_and_those_of_other_cameras_go() {
    let mut window = with_tab("furnace", "Convergence");
    let grown = |window: &mut Window, curves: usize| {
        wait(window, "a curve", |app| {
            app.curves().curves.len() == curves && app.curves().curves.last().is_some_and(|curve| curve.moments.len() >= 3)
        });
    };
    grown(&mut window, 1);
    let moment = *window.state().curves().curves[0].moments.last().expect("it has some");
    assert!(moment.noise.is_some() && moment.true_error.is_some() && moment.bias.is_some(), "{moment:?}");
    restarts(&mut window, "independent samples", |w| choose(w, "Sampler", "Independent"));
    grown(&mut window, 2);
    window.run_steps(2);
    assert!(window.query_all_by_label_contains("Independent, ").count() > 0, "curves are named by what differs");
    window.state_mut().camera_mut().fov = 50.0;
    grown(&mut window, 1);
}

#[test]
fn curves_are_saved_as_table_and_as_drawing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = with_tab("furnace", "Convergence");
    wait(&mut window, "a curve", |app| app.curves().curves.first().is_some_and(|curve| curve.moments.len() >= 3));
    for (button, name, start) in
        [("CSV…", "curves.csv", "name,settings,path_reuse,hidden,spp,seconds"), ("SVG…", "plot.svg", "<svg")]
    {
        let path = folder.path().join(name);
        click(&mut window, button);
        window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
        window.run_steps(3);
        click(&mut window, "Save");
        wait(&mut window, name, |_| path.is_file());
        let text = std::fs::read_to_string(&path).expect("it is there");
        assert!(text.starts_with(start) && text.lines().count() > 3, "{text}");
    }
}

#[test]
fn tabs_explain_their_contents() {
    let mut window = with_tab("furnace", "Compare");
    assert!(window.query_by_label_contains("Both then get the same time").is_some());
    window.get_by_role_and_label(Role::Button, "Convergence").click();
    wait(&mut window, "a curve", |app| app.curves().curves.first().is_some_and(|curve| curve.moments.len() > 1));
    assert!(window.query_by_label_contains("Dashed: 1/√N").is_some());
    click(&mut window, "over time");
    assert!(window.query_by_label_contains("Dashed: 1/√time").is_some());
}

fn an_outdated_second_picture_is_not_recorded(app: &mut App, other: RenderSettings) {
    let curve = |app: &App| {
        let curve = app.curves().curves.iter().find(|curve| curve.settings == other).expect("it has a curve");
        (curve.generation, curve.moments.len())
    };
    let before = curve(app);
    assert_eq!(before.0, app.worker().second_generation());
    let frame = app.shown_frame().clone().expect("an image");
    let mut image = render(app.display_request(frame));
    image.second = Some(Arc::new(Frame { generation: before.0 - 1, spp: 1 << 20, ..Frame::default() }));
    app.take_image(image);
    assert_eq!(curve(app), before);
}

#[test]
fn a_comparison_starts_with_one_click_and_both_sides_converge() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        click(w, "Compare with…");
        click(w, "BSDF sampling");
    });
    assert_eq!(window.state().tab(), Some(InstrumentTab::Compare));
    let other = window.state().compared_with().expect("it compares").other;
    assert_eq!((other.estimator, window.state().settings().estimator), (Estimator::Path, Estimator::Mis));
    wait(&mut window, "both", |app| app.status().spp >= 4 && app.second_status().spp >= 4 && app.results.error_ratio.is_some());
    window.run_steps(3);
    assert!(window.query_by_label_contains("times as efficient").is_some());
    assert_eq!(window.state().curves().curves.len(), 2, "each has its curve");
    an_outdated_second_picture_is_not_recorded(window.state_mut(), other);

    click(&mut window, "Side by side");
    assert_eq!(window.state().compared_with().map(|compare| compare.layout), Some(CompareLayout::SideBySide));
    click(&mut window, "Difference");
    wait(&mut window, "the difference", |app| {
        app.results.legend.as_ref().is_some_and(|legend| legend.title == "Difference A − B" && legend.scale.is_some())
    });
    click(&mut window, "Wipe");
    wait(&mut window, "both images", |app| app.results.textures.iter().all(Option::is_some));
    let line = window.state().picture_view().wipe;
    let [middle, height] = [(1280.0 - 336.0) / 2.0, 500.0];
    never_restarts(&mut window, |w| drag(w, PointerButton::Primary, [middle, height], [middle - 100.0, height]));
    assert!(
        window.state().picture_view().wipe < line - 0.05 && window.state().picture_view().zoom.is_none(),
        "the line moved, and not the image"
    );
    never_restarts(&mut window, |w| drag(w, PointerButton::Primary, [middle - 100.0, height], [middle + 100.0, height]));
    assert!(window.state().picture_view().wipe > line + 0.05, "and to the other side");

    // The menu of the toolbar comes first, that of the tab second.
    window.get_all_by_label("Compare with…").last().expect("it is there").click();
    window.run_steps(3);
    click(&mut window, "No roulette");
    let other = window.state().compared_with().expect("it compares").other;
    assert_eq!((other.roulette, other.estimator), (Roulette::Off, Estimator::Mis), "another comparison");

    let before = window.state().second_status().generation;
    window.get_by_role_and_label(Role::Button, "B").click();
    window.run_steps(3);
    choose(&mut window, "Estimator", "Light sampling");
    wait(&mut window, "the other side anew", |app| app.second_status().generation > before);
    let app = window.state();
    assert_eq!(
        (app.compared_with().map(|c| c.other.estimator), app.settings().estimator),
        (Some(Estimator::Light), Estimator::Mis)
    );
    restarts(&mut window, "the other side alone", |w| click(w, "Keep B"));
    assert!(window.state().compared_with().is_none() && window.state().settings().estimator == Estimator::Light);
}

#[test]
fn the_picture_is_a_series_and_nothing_is_rendered_for_it_unless_it_is_looked_at() {
    let mut window = window("furnace");
    assert_eq!(window.state().second_status().generation, 0);
    never_restarts(&mut window, |w| press(w, Key::F4));
    wait(&mut window, "the series", |app| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some()));
    window.state_mut().session.bounces.k = 2;
    wait(&mut window, "a term", |app| app.second_frame().as_ref().is_some_and(|frame| frame.spp >= 8));
    window.run_steps(5);
    // Radiance 1 and albedo 0.5: the second term is a quarter, which is an eighth of the light.
    let app = window.state_mut();
    let shown = app.shown_frame().clone().expect("it is shown");
    let image = render(app.display_request(shown));
    let mean = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>() / image.pixels.len() as f64;
    assert!((mean - 137.0).abs() < 10.0, "a quarter has the code 137: {mean}");
    assert!(window.query_by_label_contains("k = 2 contributes 12.").is_some());
    assert!(window.query_by_label_contains("A cap of 2 would lose 12.").is_some());
    never_restarts(&mut window, |w| press(w, Key::F4));
    wait(&mut window, "its end", |app| app.second_status().generation == 0 && app.second_frame().is_none());
}

#[test]
fn every_view_is_shown_with_a_legend_and_none_restarts() {
    let mut window = window("furnace");
    wait(&mut window, "samples", |app| app.status().spp >= 4);
    never_restarts(&mut window, |w| {
        for (view, name) in Shown::ALL.map(|view| (view, view.title())) {
            choose(w, "View", name);
            assert_eq!(w.state().look().view, view);
            if view == Shown::Radiance {
                continue;
            }
            if view == Shown::Difference {
                click(w, "Pin this");
            }
            let title = match view {
                Shown::Denoised => LABEL,
                Shown::Difference => "Difference image − pinned image",
                _ => name,
            };
            wait(w, name, |app| app.results.legend.as_ref().is_some_and(|legend| legend.title == title));
        }
    });
    choose(&mut window, "View", "Z-score");
    wait(&mut window, "scores", |app| app.results.scores.is_some());
    window.hover_at(Pos2::new((1280.0 - 336.0) / 2.0, 500.0));
    window.run_steps(3);
    assert!(window.query_by_label_contains(")  Z-score ").is_some(), "the line below says what the view shows there");
    choose(&mut window, "View", "Radiance");
    wait(&mut window, "the image", |app| app.results.legend.is_none());
    press(&mut window, Key::V);
    assert_eq!(window.state().look().view, Shown::StandardError);
}

#[test]
fn a_region_is_dragged_rendered_first_and_cleared() {
    let mut window = window("cornell_spheres");
    wait(&mut window, "samples", |app| app.status().spp >= 2);
    never_restarts(&mut window, |w| {
        press(w, Key::B);
        assert_eq!(w.state().tool(), Tool::Region);
        drag(w, PointerButton::Primary, [440.0, 380.0], [500.0, 420.0]);
    });
    let region = window.state().budget().region.expect("it is marked");
    // 60 by 40 points of the screen, at so many points a pixel of the image.
    let zoom = window.state().picture_view().drawn_zoom;
    let [width, height] = region.size().map(|side| side as f32 * zoom);
    assert!((width - 60.0).abs() < 2.0 * zoom && (height - 40.0).abs() < 2.0 * zoom, "{region:?} {zoom}");
    wait(&mut window, "the region", |app| {
        app.shown_frame().as_ref().is_some_and(|frame| frame.counts.iter().any(|count| *count > frame.spp))
    });
    never_restarts(&mut window, |w| press(w, Key::Escape));
    assert!(window.state().budget().region.is_none());
    wait(&mut window, "the rest", |app| app.shown_frame().as_ref().is_some_and(|frame| frame.counts.is_empty()));
}

#[test]
fn targets_by_time_and_noise_stop_the_render_and_never_restart_it() {
    let mut window = window("bright_sky");
    never_restarts(&mut window, |w| {
        check_box(w, "Stop after");
        check_box(w, "Stop below");
    });
    assert_eq!(window.state().budget().max_time, Some(Duration::from_secs(60)));
    assert_eq!(window.state().budget().noise, Some(0.01));
    never_restarts(&mut window, |w| w.state_mut().budget_mut().noise = Some(0.5));
    wait(&mut window, "the target", |app| matches!(app.status().state, State::Done(_)));
    let (spp, noise) = (window.state().status().spp, window.state().status().relative_noise().expect("samples"));
    assert!(spp >= 64, "before that noise is not believed");
    never_restarts(&mut window, |w| w.state_mut().budget_mut().noise = Some(0.6 * noise));
    wait(&mut window, "less noise", |app| matches!(app.status().state, State::Done(_)) && app.status().spp > spp);
    assert!(window.state().status().relative_noise().is_some_and(|left| left <= 0.6 * noise && left > 0.1 * noise));
    never_restarts(&mut window, |w| {
        check_box(w, "Stop below");
        w.state_mut().budget_mut().max_time = None;
    });
    wait(&mut window, "more", |app| app.status().state == State::Running);
}

#[test]
fn a_reference_that_is_dropped_gives_true_error_and_bias() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("reference.exr");
    let mut window = window("cornell_spheres");
    assert!(window.state().measured_error().is_none());
    wait(&mut window, "an image", App::can_save);
    window.state_mut().save_to(path.clone());
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    let camera = window.state().camera();
    window.state_mut().loader_mut().read_reference(path, camera);
    wait(&mut window, "the error", |app| app.measured_error().is_some());
    window.state_mut().settings_mut().seed = 9;
    wait(&mut window, "another image", |app| {
        app.measured_error().is_some_and(|against| against.rel_mse > 0.0 && against.bias.is_some()) && app.status().spp >= 2
    });
    window.state_mut().camera_mut().resolution = [64, 64];
    wait(&mut window, "another size", |app| app.measured_error().is_none());
    window.run_steps(2);
    assert!(window.query_by_label_contains("error unknown").is_some());
    std::fs::write(folder.path().join("bad.exr"), "no image").expect("it is written");
    window.state_mut().loader_mut().read_reference(folder.path().join("bad.exr"), camera);
    wait(&mut window, "the refusal", |app| app.dialogs.notices.0.iter().any(|notice| notice.is_error));
    // Alone, so that it stays where it is when others have had their time.
    window.state_mut().dialogs.notices.0.retain(|notice| notice.is_error);
    window.run_steps(4);
    window.get_by_label("Copy").click();
    let copied =
        |command: &egui::OutputCommand| matches!(command, egui::OutputCommand::CopyText(text) if text.contains("bad.exr"));
    let mut copies = |_| {
        window.step();
        window.output().platform_output.commands.iter().any(copied)
    };
    assert!((0..12).any(&mut copies), "errors can be copied");
}
