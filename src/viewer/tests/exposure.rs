//! A scene far outside the range of the display offers an exposure, and keeps the one that is chosen.
use std::path::Path as FilePath;

use noisefall_scene::scene::describe;

use super::{scene_files::save, *};

/// A scene under a sky of this radiance.
fn under(folder: &FilePath, radiance: f64) -> PathBuf {
    let path = folder.join("sky.toml");
    let text = format!(
        "format = 1\n\n[camera]\neye = [0.0, 1.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 40.0\nresolution = [48, 32]\n\n\
         [environment]\nradiance = {radiance:?}\n\n[materials.grey]\nlambertian = {{ albedo = 0.5 }}\n\n\
         [[objects]]\nmaterial = \"grey\"\nshape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 0.5 }}\n"
    );
    std::fs::write(&path, text).expect("it is written");
    path
}

/// A window in which the first image of a scene has been measured.
fn measured(path: PathBuf) -> Window {
    let mut window = open(Some(path));
    wait(&mut window, "the scene", |app| app.opened().is_some());
    wait(&mut window, "its first image", |app| !app.results.awaits_meter);
    window.run_steps(3);
    window
}

fn exposure(window: &Window) -> f32 {
    window.state().look().display.exposure
}

#[test]
fn one_click_sets_the_exposure_and_saving_keeps_it() {
    let folder = tempfile::tempdir().expect("a folder");
    for (radiance, title, expected) in [(3000.0, "Too bright", -13.5), (1e-4, "Too dark", 11.5)] {
        let path = under(folder.path(), radiance);
        let mut window = measured(path.clone());
        assert!(window.query_by_label(title).is_some(), "{radiance}");
        never_restarts(&mut window, |w| click(w, "Set exposure"));
        assert!((exposure(&window) - expected).abs() < 1.1, "{}", exposure(&window));
        assert!(window.query_by_label(title).is_none() && !window.state().has_unsaved_changes());
        save(&mut window);
        assert!(!window.state().has_unsaved_changes());
        let text = std::fs::read_to_string(&path).expect("it is there");
        let kept = describe("sky.toml", text).expect("it is a scene").render.exposure;
        assert_eq!(kept, exposure(&window));
        let again = measured(path);
        assert_eq!(exposure(&again), kept);
        assert!(again.query_by_label(title).is_none());
    }
}

#[test]
fn an_exposure_can_be_left_as_it_is_and_most_scenes_need_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = measured(under(folder.path(), 3000.0));
    click(&mut window, "Leave it");
    assert!(window.query_by_label("Too bright").is_none() && exposure(&window) == 0.0);
    for scene in ["cornell_spheres", "furnace", "bright_sky", "tiny_lamp"] {
        let window = measured(shipped(scene));
        assert_eq!(window.state().results.misfit, None, "{scene}");
    }
}
