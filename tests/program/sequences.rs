//! Layers, turntables and camera paths on the command line.
use std::fs;

use noisefall::render::image_file::read;

use crate::command_line::{Shell, scene, text};

const SMALL: [&str; 4] = ["--spp", "4", "--size", "24x16"];

/// Names of the channels of an EXR.
fn channels(shell: &Shell, name: &str) -> Vec<String> {
    let meta = exr::meta::MetaData::read_from_file(shell.path(name), false).expect("it has a header");
    meta.headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect()
}

#[test]
fn an_exr_with_layers_has_the_image_of_one_without() {
    let shell = Shell::new();
    let spheres = scene("cornell_spheres");
    let render = |rest: &[&str]| shell.run(&[&["render", &spheres], &SMALL[..], rest].concat());
    for (name, layers) in [("plain.exr", &[][..]), ("all.exr", &["--layers", "all"]), ("again.exr", &["--layers", "all"])] {
        let done = render(&[&["-o", name], layers].concat());
        assert!(done.status.success() && done.stderr.is_empty(), "{}", text(&done.stderr));
    }
    assert!(fs::read(shell.path("all.exr")).expect("a file") == fs::read(shell.path("again.exr")).expect("a file"));
    let radiance = |name: &str| read(&shell.path(name)).expect("an image").radiance;
    assert_eq!(radiance("plain.exr"), radiance("all.exr"));
    let names = channels(&shell, "all.exr");
    for name in ["R", "Bounce0.R", "Bounce7AndMore.B", "Albedo.G", "Normal.Z", "Depth.Z", "Position.X", "IndexOB.X", "IndexMA.X"]
    {
        assert!(names.iter().any(|known| known == name), "{name} is not among {names:?}");
    }
    let compared = shell.run(&["compare", "all.exr", "plain.exr"]);
    assert!(compared.status.success(), "{}", text(&compared.stderr));
    let capped = render(&["-o", "capped.exr", "--layers", "bounces,depth", "--max-bounces", "1"]);
    assert!(capped.status.success());
    let names = channels(&shell, "capped.exr").join(" ");
    let expected = "B Bounce0.B Bounce0.G Bounce0.R Bounce1.B Bounce1.G Bounce1.R Depth.Z G R variance.B variance.G variance.R \
                    variance.block";
    assert_eq!(names, expected);
    let png = render(&["-o", "out.png", "--layers", "all"]);
    assert!(text(&png.stderr).contains("--layers affects an EXR only"));
    assert_eq!(render(&["-o", "a.exr", "--layers", "z"]).status.code(), Some(2));
}

#[test]
fn every_frame_of_a_turntable_is_the_image_of_its_camera() {
    let shell = Shell::new();
    let furnace = scene("cornell_spheres");
    let turn =
        |rest: &[&str]| shell.run(&[&["render", &furnace, "--turntable", "3", "-o", "turn-##.png"], &SMALL[..], rest].concat());
    let done = turn(&[]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(text(&done.stdout).lines().filter(|line| line.contains("4 spp")).count(), 3);
    let bytes = |name: &str| fs::read(shell.path(name)).expect("it is there");
    let still = shell.run(&[&["render", &furnace, "-o", "still.png"], &SMALL[..]].concat());
    assert!(still.status.success() && bytes("still.png") == bytes("turn-01.png"), "the first frame is the scene's camera");
    for frame in ["turn-02.png", "turn-03.png"] {
        let still = shell.run(&["render", frame, "-o", "still.png", "--spp", "4"]);
        assert!(still.status.success(), "{}", text(&still.stderr));
        assert_eq!(read(&shell.path("still.png")).expect("an image"), read(&shell.path(frame)).expect("an image"), "{frame}");
    }
    // Frames that exist stay, and one that is missing comes back.
    let third = bytes("turn-03.png");
    fs::remove_file(shell.path("turn-03.png")).expect("it is there");
    fs::write(shell.path("turn-02.png"), "kept").expect("it is written");
    let resumed = turn(&["--resume"]);
    assert!(text(&resumed.stderr).contains("2 of 3 frames exist and are skipped"), "{}", text(&resumed.stderr));
    assert!(bytes("turn-02.png") == b"kept" && bytes("turn-03.png") == third);
    assert!(turn(&[]).status.success() && bytes("turn-02.png") != b"kept", "without --resume all are rendered");
}

#[test]
fn every_file_of_a_sequence_is_checked_before_the_first_frame() {
    let shell = Shell::new();
    fs::create_dir(shell.path("turn-3.png")).expect("a folder");
    let furnace = scene("furnace");
    for rest in [&[][..], &["--resume"]] {
        let refused = shell.run(&[&["render", &furnace, "--turntable", "3", "-o", "turn-#.png"], &SMALL[..], rest].concat());
        let told = text(&refused.stderr);
        assert!(refused.status.code() == Some(1) && told.contains("turn-3.png: cannot be written"), "{told}");
        // A folder is no frame.
        assert!(!told.contains("left out") && !shell.path("turn-1.png").exists(), "{told}");
    }
}

#[test]
fn a_camera_path_is_rendered_from_its_file() {
    let shell = Shell::new();
    let key = |time: f64, x: f64| format!("[[camera]]\ntime = {time:?}\neye = [{x:?}, 1.0, 4.0]\nlook_at = [0.0, 1.0, 0.0]\n");
    fs::write(shell.path("path.toml"), format!("frames = 2\n{}{}", key(0.0, -0.5), key(1.0, 0.5))).expect("it is written");
    let spheres = scene("cornell_spheres");
    let render = |rest: &[&str]| shell.run(&[&["render", &spheres], &SMALL[..], rest].concat());
    let done = render(&["--cameras", "path.toml", "-o", "#.exr", "--layers", "normal"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(read(&shell.path("1.exr")).expect("an image").radiance != read(&shell.path("2.exr")).expect("an image").radiance);
    assert!(channels(&shell, "2.exr").contains(&"Normal.X".to_owned()));
    fs::write(shell.path("path.toml"), "frames = 2\n[[camera]]\ntim = 1.0\n").expect("it is written");
    let refused = render(&["--cameras", "path.toml", "-o", "#.exr"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("path.toml"), "{}", text(&refused.stderr));
    for wrong in [
        &["--turntable", "3", "-o", "out.png"][..],
        &["--turntable", "0", "-o", "#.png"],
        &["--turntable", "3", "--cameras", "path.toml", "-o", "#.png"],
        &["--resume", "-o", "#.png"],
        &["--turntable", "3", "-o", "-", "--format", "png"],
    ] {
        assert_eq!(render(wrong).status.code(), Some(2), "{wrong:?}");
    }
}
