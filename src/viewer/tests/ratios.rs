//! Comparisons: no winner out of noise, samples of the side under the pointer, and a way to end.
use noisefall_base::math::colour::luminance;
use noisefall_kernel::integrator::pixel_samples;
use noisefall_render::render::path_reuse::resolved;
use noisefall_scene::scene::RenderSettings;

use super::*;
use crate::viewer::instruments::{compare::comparison::CompareLayout, tabs::InstrumentTab};

/// A window that compares the settings of a scene with others.
fn comparing(scene: &str, change: impl FnOnce(RenderSettings) -> RenderSettings) -> Window {
    let mut window = window(scene);
    let other = change(window.state().settings());
    window.state_mut().start_comparison(other);
    wait(&mut window, "a ratio", |app| app.results.error_ratio.is_some() && app.second_status().spp >= 4);
    window.run_steps(3);
    window
}

#[test]
fn a_winner_is_named_only_where_the_interval_excludes_1() {
    let mut window = comparing("cornell_spheres", |a| RenderSettings { seed: a.seed + 1, ..a });
    for _ in 0..20 {
        window.run_steps(2);
        let verdict = window.query_all_by_label_contains("times as efficient (95 % interval ").next().expect("it is said");
        let text = verdict.accesskit_node().value().unwrap_or_default();
        // The times of the two sides are those of a clock, so the interval is read and not foreseen.
        let interval = text.split("interval ").nth(1).and_then(|rest| rest.split(')').next()).expect("it has an interval");
        let ends: Vec<f64> = interval.split(" to ").map(|end| end.parse().expect("an end is a number")).collect();
        // An end that is written as 1.00 may be on either side of 1.
        let is_winner = !text.starts_with("No difference yet");
        assert!(ends[0] == 1.0 || is_winner == (ends[0] > 1.0), "{text}");
    }
}

#[test]
fn a_clear_winner_is_named_with_its_interval() {
    let mut window = comparing("cornell_spheres", |a| RenderSettings { estimator: Estimator::Path, reuse: Reuse::Off, ..a });
    wait(&mut window, "the verdict", |app| {
        app.results.error_ratio.is_some_and(|ratio| ratio.interval()[2] < 0.2) && app.status().spp >= 8
    });
    window.run_steps(3);
    let verdict = window.query_all_by_label_contains("times as efficient (95 % interval ").next().expect("it is said");
    assert!(verdict.accesskit_node().value().is_some_and(|text| text.starts_with("A is ")));
}

#[test]
fn a_click_on_side_b_shows_the_samples_of_b() {
    let mut window = comparing("cornell_spheres", |a| RenderSettings { seed: a.seed + 5, reuse: Reuse::Off, ..a });
    if let Some(compare) = &mut window.state_mut().compared_with_mut() {
        compare.layout = CompareLayout::SideBySide;
    }
    *window.state_mut().tool_mut() = Tool::Inspect;
    window.run_steps(3);
    let samples_of = |window: &mut Window, x: f32, side: &str| {
        click_at(window, Pos2::new(x, 500.0));
        assert_eq!(window.state().tab(), Some(InstrumentTab::Path));
        wait(window, "its samples", |app| {
            app.path_inspector().samples().is_some_and(|samples| samples.len() >= 2) && app.path_inspector().replay().is_some()
        });
        window.run_steps(2);
        assert!(window.query_by_label(&format!("Pixel of {side}")).is_some());
        let inspector = &window.state().path_inspector();
        (inspector.pixel.expect("it was clicked"), inspector.samples().expect("they are there")[..2].to_vec())
    };
    let (pixel, of_a) = samples_of(&mut window, 242.0, "A");
    let (same, of_b) = samples_of(&mut window, 707.0, "B");
    assert_eq!(pixel, same);
    assert_ne!(of_a, of_b);
    let session = &window.state().session;
    let (scene, other) = (&session.opened.as_ref().expect("it is open").scene, session.comparison.expect("it compares").other);
    let rays = scene.rays(&session.camera);
    for (settings, found) in [(session.settings, of_a), (other, of_b)] {
        let exact = pixel_samples(scene, &rays, &resolved(scene, &rays, &settings), pixel, 0..2, &|| false);
        let exact = exact.expect("nobody interrupts");
        assert!(exact == found, "{:?} {:?}", exact.iter().map(|rgb| luminance(*rgb)).collect::<Vec<_>>(), found);
    }
    // The path is drawn over its own image.
    let marks = window.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Circle(circle) if circle.radius == 4.0 => Some(circle.center.x),
        _ => None,
    });
    assert!(marks.collect::<Vec<_>>().first().is_some_and(|x| *x > 472.0));
    click(&mut window, "End comparison");
    assert!(!window.state().path_inspector().of_second && window.query_all_by_label_contains("Pixel of").count() == 0);
}

#[test]
fn a_button_ends_the_comparison_whatever_is_open() {
    let mut window = comparing("cornell_spheres", |a| RenderSettings { seed: a.seed + 1, ..a });
    let settings = window.state().settings();
    *window.state_mut().tab_mut() = None;
    window.run_steps(3);
    never_restarts(&mut window, |w| click(w, "End comparison"));
    assert!(window.state().compared_with().is_none() && window.state().settings() == settings);
    assert!(window.query_by_label("End comparison").is_none() && window.query_by_label("Compare with…").is_some());
    wait(&mut window, "one image", |app| app.second_frame().is_none() && app.results.textures[1].is_none());
}
