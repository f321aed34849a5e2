//! Layers, turntables and camera paths on the command line.
use std::fs;

use noisefall_render::render::image_file::read;

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
fn a_frame_that_was_kept_continues_in_its_sequence() {
    let shell = Shell::new();
    let spheres = scene("cornell_spheres");
    let turn = |rest: &[&str]| {
        let command = ["render", &spheres, "--turntable", "3", "--frames", "2..4", "--size", "24x16", "--adaptive", "on"];
        shell.run(&[&command[..], rest].concat())
    };
    let kept = ["-o", "turn-##.exr", "--checkpoint", "turn-##.nf"];
    let at_once = turn(&["-o", "whole-##.exr", "--spp", "20"]);
    assert!(at_once.status.success(), "{}", text(&at_once.stderr));
    // The image of a frame carries its scene, camera and settings.
    let begun = shell.run(&["render", "whole-02.exr", "-o", "begun.exr", "--spp", "5", "--checkpoint", "turn-02.nf"]);
    assert!(begun.status.success(), "{}", text(&begun.stderr));
    let checkpoint = fs::read(shell.path("turn-02.nf")).expect("it is there");
    for (rest, expected) in [
        (&["--spp", "20"][..], "turn-02.nf: there is a render already. The same command with --resume continues it"),
        (
            &["--spp", "20", "--seed", "7", "--resume"],
            "turn-02.nf: the frame cannot be continued: its setting `seed` is 0, and not 7",
        ),
    ] {
        let refused = turn(&[&kept[..], rest].concat());
        assert!(!refused.status.success() && text(&refused.stderr).contains(expected), "{}", text(&refused.stderr));
    }
    fs::copy(shell.path("turn-02.nf"), shell.path("turn-03.nf")).expect("it is copied");
    let refused = turn(&[&kept[..], &["--spp", "20", "--resume"]].concat());
    let expected = "turn-03.nf: the frame cannot be continued: it has another camera";
    assert!(!refused.status.success() && text(&refused.stderr).contains(expected), "{}", text(&refused.stderr));
    fs::remove_file(shell.path("turn-03.nf")).expect("it is there");
    assert!(fs::read(shell.path("turn-02.nf")).expect("it is there") == checkpoint && !shell.path("turn-03.exr").exists());
    let resumed = turn(&[&kept[..], &["--spp", "20", "--resume"]].concat());
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    for frame in ["02.exr", "03.exr"] {
        let [resumed, whole] = ["turn", "whole"].map(|name| fs::read(shell.path(&format!("{name}-{frame}"))).expect("a frame"));
        assert!(resumed == whole, "{frame}");
    }
    // A frame that is finished needs no checkpoint.
    assert!(!shell.path("turn-02.nf").exists() && !shell.path("turn-03.nf").exists());
    let again = turn(&[&kept[..], &["--spp", "20", "--resume"]].concat());
    assert!(again.status.success() && text(&again.stderr).contains("2 of 2 frames exist and are skipped"));
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
        &["--turntable", "3", "-o", "#.png", "--checkpoint", "a.nf"],
        &["--turntable", "3", "-o", "#.png", "--checkpoint", "#.txt"],
    ] {
        assert_eq!(render(wrong).status.code(), Some(2), "{wrong:?}");
    }
}
