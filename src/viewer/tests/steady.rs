//! Parts of the window that must not move, and figures that must not be wrong.
use noisefall_render::render::view::View as Shown;
use noisefall_scene::scene::RenderSettings;

use super::{rasteriser::Blind, *};
use crate::viewer::{
    dialogs::tour,
    instruments::{convergence::curve::Curve, tabs::InstrumentTab},
    options,
    widgets::style::PANEL_WIDTH,
    window_system::WindowSystem,
};

/// The heights at which the rows of the panel stand.
fn rows(window: &Window) -> Vec<(&'static str, f32)> {
    const ROWS: [&str; 15] = [
        "Editing side",
        "Preset",
        "Estimator",
        "Path reuse",
        "Roulette",
        "Survival",
        "Bounce cap",
        "Seed",
        "Stop at",
        "Exposure",
        "Pinned",
        "Eye",
        "Focus",
        "Resolution",
        "Theme",
    ];
    let row = |name: &'static str| {
        let labels = window.get_all_by_role(Role::Label);
        let label = labels.into_iter().find(|label| label.accesskit_node().value().as_deref() == Some(name));
        (name, label.unwrap_or_else(|| panic!("there is no row {name}")).rect().top())
    };
    ROWS.map(row).to_vec()
}

#[test]
fn rows_of_the_panel_stay_where_they_are() {
    let mut window = window("cornell_spheres");
    window.run_steps(3);
    let before = rows(&window);
    type Change = fn(&mut App);
    let changes: [(&str, Change); 11] = [
        ("a comparison", |app| app.start_comparison(RenderSettings { seed: 3, ..app.settings() })),
        ("a fixed roulette", |app| app.settings_mut().roulette = Roulette::fixed(0.5)),
        ("no roulette", |app| app.settings_mut().roulette = Roulette::Off),
        ("no path reuse", |app| app.settings_mut().reuse = Reuse::Off),
        ("bidirectional paths", |app| app.settings_mut().estimator = Estimator::Bidirectional),
        ("an estimator by trial", |app| app.settings_mut().estimator = Estimator::Auto),
        ("a cap", |app| app.settings_mut().max_bounces = Some(3)),
        ("a lens", |app| app.camera_mut().lens = Some(Lens { radius: 0.1, focus: 3.0 })),
        ("a parallel projection", |app| app.camera_mut().projection = Projection::orthographic(3.0)),
        ("a camera that cannot be", |app| app.camera_mut().up = DVec3::ZERO),
        ("a region", |app| app.budget_mut().region = Some(noisefall_render::render::Region::between([1, 1], [20, 20]))),
    ];
    for (what, change) in changes {
        change(window.state_mut());
        window.run_steps(3);
        for ((name, was), (_, is)) in before.iter().zip(&rows(&window)) {
            assert!((was - is).abs() < 0.5, "{what} moves {name} from {was} to {is}");
        }
    }
}

#[test]
fn the_ideal_line_follows_the_curve_that_grows() {
    let mut window = window("cornell_spheres");
    *window.state_mut().tab_mut() = Some(InstrumentTab::Convergence);
    let sampled = |window: &mut Window, seed: u32| {
        window.state_mut().settings_mut().seed = seed;
        wait(window, "its curve", |app| {
            let curve = app.curves().curves.iter().find(|curve| curve.settings.seed == seed);
            let is_long = |curve: &&Curve| curve.moments.iter().filter(|moment| moment.noise.is_some()).count() >= 3;
            let is_shown = app.curves().current.is_some_and(|settings| settings.seed == seed);
            curve.filter(is_long).is_some() && is_shown
        });
    };
    for seed in [0, 1, 0, 1] {
        sampled(&mut window, seed);
        let history = &window.state().curves();
        let curve = history.curves.iter().find(|curve| curve.settings.seed == seed).expect("it is there");
        let (x, y) = *curve.errors(history.over, |moment| moment.noise).last().expect("it has figures");
        let [(from, high), (to, low)] = history.guide()[..] else { panic!("it has two ends") };
        for (at, height) in [(from, high), (to, low)] {
            assert!((height / (y * (x / at).sqrt()) - 1.0).abs() < 1e-9, "seed {seed}: the line misses ({x}, {y})");
        }
    }
}

