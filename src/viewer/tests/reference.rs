//! The reference of an image: the reference of a scene is valid for the scene's own camera alone.
use noisefall_render::render::Budget;
use noisefall_scene::scene::Camera;

use super::*;
use crate::viewer::{background::given_reference::GivenReference, instruments::tabs::InstrumentTab};

/// Waits for a full image of what the controls say, as the window shows it.
fn full(window: &mut Window) {
    window.run_steps(2);
    wait(window, "a full image", |app| {
        app.worker().request().is_some_and(|request| request.camera == app.camera()) && app.can_save()
    });
    window.run_steps(2);
}

fn says(window: &Window, text: &str) -> bool {
    window.query_all_by_label_contains(text).count() > 0
}

/// Whether the line below states the error.
fn states_error(window: &Window) -> bool {
    let mut labels = window.get_all_by_role(Role::Label);
    labels.any(|label| label.accesskit_node().value().is_some_and(|text| text.starts_with("error ")))
}

#[test]
fn the_truth_of_the_scene_goes_with_its_camera_and_comes_back_with_it() {
    let mut window = window("furnace");
    full(&mut window);
    assert!(window.state().measured_error().is_some() && states_error(&window) && says(&window, "from the scene"));
    // Another resolution is another sampling of the same image.
    window.state_mut().camera_mut().resolution = [48, 40];
    full(&mut window);
    assert!(window.state().measured_error().is_some());
    *window.state_mut().tab_mut() = Some(InstrumentTab::Convergence);
    window.state_mut().camera_mut().fov = 50.0;
    full(&mut window);
    assert!(window.state().measured_error().is_none() && window.state().reference().is_none());
    assert!(!states_error(&window) && !says(&window, "from the scene") && says(&window, "for the scene's camera only"));
    wait(&mut window, "a curve", |app| app.curves().curves.first().is_some_and(|curve| !curve.moments.is_empty()));
    let has_truth = |app: &App| app.curves().curves.iter().flat_map(|curve| &curve.moments).any(|m| m.true_error.is_some());
    assert!(!has_truth(window.state()));
    let of_elsewhere = window.state().shown_frame().clone().expect("it is shown");
    window.key_press(Key::Home);
    window.run_steps(2);
    // The last image of elsewhere is never held against the truth, not even while it is the one that is shown.
    let request = window.state_mut().display_request(of_elsewhere);
    assert!(request.reference.is_none() && window.state().reference().is_some());
    full(&mut window);
    assert!(window.state().measured_error().is_some() && says(&window, "from the scene"));
}

#[test]
fn a_given_reference_holds_for_the_camera_that_it_was_dropped_at() {
    let mut window = window("cornell_spheres");
    full(&mut window);
    let (camera, frame) = (window.state().camera(), window.state().shown_frame().clone().expect("it is shown"));
    let reference = std::sync::Arc::new(noisefall_render::render::reference::Reference::Constant(frame.radiance[0]));
    window.state_mut().session.given_reference =
        Some(GivenReference { name: "mine.exr".to_owned(), reference, camera, scene: None });
    wait(&mut window, "the error", |app| app.measured_error().is_some());
    window.run_steps(2);
    assert!(says(&window, "mine.exr") && says(&window, "estimated error unknown"));
    *window.state_mut().camera_mut() = Camera { eye: camera.eye + DVec3::X * 0.1, ..camera };
    full(&mut window);
    assert!(window.state().measured_error().is_none() && !states_error(&window));
    *window.state_mut().camera_mut() = camera;
    full(&mut window);
    assert!(window.state().measured_error().is_some());
    click(&mut window, "Remove");
    wait(&mut window, "no truth", |app| app.measured_error().is_none());
    assert!(window.state().session.given_reference.is_none() && !says(&window, "mine.exr"));
}

#[test]
fn curves_have_the_figures_of_their_own_settings() {
    let mut window = window("furnace");
    let app = window.state_mut();
    app.session.budget = Budget { max_spp: Some(4), ..Budget::default() };
    // The curve of earlier settings is longer, and would stay.
    app.settings_mut().seed = 7;
    let other = noisefall_scene::scene::RenderSettings { max_bounces: Some(0), ..app.settings() };
    app.start_comparison(other);
    wait(&mut window, "both", |app| {
        let curves: Vec<_> = app.curves().curves.iter().filter(|curve| curve.settings.seed == 7).collect();
        curves.len() == 2 && curves.iter().all(|curve| curve.moments.last().is_some_and(|moment| moment.spp == 4))
    });
    for curve in window.state().curves().curves.iter().filter(|curve| curve.settings.seed == 7) {
        let error = curve.moments.last().and_then(|moment| moment.true_error).expect("the truth is known");
        // A cap of 0 leaves 1 of 2.
        assert_eq!(curve.settings == other, error > 0.4, "{error}");
    }
}

#[test]
fn paths_that_were_cut_are_called_biased() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mirrors.toml");
    // Light is outside of a ball of mirrors, so no path in it ever ends by itself.
    let text = "format = 1\n[camera]\neye = [0.0, 0.0, 0.0]\nlook_at = [1.0, 0.0, 0.0]\nfov = 40.0\nresolution = [4, 4]\n\
                [materials.mirror]\nmirror = { reflectance = 1.0 }\n\
                [[objects]]\nshape = { sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 } }\nmaterial = \"mirror\"\n\
                [[objects]]\nshape = { sphere = { center = [5.0, 0.0, 0.0], radius = 1.0 } }\nemission = { radiance = 1.0 }\n\
                [render]\nroulette = \"off\"\nspp = 2\n";
    std::fs::write(&path, text).expect("it is written");
    let mut window = open(Some(path));
    wait(&mut window, "the samples", |app| app.status().spp == 2 && app.status().cut_paths > 0);
    window.run_steps(2);
    assert_eq!(window.state().status().cut_paths, 32);
    assert!(window.query_by_label("biased: 32 paths cut").is_some() && window.query_by_label("unbiased").is_none());
    assert!(says(&window, "paths cut after 4096"));
}
