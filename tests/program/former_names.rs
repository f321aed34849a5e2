//! Scene files with the names of before 0.1: the reader names the new ones, and `convert` rewrites them.
use std::fs;

use noisefall_render::render::image_file::read;
use noisefall_scene::scene::{RENAMED, ShippedScene};

use super::command_line::{Shell, scene, text};

const OLD: &str = "# Two lights.\n\
    format = 1\n\
    camera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 12] }\n\
    materials.white.lambertian.albedo = 0.5\n\
    background.radiance = 0.2 # evening\n\n\
    [render] # how\n\
    estimator = 'forward'   # slow\n\
    reuse = \"on\"\n\
    max_bounces = 2\n\n\
    [[lamps]]\n\
    point = { position = [0, 3, 2], intensity = 4 } # above\n\n\
    [[objects]]\n\
    shape.sphere = { center = [0, 0, 0], radius = 1 }\n\
    material = \"white\"\n\n\
    [truth] # not really\n\
    radiance = 0.2\n";

#[test]
fn the_reader_names_the_new_name_of_each_old_one() {
    let shell = Shell::new();
    fs::write(shell.path("old.toml"), OLD).expect("it is written");
    let refused = shell.run(&["check", "old.toml"]);
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    for (old, new) in [("forward", "light_tracing"), ("on", "suffixes")] {
        assert!(said.contains(&format!("`{old}` is now `{new}`")), "{old}: {said}");
    }
    assert!(said.contains("noisefall convert"), "{said}");
    let old_keys = OLD.replace("'forward'", "'mis'").replace("\"on\"", "\"off\"");
    fs::write(shell.path("keys.toml"), old_keys).expect("it is written");
    for arguments in [&["check", "keys.toml"][..], &["render", "keys.toml", "-o", "a.exr", "--spp", "2"]] {
        let read = shell.run(arguments);
        let said = text(&read.stdout) + &text(&read.stderr);
        assert!(read.status.success(), "{said}");
        for (old, new) in [("lamps", "lights"), ("truth", "reference"), ("background", "environment")] {
            assert!(said.contains(&format!("warning: `{old}` is now `{new}`")), "{old}: {said}");
        }
    }
}

#[test]
fn a_rewritten_file_keeps_its_comments() {
    let shell = Shell::new();
    fs::write(shell.path("old.toml"), OLD).expect("it is written");
    let done = shell.run(&["convert", "old.toml", "-o", "new.toml"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let new = fs::read_to_string(shell.path("new.toml")).expect("it is there");
    let expected = OLD
        .replace("background", "environment")
        .replace("'forward'", "\"light_tracing\"")
        .replace("\"on\"", "\"suffixes\"")
        .replace("lamps", "lights")
        .replace("truth", "reference");
    assert_eq!(new, expected);
    assert!(shell.run(&["check", "new.toml"]).status.success());
}

/// The text of a rewritten scene is that of the scene, so its image is too.
#[test]
fn shipped_scenes_with_old_names_come_back() {
    let shell = Shell::new();
    let mut changed = 0;
    for shipped in ShippedScene::all().into_iter().filter(|shipped| shipped.files().next().is_none()) {
        let ShippedScene { name, text: current } = shipped;
        let old = RENAMED.iter().fold(current.to_owned(), |text, renamed| match renamed.place {
            [] => text.replace(&format!("[{}]", renamed.now), &format!("[{}]", renamed.former)),
            [.., key] => text.replace(&format!("{key} = \"{}\"", renamed.now), &format!("{key} = \"{}\"", renamed.former)),
        });
        if old == current {
            continue;
        }
        changed += 1;
        let file = format!("{name}.toml");
        fs::write(shell.path(&file), &old).expect("it is written");
        let done = shell.run(&["convert", &file, "-o", "new.toml"]);
        assert!(done.status.success(), "{name}: {}", text(&done.stderr));
        assert_eq!(fs::read_to_string(shell.path("new.toml")).expect("it is there"), current, "{name}");
    }
    assert!(changed > 10, "{changed} scenes have names that were others");
}

/// Scripts outside of the project write `[background]`.
#[test]
fn a_background_is_still_read() {
    let shell = Shell::new();
    let current = fs::read_to_string(scene("depth_of_field")).expect("it is shipped");
    for (name, text) in [("new", current.clone()), ("old", current.replace("[environment]", "[background]"))] {
        fs::write(shell.path(&format!("{name}.toml")), text).expect("it is written");
    }
    assert!(current.contains("[environment]"));
    let image = |name: &str| {
        let (scene, image) = (format!("{name}.toml"), format!("{name}.exr"));
        let done = shell.run(&["render", &scene, "-o", &image, "--spp", "2", "--size", "16x12"]);
        assert!(done.status.success() && text(&done.stderr).is_empty() == (name == "new"), "{}", text(&done.stderr));
        read(&shell.path(&image)).expect("an image").radiance
    };
    assert!(image("new") == image("old"));
    let both = current + "\n[background]\nradiance = 1\n";
    fs::write(shell.path("both.toml"), both).expect("it is written");
    assert!(text(&shell.run(&["check", "both.toml"]).stderr).contains("`background` is now `environment`"));
}