#[test]
fn the_number_under_the_pointer_is_that_of_the_view_and_has_its_unit() {
    let mut window = window("furnace");
    wait(&mut window, "samples", |app| app.status().spp >= 4);
    click(&mut window, "Pin this");
    window.hover_at(Pos2::new(472.0, 600.0));
    for (view, says, unit) in [
        (Shown::StandardError, "Standard error ", "W·sr⁻¹·m⁻²"),
        (Shown::SampleCount, "Sample count ", "samples"),
        (Shown::ZScore, "Z-score ", "σ"),
        (Shown::Difference, "Difference ", ""),
        (Shown::Normals, "n ", ""),
        (Shown::Albedo, "Albedo RGB 0.500 0.500 0.500", ""),
        (Shown::Depth, "Depth ", "m"),
        (Shown::HitCost, "Hit cost ", "ns per ray"),
        (Shown::Materials, "Material ", ""),
        (Shown::Radiance, "RGB ", "W·sr⁻¹·m⁻²"),
    ] {
        window.state_mut().look_mut().view = view;
        let is_said = |window: &Window| {
            let labels = window.get_all_by_role(Role::Label);
            let mut texts = labels.filter_map(|label| label.accesskit_node().value());
            texts.any(|text| text.starts_with('(') && text.contains(&format!(")  {says}")) && text.ends_with(unit))
        };
        let start = Instant::now();
        while !is_said(&window) {
            assert!(start.elapsed() < Duration::from_secs(60), "{says} is never said");
            std::thread::sleep(Duration::from_millis(2));
            window.step();
        }
    }
}

#[test]
fn the_number_over_side_b_is_that_of_the_view_too() {
    let mut window = window("cornell_spheres");
    let other = RenderSettings { seed: 5, ..window.state().settings() };
    window.state_mut().start_comparison(other);
    window.state_mut().look_mut().view = Shown::SampleCount;
    wait(&mut window, "both", |app| app.results.second_values.numbers.is_some() && app.results.textures[1].is_some());
    window.hover_at(Pos2::new(572.0, 400.0));
    window.run_steps(3);
    assert!(window.state().window.over_second && window.query_all_by_label_contains(")  Sample count ").count() == 1);
}

/// A window of 1280 × 800 pixels at two pixels a point.
fn dense() -> Window {
    let builder = Harness::builder().with_size(vec2(640.0, 400.0)).with_pixels_per_point(2.0).renderer(Blind);
    let mut window = builder.build_ui_state(drawing(Some(shipped("furnace")), |_| {}), Lazy(None));
    wait(&mut window, "an image", |app| app.shown_frame().is_some());
    window
}

#[test]
fn every_page_of_the_tour_fits_a_screen_of_scale_2() {
    let mut window = dense();
    window.state_mut().start_tour();
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(640.0, 400.0));
    for page in 0..tour::COUNT {
        window.run_steps(5);
        let last = page + 1 == tour::COUNT;
        let number = window.get_by_label(&format!("{} of {}", page + 1, tour::COUNT)).rect();
        let next = window.get_by_label(if last { "Done" } else { "Next" }).rect();
        assert!(screen.contains_rect(number) && screen.contains_rect(next), "page {page}: {number:?} {next:?}");
        window.get_by_label(if last { "Done" } else { "Next" }).click();
        window.run_steps(3);
    }
    assert!(window.state().dialogs.tour.is_none());
}

#[test]
fn escape_leaves_the_dialogs_of_paths_at_once() {
    let mut window = window("furnace");
    click(&mut window, "Open…");
    window.run_steps(4);
    window.get_by_role(Role::TextInput).focus();
    window.run_steps(2);
    window.key_press(Key::Escape);
    window.run_steps(2);
    assert!(window.state().dialogs.open.is_none());
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    assert!(window.state().dialogs.save.is_some());
    window.key_press(Key::Escape);
    window.run_steps(2);
    assert!(window.state().dialogs.save.is_none());
}

