//! The path inspector: what it shows is what the renderer took.
use noisefall_base::math::colour::luminance;
use noisefall_kernel::integrator::{Batch, TILE, Work, trace};
use noisefall_render::render::path_reuse::resolved;

use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

fn inspecting(scene: &str) -> Window {
    let mut window = window(scene);
    window.key_press(Key::I);
    window.run_steps(3);
    assert_eq!((window.state().tool(), window.state().tab()), (Tool::Inspect, Some(InstrumentTab::Path)));
    window
}

#[test]
fn a_clicked_pixel_shows_exactly_the_samples_that_the_renderer_took() {
    for scene in ["cornell_spheres", "glass_and_mirror", "veach_plates"] {
        let mut window = inspecting(scene);
        never_restarts(&mut window, |w| {
            click_at(w, Pos2::new(430.0, 430.0));
        });
        let pixel = window.state().path_inspector().pixel.expect("it was clicked");
        wait(&mut window, "its samples", |app| {
            app.path_inspector().histogram().is_some_and(|histogram| histogram.samples.len() >= 16)
                && app.path_inspector().replay().is_some()
        });
        let app = window.state();
        let histogram = app.path_inspector().histogram().expect("it is there");
        let (scene, camera) = (&app.opened().as_ref().expect("it is open").scene, &app.camera());
        let rays = scene.rays(camera);
        let settings = resolved(scene, &rays, &app.settings());
        // The tile, as the renderer traces it.
        let origin = pixel.map(|x| x / TILE * TILE);
        let size = [0, 1].map(|axis| TILE.min(camera.resolution[axis] - origin[axis]));
        let mut batch = Batch::default();
        for sample in 0..16 {
            let work = Work::tile(scene, &rays, &settings, origin, size, sample);
            trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nobody interrupts");
            let [r, g, b, _] = batch.radiance()[((pixel[1] - origin[1]) * TILE + pixel[0] - origin[0]) as usize];
            assert_eq!(histogram.samples[sample as usize].to_bits(), luminance([r, g, b]).to_bits(), "sample {sample}");
            if sample == 0 {
                let (number, replay) = app.path_inspector().replay().expect("it is there");
                assert_eq!((number, replay.radiance), (0, [r, g, b]), "the path that is shown");
            }
        }
    }
}

#[test]
fn one_steps_through_paths_and_the_table_adds_up() {
    let mut window = inspecting("cornell_spheres");
    click(&mut window, "Use the middle pixel");
    assert_eq!(window.state().path_inspector().pixel, Some([48, 32]));
    wait(&mut window, "its samples", |app| app.path_inspector().histogram().is_some());
    for expected in [1, 2] {
        never_restarts(&mut window, |w| click(w, "Next"));
        assert_eq!(window.state().path_inspector().sample, expected);
    }
    click(&mut window, "Brightest");
    let brightest = window.state().path_inspector().histogram().expect("it is there").brightest;
    assert_eq!(window.state().path_inspector().sample, brightest);
    wait(&mut window, "that path", |app| {
        let Some((number, replay)) = app.path_inspector().replay() else { return false };
        let histogram = app.path_inspector().histogram().expect("it is there");
        let replayed = luminance(replay.radiance);
        number == brightest && replayed.to_bits() == histogram.samples[brightest as usize].to_bits()
    });
    window.run_steps(3);
    assert!(window.query_by_label_contains(&format!("Sample {brightest}:")).is_some());
    let (_, replay) = window.state().path_inspector().replay().expect("it is there");
    let last = replay.vertices.last().expect("it has vertices").radiance;
    assert_eq!(last, replay.alone.unwrap_or(replay.radiance), "the sums end at the sample");
}

#[test]
fn the_inspected_path_follows_changes_of_the_image() {
    let mut window = inspecting("cornell_spheres");
    window.state_mut().path_inspector_mut().look_at([30, 20]);
    wait(&mut window, "its samples", |app| app.path_inspector().histogram().is_some() && app.path_inspector().replay().is_some());
    // By its fields, each axis for itself; another pixel begins with its first sample.
    window.state_mut().path_inspector_mut().sample = 5;
    for (label, value, expected) in [("x", 31.0, [31, 20]), ("y", 25.0, [31, 25])] {
        window.get_by_role_and_label(Role::SpinButton, label).set_value_accesskit(value);
        window.run_steps(3);
        assert_eq!((window.state().path_inspector().pixel, window.state().path_inspector().sample), (Some(expected), 0));
    }
    window.get_by_role_and_label(Role::SpinButton, "Sample").set_value_accesskit(3.0);
    window.run_steps(2);
    click(&mut window, "Previous");
    assert_eq!(window.state().path_inspector().sample, 2);
    for change in [|app: &mut App| app.settings_mut().seed = 17, |app: &mut App| app.camera_mut().fov = 50.0] {
        change(window.state_mut());
        window.run_steps(2);
        wait(&mut window, "its path", |app| app.path_inspector().replay().is_some_and(|(number, _)| number == 2));
        let app = window.state();
        let scene = &app.opened().as_ref().expect("it is open").scene;
        let rays = scene.rays(&app.camera());
        let replay = noisefall_kernel::integrator::replay(scene, &rays, &resolved(scene, &rays, &app.settings()), [31, 25], 2);
        assert_eq!(app.path_inspector().replay().map(|(_, shown)| shown.vertices.clone()), Some(replay.vertices));
    }
    // A pixel that the image has no more is not inspected.
    window.state_mut().camera_mut().resolution = [31, 25];
    wait(&mut window, "its end", |app| app.path_inspector().pixel.is_none() && app.path_inspector().replay().is_none());
}

