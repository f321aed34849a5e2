//! Every control of the panels changes the setting that it names, and no other.
use noisefall_render::render::Region;
use noisefall_scene::scene::{Camera, RenderSettings};

use super::*;

/// Clicks a control and checks the settings.
fn sets(window: &mut Window, label: &str, expected: RenderSettings) {
    click(window, label);
    assert_eq!(window.state().settings(), expected, "{label}");
}

#[test]
fn every_choice_of_the_estimate_changes_its_setting() {
    let mut window = window("cornell_spheres");
    let mut expected = window.state().settings();
    for estimator in Estimator::ALL.into_iter().rev() {
        choose(&mut window, "Estimator", estimator.title());
        expected.estimator = estimator;
        assert_eq!(window.state().settings(), expected, "{estimator:?}");
    }
    for (label, directions) in [("Uniform", Directions::Uniform), ("BSDF", Directions::Bsdf), ("Cosine", Directions::Cosine)] {
        expected.directions = directions;
        sets(&mut window, label, expected);
    }
    for (label, reuse) in [
        ("Suffixes", Reuse::Suffixes),
        ("Auto", Reuse::Auto),
        ("Outliers", Reuse::Outliers),
        ("Both", Reuse::Both),
        ("Off", Reuse::Off),
    ] {
        choose(&mut window, "Path reuse", label);
        expected.reuse = reuse;
        assert_eq!(window.state().settings(), expected, "{label}");
    }
    for (label, sampler) in [
        ("Independent", Sampler::Independent),
        ("Stratified", Sampler::Stratified),
        ("Sobol (Owen)", Sampler::Sobol),
        ("Sobol, blue noise", Sampler::BlueNoise),
    ] {
        choose(&mut window, "Sampler", label);
        expected.sampler = sampler;
        assert_eq!(window.state().settings(), expected, "{label}");
    }
    for (label, roulette) in
        [("Off", Roulette::Off), ("Fixed probability", Roulette::fixed(0.8)), ("By throughput", Roulette::BY_THROUGHPUT)]
    {
        choose(&mut window, "Roulette", label);
        expected.roulette = roulette;
        assert_eq!(window.state().settings(), expected, "{label}");
    }
    check_box(&mut window, "Bounce cap");
    set(&mut window, "Bounce cap", 0, 3.0);
    expected.max_bounces = Some(3);
    assert_eq!(window.state().settings(), expected);
    set(&mut window, "Bounce cap", 0, -5.0);
    assert_eq!(window.state().settings().max_bounces, Some(0), "what is out of range is brought into it");
    check_box(&mut window, "Bounce cap");
    expected.max_bounces = None;
    check_box(&mut window, "Adaptive");
    expected.adaptive = true;
    assert_eq!(window.state().settings(), expected);
}

#[test]
fn every_number_of_the_camera_is_its_own() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    let mut expected = start;
    for (i, label) in ["Eye", "Look at", "Up"].into_iter().enumerate() {
        for axis in 0..3 {
            // Up stays away from the direction of view.
            let value = 0.125 * (1 + 3 * i + axis) as f64 + if i == 2 && axis == 1 { 5.0 } else { 0.0 };
            set(&mut window, label, axis, value);
            [&mut expected.eye, &mut expected.look_at, &mut expected.up][i][axis] = value;
            assert_eq!(window.state().camera(), expected, "{label} {axis}");
        }
    }
    for (axis, side) in [72, 40].into_iter().enumerate() {
        set(&mut window, "Resolution", axis, f64::from(side));
        expected.resolution[axis] = side;
        assert_eq!(window.state().camera(), expected);
    }
    for (label, filter) in [("Tent", Filter::TENT), ("Gaussian", Filter::GAUSSIAN), ("Box", Filter::Box)] {
        click(&mut window, label);
        expected.filter = filter;
        assert_eq!(window.state().camera(), expected, "{label}");
    }
    set(&mut window, "Lens radius", 0, 0.25);
    let distance = expected.eye.distance(expected.look_at);
    assert_eq!(window.state().camera().lens, Some(Lens { radius: 0.25, focus: distance }), "in focus is what is looked at");
    set(&mut window, "Focus", 0, 7.0);
    // Not by the pointer: beside a number that has just become shorter the button moves.
    window.get_by_label("Focus on look-at point").click_accesskit();
    window.run_steps(3);
    assert_eq!(window.state().camera().lens, Some(Lens { radius: 0.25, focus: distance }));
    let width = expected.width_at_look_at();
    click(&mut window, "Orthographic");
    assert_eq!(window.state().camera(), Camera { projection: Projection::orthographic(width), ..expected });
    set(&mut window, "Width", 0, 3.5);
    assert_eq!(window.state().camera().projection, Projection::orthographic(3.5));
    click(&mut window, "Perspective");
    window.state_mut().camera_mut().resolution = start.resolution;
    assert_eq!(window.state().camera(), Camera { resolution: start.resolution, ..expected });
    click(&mut window, "Back to the scene's camera");
    let home = window.state().opened().as_ref().expect("it is open").scene.camera;
    assert_eq!(window.state().camera(), Camera { resolution: start.resolution, ..home });
}

#[test]
fn targets_are_in_the_units_that_they_say() {
    let mut window = window("bright_sky");
    window.state_mut().budget_mut().paused = true;
    let scene = window.state().opened().as_ref().expect("it is open").scene.clone();
    assert_eq!(window.state().budget().max_spp, scene.spp);
    if scene.spp.is_none() {
        check_box(&mut window, "Stop at");
    }
    check_box(&mut window, "Stop after");
    check_box(&mut window, "Stop below");
    set(&mut window, "Stop at", 0, 77.0);
    set(&mut window, "Stop after", 0, 1.0);
    set(&mut window, "Stop below", 0, 2.5);
    let budget = window.state().budget();
    assert_eq!((budget.max_spp, budget.max_time), (Some(77), Some(Duration::from_secs(1))));
    assert!((budget.noise.expect("it is set") - 0.025).abs() < 1e-12, "percent");
    assert!(window.query_by_label("second").is_some() && window.query_by_label("spp").is_some());
    assert!(window.query_all_by_label_contains(" / 77 spp").count() > 0, "the target is in the line below");
    for label in ["Stop at", "Stop after", "Stop below"] {
        check_box(&mut window, label);
    }
    let budget = window.state().budget();
    assert_eq!((budget.max_spp, budget.max_time, budget.noise), (None, None, None));
}

#[test]
fn a_region_has_four_numbers_and_stays_within_the_picture() {
    let mut window = window("cornell_spheres");
    check_box(&mut window, "Region");
    assert_eq!(window.state().budget().region, Some(Region { from: [24, 16], to: [73, 49] }), "the middle of 96 × 64");
    for (label, value) in [("x from, in pixels", 5), ("y from, in pixels", 6), ("x to, in pixels", 70), ("y to, in pixels", 60)] {
        set(&mut window, label, 0, f64::from(value));
    }
    let region = Region { from: [5, 6], to: [70, 60] };
    assert_eq!(window.state().budget().region, Some(region));
    set(&mut window, "x to, in pixels", 0, 5.0);
    assert_eq!(window.state().budget().region, Some(region), "an empty region is none");
    window.state_mut().camera_mut().resolution = [48, 32];
    window.run_steps(3);
    assert_eq!(window.state().budget().region, Some(Region { from: [5, 6], to: [48, 32] }));
    click(&mut window, "Clear");
    assert_eq!(window.state().budget().region, None);
}