#[test]
fn every_figure_of_the_line_below_has_a_tooltip() {
    let mut window = window("furnace");
    wait(&mut window, "figures", |app| app.status().spp >= 4 && app.measured_error().is_some());
    window.state_mut().budget_mut().paused = true;
    wait(&mut window, "rest", |app| app.status().state == State::Paused);
    window.run_steps(3);
    let labels = |window: &Window| {
        let labels = window.get_all_by_role(Role::Label);
        let text = |label: egui_kittest::Node<'_>| Some((label.accesskit_node().value()?, label.rect()));
        labels.filter_map(text).collect::<Vec<_>>()
    };
    // Rows of the side panel reach behind the line.
    let of_line = |rect: &egui::Rect| rect.top() > SIZE.y - 30.0 && rect.bottom() < SIZE.y && rect.left() < SIZE.x - PANEL_WIDTH;
    let figures: Vec<(String, egui::Rect)> = labels(&window).into_iter().filter(|(_, rect)| of_line(rect)).collect();
    assert!(figures.len() >= 7, "{figures:?}");
    for (figure, rect) in figures {
        window.event(egui::Event::PointerGone);
        window.run_steps(4);
        let before = labels(&window).len();
        window.hover_at(rect.center());
        window.run_steps(8);
        assert!(labels(&window).len() > before, "{figure} has no tooltip");
    }
}

#[test]
fn the_gallery_is_in_an_order_that_teaches_and_its_pictures_cover_their_cards() {
    let mut window = window("furnace");
    window.ctx.set_theme(egui::ThemePreference::Light);
    window.key_press(Key::F6);
    wait(&mut window, "images", |app| app.dialogs.gallery.count() > 20);
    window.run_steps(3);
    let chapters = ["The box", "Noise", "Estimators", "Materials", "Geometry", "Limits"];
    let tops = chapters.map(|chapter| window.get_by_label(chapter).rect().top());
    assert!(tops.is_sorted(), "{tops:?}");
    let card = |name: &str| window.get_by_role_and_label(Role::Button, name).rect();
    let is_under = |name: &str, chapter: usize| {
        let top = card(name).top();
        top > tops[chapter] && tops.get(chapter + 1).is_none_or(|next| top < *next)
    };
    for (name, chapter) in [
        ("Cornell box", 0),
        ("Cornell box of spheres", 0),
        ("Tiny light: slow to converge", 1),
        ("Veach's plates: why to combine", 2),
        ("From mirror to matt", 3),
        ("Isosurfaces", 4),
        ("Truncation: what a bounce cap loses", 5),
    ] {
        assert!(is_under(name, chapter), "{name} is not under {}", chapters[chapter]);
    }
    let boxes = window.query_all_by_role(Role::Button).filter(|node| {
        let label = node.accesskit_node().label();
        label.is_some_and(|label| label.contains("Cornell box of spheres"))
    });
    assert_eq!(boxes.count(), 1, "the built-in scene is there once");
    // Each image is as large as its card, so that no ground of another brightness shows beside it.
    let size = vec2(164.0, 112.0);
    let pictures = window.output().shapes.iter().filter(|clipped| {
        let is_picture = clipped.shape.texture_id() != egui::TextureId::default();
        is_picture && (clipped.shape.visual_bounding_rect().size() - size).length() < 1.0
    });
    assert!(pictures.count() >= 4);
}

#[test]
fn a_scene_without_a_picture_says_so_in_its_card() {
    let mut window = window("furnace");
    window.key_press(Key::F6);
    wait(&mut window, "all images", |app| app.dialogs.gallery.is_complete());
    window.run_steps(3);
    let says = |shape: &egui::Shape| matches!(shape, egui::Shape::Text(text) if text.galley.text() == "no image");
    assert!(window.output().shapes.iter().any(|clipped| says(&clipped.shape)));
}

#[test]
fn the_smallest_window_has_as_much_room_for_the_picture_as_for_the_panel() {
    let size = |options: &eframe::NativeOptions| [options.viewport.min_inner_size, options.viewport.inner_size];
    let [least, first] = size(&options(WindowSystem::Default)).map(|size| size.expect("a size"));
    assert!(least.x >= 2.0 * PANEL_WIDTH && least.x > least.y, "{least}");
    assert!(first.x > least.x && first.y > least.y, "{first} {least}");
}

#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn a_window_opens_in_the_window_system_that_was_chosen() {
    let is_forced = |system| options(system).event_loop_builder.is_some();
    assert_eq!([WindowSystem::X11, WindowSystem::Default].map(is_forced), [true, false]);
}