/// The light that a surface sends to the sky goes nowhere: a dashed line says in which direction.
#[test]
fn a_path_that_leaves_the_scene_ends_in_a_dashed_line() {
    let mut window = inspecting("bright_sky");
    let [width, height] = window.state().camera().resolution;
    window.state_mut().path_inspector_mut().look_at([width / 2, height - 2]);
    for sample in 0..64 {
        window.state_mut().path_inspector_mut().sample = sample;
        wait(&mut window, "its path", |app| app.path_inspector().replay().is_some_and(|(number, _)| number == sample));
        let (_, replay) = window.state().path_inspector().replay().expect("it is there");
        if replay.vertices.len() == 2 && replay.vertices[1].surface.is_none() {
            break;
        }
    }
    let (_, replay) = window.state().path_inspector().replay().expect("it is there");
    assert!(replay.vertices.len() == 2 && replay.vertices[1].surface.is_none(), "one of the first samples leaves at once");
    window.run_steps(2);
    let yellow = egui::Color32::from_rgb(255, 214, 90);
    let is_dash = |shape: &egui::Shape| matches!(shape, egui::Shape::LineSegment { stroke, .. } if stroke.width == 1.2 && stroke.color == yellow);
    assert!(window.output().shapes.iter().any(|clipped| is_dash(&clipped.shape)));
    // Where the camera's own ray meets nothing there is no point to draw it from.
    window.state_mut().path_inspector_mut().look_at([width / 2, 0]);
    wait(&mut window, "a path of the sky", |app| {
        app.path_inspector().replay().is_some_and(|(_, replay)| replay.vertices.len() == 1)
    });
    window.run_steps(2);
    assert!(!window.output().shapes.iter().any(|clipped| is_dash(&clipped.shape)));
}

#[test]
fn an_inspected_path_can_be_copied() {
    let mut window = inspecting("cornell_spheres");
    window.state_mut().path_inspector_mut().look_at([30, 20]);
    wait(&mut window, "its samples", |app| app.path_inspector().histogram().is_some() && app.path_inspector().replay().is_some());
    for (button, says) in [
        ("Text", "pixel 30,20, sample 0: radiance "),
        ("LaTeX", "\\begin{align*}"),
        ("Samples", "sample,red,green,blue,luminance,mean,variance\n0,"),
    ] {
        window.get_by_label(button).click();
        window.step();
        let copied =
            |command: &egui::OutputCommand| matches!(command, egui::OutputCommand::CopyText(text) if text.contains(says));
        assert!(window.output().platform_output.commands.iter().any(copied), "{button}");
    }
}

#[test]
fn an_inspected_path_can_be_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = inspecting("cornell_spheres");
    window.state_mut().path_inspector_mut().look_at([30, 20]);
    wait(&mut window, "its samples", |app| app.path_inspector().histogram().is_some() && app.path_inspector().replay().is_some());
    for (name, says) in [
        ("path.txt", "pixel 30,20, sample 0: radiance "),
        ("path.tex", "\\begin{align*}"),
        ("path.csv", "sample,red,green,blue,luminance,mean,variance\n0,"),
    ] {
        let path = folder.path().join(name);
        click(&mut window, "Save as…");
        window.run_steps(3);
        window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
        window.run_steps(3);
        click(&mut window, "Save");
        wait(&mut window, "the file", |_| path.is_file());
        let saved = std::fs::read_to_string(&path).expect("it is there");
        assert!(saved.contains(says) && window.state().dialogs.save.is_none(), "{name}: {saved}");
    }
}

#[test]
fn a_path_is_drawn_from_its_pixel_over_the_points_that_it_met() {
    let mut window = inspecting("cornell_spheres");
    window.state_mut().path_inspector_mut().look_at([20, 40]);
    wait(&mut window, "its path", |app| app.path_inspector().replay().is_some_and(|(_, replay)| replay.vertices.len() > 1));
    window.run_steps(2);
    let zoom = window.state().picture_view().drawn_zoom;
    let mut circles = Vec::new();
    let mut square = None;
    for clipped in &window.output().shapes {
        match &clipped.shape {
            egui::Shape::Circle(circle) if circle.radius == 4.0 => circles.push(circle.center),
            egui::Shape::Rect(rect) if (rect.rect.size() - egui::Vec2::splat(zoom + 2.0)).length() < 0.1 => {
                square = Some(rect.rect);
            }
            _ => {}
        }
    }
    let square = square.expect("the pixel is marked");
    window.hover_at(square.center());
    window.run_steps(2);
    assert_eq!(window.state().hovered(), Some([20, 40]));
    assert!(square.expand(1.0).contains(circles[0]), "the first point lies in the pixel: {circles:?} {square:?}");
    let (_, replay) = window.state().path_inspector().replay().expect("it is there");
    assert!(circles.len() >= 2 && circles.len() <= replay.vertices.len());
}
