//! The table of a path: it fits the window, and what it lists adds up to the sample.
use noisefall_scene::scene::RenderSettings;

use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

/// A window that shows the path of a sample.
fn inspecting(scene: &str, reuse: Reuse, pixel: [u32; 2]) -> Window {
    let mut window = window(scene);
    let app = window.state_mut();
    app.session.settings = RenderSettings { reuse, ..app.settings() };
    app.window.tab = Some(InstrumentTab::Path);
    app.instruments.path.look_at(pixel);
    show_sample(&mut window, 0);
    window
}

fn show_sample(window: &mut Window, sample: u32) {
    window.state_mut().path_inspector_mut().sample = sample;
    wait(window, "its path", |app| {
        let is_asked = app.worker().request().is_some_and(|request| request.settings == app.settings());
        is_asked && app.path_inspector().replay().is_some_and(|(number, _)| number == sample)
    });
    window.run_steps(3);
}

/// The labels of the window with their places, as they follow each other.
fn labels(window: &Window) -> Vec<(String, egui::Rect)> {
    let labels = window.get_all_by_role(Role::Label);
    labels.filter_map(|label| Some((label.accesskit_node().value()?, label.rect()))).collect()
}

#[test]
fn the_table_fits_a_window_of_1280_points() {
    let mut windows =
        [("cornell_spheres", [30, 40]), ("cornell_box", [36, 20])].map(|(scene, at)| inspecting(scene, Reuse::Suffixes, at));
    for (place, sample) in (0..12).map(|number| (number / 6, number as u32 % 6)) {
        let window = &mut windows[place];
        show_sample(window, sample);
        let labels = labels(window);
        let heading = labels.iter().find(|(text, _)| text == "term").expect("the last column").1;
        assert!(heading.right() < 1280.0 - 336.0, "{heading:?}");
        // Beside the numbers lies the scroll bar.
        let last = labels.iter().filter(|(_, rect)| (rect.left() - heading.left()).abs() < 0.5);
        assert!(last.map(|(_, rect)| rect.right()).fold(0.0, f32::max) < 1280.0 - 336.0 - 10.0, "the last column is whole");
        let row = |name: &str| labels.iter().find(|(text, _)| text == name).map(|(_, rect)| rect.left());
        assert!(row("L_e").is_some_and(|left| left < heading.left()), "it has a column for the emitted radiance");
        assert!(row("Sample").is_some() && row("From neighbours").is_some());
    }
}

#[test]
fn the_numbers_of_the_last_column_add_up_to_the_sample() {
    for reuse in [Reuse::Off, Reuse::Suffixes] {
        let mut window = inspecting("cornell_spheres", reuse, [30, 40]);
        for sample in 0..8 {
            show_sample(&mut window, sample);
            let labels = labels(&window);
            let left = labels.iter().find(|(text, _)| text == "term").expect("the last column").1.left();
            let column = labels.iter().filter(|(_, rect)| (rect.left() - left).abs() < 0.5).map(|(text, _)| text);
            // Terms in brackets do not count.
            let numbers: Vec<f64> = column.filter_map(|text| text.parse().ok()).collect();
            let (last, terms) = numbers.split_last().expect("there is a sum");
            let rounding = 0.0006 * numbers.len() as f64 + 0.01 * last;
            assert!((terms.iter().sum::<f64>() - last).abs() <= rounding, "{reuse:?} {sample}: {numbers:?}");
        }
    }
}

#[test]
fn vertices_that_the_camera_does_not_see_are_hollow() {
    let mut window = inspecting("cornell_spheres", Reuse::Off, [48, 40]);
    let fills = |window: &Window| {
        let fill = |shape: &egui::Shape| match shape {
            egui::Shape::Circle(circle) if circle.radius == 4.0 => Some(circle.fill),
            _ => None,
        };
        window.output().shapes.iter().filter_map(|clipped| fill(&clipped.shape)).collect::<Vec<_>>()
    };
    let (mut seen, mut hollow) = (0, 0);
    for sample in 0..24 {
        show_sample(&mut window, sample);
        let fills = fills(&window);
        let yellow = egui::Color32::from_rgb(255, 214, 90);
        assert_eq!(fills.first(), Some(&yellow), "the camera sees the first one");
        seen += fills.iter().filter(|fill| **fill == yellow).count();
        hollow += fills.iter().filter(|fill| **fill != yellow).count();
    }
    assert!(seen >= 24 && hollow > 0, "{seen} {hollow}");
}

#[test]
fn a_channel_is_chosen() {
    let mut window = inspecting("cornell_box", Reuse::Off, [20, 40]);
    let sum = |window: &Window| {
        let labels = labels(window);
        let left = labels.iter().find(|(text, _)| text == "term").expect("the last column").1.left();
        labels.into_iter().rfind(|(_, rect)| (rect.left() - left).abs() < 0.5).expect("the sum").0
    };
    let brightest = {
        wait(&mut window, "samples", |app| app.path_inspector().histogram().is_some());
        window.state().path_inspector().histogram().expect("they are there").brightest
    };
    show_sample(&mut window, brightest);
    for (channel, label) in ["Red", "Green", "Blue"].into_iter().enumerate() {
        click(&mut window, label);
        let (_, replay) = window.state().path_inspector().replay().expect("it is there");
        let exact = f64::from(replay.radiance[channel]);
        let shown: f64 = sum(&window).parse().expect("a number");
        assert!((shown - exact).abs() <= 0.001 + 0.05 * exact, "{label}: {shown} {exact}");
    }
}
