//! `noisefall …` as a user types it.
use std::{
    path::{Path, PathBuf},
    process::{Command, Output},
};

use super::scene_files::shipped_scenes;

pub(super) struct Shell {
    folder: tempfile::TempDir,
}

impl Shell {
    pub(super) fn new() -> Shell {
        Shell { folder: tempfile::tempdir().expect("a folder") }
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(super) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The program in the folder, without a display.
    pub(super) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_noisefall"));
        command.args(arguments).current_dir(self.folder.path()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        command
    }

    /// Runs it.
    pub(super) fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the program starts")
    }
}

pub(super) fn scene(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml")).display().to_string()
}

pub(super) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

pub(super) fn json(output: &Output) -> serde_json::Value {
    assert!(output.status.success(), "{}", text(&output.stderr));
    let stdout = text(&output.stdout);
    serde_json::from_str(stdout.lines().last().expect("a line")).expect("the last line is JSON")
}

#[test]
fn every_command_has_help() {
    let shell = Shell::new();
    for arguments in [
        &["--help"][..],
        &["render", "--help"],
        &["compare", "--help"],
        &["check", "--help"],
        &["convert", "--help"],
        &["validate", "--help"],
        &["study", "--help"],
        &["sheet", "--help"],
        &["evidence", "--help"],
        &["scenes", "--help"],
        &["man", "--help"],
        &["completions", "--help"],
    ] {
        let output = shell.run(arguments);
        assert!(output.status.success() && text(&output.stdout).contains("Usage: noisefall"));
    }
}

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn without_a_display_the_window_names_the_headless_command() {
    let output = Shell::new().run(&[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("noisefall render"));
    assert_eq!(text(&output.stderr).lines().count(), 1);
}

#[test]
fn a_render_writes_a_picture_and_one_line_of_json() {
    let shell = Shell::new();
    let arguments = ["render", &scene("furnace"), "-o", "out.exr", "--spp", "16", "--size", "40x30", "--seed", "3", "--json"];
    let line = json(&shell.run(&arguments));
    for (key, value) in [("width", 40), ("height", 30), ("spp", 16), ("seed", 3), ("paths", 40 * 30 * 16), ("invalid_samples", 0)]
    {
        assert_eq!(line[key], value, "{key}");
    }
    for key in ["scene", "threads", "build_seconds", "seconds", "rays", "rel_mse_estimate"] {
        assert!(!line[key].is_null(), "{key} is missing");
    }
    // Independent samples have a relMSE of 1/(2 · 4.04) per sample. Sobol samples are better, but 16 of them are not exact.
    let rel_mse = line["rel_mse"].as_f64().expect("the scene has a truth");
    assert!((0.0001..0.0078).contains(&rel_mse), "{rel_mse}");
    assert!(shell.path("out.exr").is_file());
}

#[test]
fn every_shipped_scene_can_be_saved_as_exr_and_png() {
    let shell = Shell::new();
    for scene in shipped_scenes() {
        let scene = scene.display().to_string();
        for file in ["out.exr", "out.png"] {
            let output = shell.run(&["render", &scene, "-o", file, "--spp", "1", "--size", "16x16"]);
            assert!(output.status.success(), "{scene}: {}", text(&output.stderr));
        }
    }
}

#[test]
fn equal_seeds_give_equal_files_whatever_the_threads() {
    let shell = Shell::new();
    for (file, threads) in [("a.exr", "1"), ("b.exr", "3")] {
        let done =
            shell.run(&["render", &scene("cornell_spheres"), "-o", file, "--spp", "4", "--size", "50x50", "--threads", threads]);
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let comparison = json(&shell.run(&["compare", "a.exr", "b.exr", "--json"]));
    assert_eq!((comparison["rmse"].as_f64(), comparison["rel_mse"].as_f64()), (Some(0.0), Some(0.0)));
    let other = shell.run(&["render", &scene("cornell_spheres"), "-o", "c.exr", "--spp", "4", "--size", "50x50", "--seed", "1"]);
    assert!(other.status.success());
    assert!(json(&shell.run(&["compare", "a.exr", "c.exr", "--json"]))["rmse"].as_f64() > Some(0.0));
}

#[test]
fn options_override_the_scene_and_the_summary_names_the_bias() {
    let shell = Shell::new();
    let summary = |arguments: &[&str]| {
        let output =
            shell.run(&[&["render", &scene("truncation"), "-o", "out.png", "--size", "16x16", "--spp", "2"], arguments].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    assert!(summary(&[]).contains("biased: cap at 2"));
    assert!(summary(&["--max-bounces", "5"]).contains("biased: cap at 5"));
    assert!(summary(&["--max-bounces", "none", "--roulette", "0.8", "--directions", "uniform"]).contains("unbiased"));
}

#[test]
fn of_several_targets_the_last_one_counts() {
    let shell = Shell::new();
    let render = |arguments: &[&str]| {
        let base = ["render", &scene("bright_sky"), "-o", "out.png", "--json"];
        let size: &[&str] = if arguments.contains(&"--size") { &[] } else { &["--size", "32x18"] };
        json(&shell.run(&[&base[..], size, arguments].concat()))
    };
    let by_samples = render(&["--noise", "0.0001", "--time", "100", "--spp", "64"]);
    assert_eq!((&by_samples["spp"], &by_samples["stopped_by"]), (&64.into(), &"samples".into()));
    // Noise targets count from 64 samples on, so the target must need more.
    let rel_mse = |line: &serde_json::Value| line["rel_mse_estimate"].as_f64().expect("an estimate");
    let goal = 0.7 * rel_mse(&by_samples).sqrt();
    let by_noise = render(&["--spp", "3", "--noise", &goal.to_string()]);
    assert_eq!(by_noise["stopped_by"], "noise");
    assert!(rel_mse(&by_noise).sqrt() <= goal && by_noise["spp"].as_u64() > Some(64), "{by_noise}");
    let by_time = render(&["--spp", "3", "--time", "0.2"]);
    assert!(by_time["seconds"].as_f64() >= Some(0.2) && by_time["stopped_by"] == "time", "{by_time}");
}

#[test]
fn a_path_can_be_replayed() {
    let shell = Shell::new();
    let arguments = ["render", &scene("furnace"), "--pixel", "3,4", "--sample", "2"];
    let printed = text(&shell.run(&arguments).stdout);
    for term in ["wall", "throughput", "position", "emission", "next direction", "cos θ", "radiance so far"] {
        assert!(printed.contains(term), "{term}: {printed}");
    }
    assert!(printed.lines().all(|line| line.chars().count() <= 100), "{printed}");
    let line = json(&shell.run(&[&arguments[..], &["--json"]].concat()));
    let vertex = &line["vertices"][0];
    for field in ["bounce", "origin", "direction", "throughput", "distance", "object", "normal", "radiance"] {
        assert!(!vertex[field].is_null(), "{field}: {vertex}");
    }
    assert!(vertex["emission"]["weight"] == 1.0 && vertex["reflection"]["survival"] == 1.0, "{vertex}");
    for pixel in ["8,4", "4,6"] {
        let outside = shell.run(&["render", &scene("furnace"), "--size", "8x6", "--pixel", pixel]);
        assert!(outside.status.code() == Some(1) && text(&outside.stderr).contains("outside the image of 8 × 6"), "{pixel}");
    }
}

#[test]
fn failures_exit_with_1_and_say_why_and_wrong_usage_with_2() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let fails = |arguments: &[&str], code: i32, message: &str| {
        let output = shell.run(arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        assert!(text(&output.stderr).contains(message), "{arguments:?}: {}", text(&output.stderr));
        assert!(!text(&output.stderr).contains("panicked"));
    };
    fails(&["render", "nowhere.toml", "-o", "out.png"], 1, "there is no such file");
    fails(&["render", &furnace, "-o", "out.jpg"], 2, ".png");
    fails(&["render", &furnace, "-o", "nowhere/out.png"], 1, "there is no folder");
    fails(&["render", &furnace, "-o", "out.png", "--size", "0x5"], 1, "resolution");
    fails(&["render", &furnace, "-o", "out.png", "--size", "99999x99999"], 1, "resolution");
    let long = format!("{}.png", "x".repeat(300));
    fails(&["render", &furnace, "-o", &long], 1, "cannot be written");
    std::fs::create_dir(shell.path("folder.png")).expect("a folder");
    fails(&["render", &furnace, "-o", "folder.png"], 1, "it is a folder");
    fails(
        &["render", &furnace, "-o", "out.png", "--estimator", "foo"],
        2,
        "path, light, mis, caustics, light_tracing, bidirectional or auto",
    );
    fails(&["render", &furnace], 2, "--output");
    fails(&["render", &furnace], 2, "-o <OUTPUT>");
    fails(&["render", &furnace, "-o", "out.png", "--spp", "0"], 2, "--spp");
    fails(&["render", &furnace, "-o", "out.png", "--sampler", "halton"], 2, "independent, stratified, sobol");
    fails(&["render", &furnace, "-o", "out.png", "--roulette", "2"], 2, "survival probability");
    fails(&["compare", "a.exr", "b.exr"], 1, "cannot be read");
    fails(&["check"], 2, "SCENES");
    fails(&["render", &furnace, "--pixel", "1,1", "-o", "out.png"], 2, "cannot be used with");
    fails(&["render", &furnace, "-o", "out.png", "--spp", "1e3"], 2, "expected a whole number");
    for (option, value) in [("--seed", "-1"), ("--time", "-1"), ("--noise", "-0.1"), ("--roulette", "-1"), ("--size", "-1x5")] {
        fails(&["render", &furnace, "-o", "out.png", option, value], 2, "invalid value");
    }
    fails(&["render", &furnace, "--pixel", "-1,5"], 2, "invalid value '-1,5'");
    fails(&["rendr", &furnace], 2, "there is no command `rendr`; did you mean `render`?");
    fails(&["paint", &furnace], 2, "there is no command `paint`");
}

#[test]
fn check_reports_every_bad_scene() {
    let shell = Shell::new();
    std::fs::write(shell.path("bad.toml"), "format = 1\ncamera = 3\n").expect("it is written");
    let output = shell.run(&["check", &scene("furnace"), "bad.toml", "nowhere.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).contains("furnace.toml: ok"));
    assert!(text(&output.stderr).contains("bad.toml:2:10") && text(&output.stderr).contains("nowhere.toml"));
}

#[test]
fn pictures_of_different_sizes_are_not_compared() {
    let shell = Shell::new();
    for (file, size) in [("a.png", "8x8"), ("b.png", "8x9")] {
        assert!(shell.run(&["render", &scene("furnace"), "-o", file, "--spp", "1", "--size", size]).status.success());
    }
    let output = shell.run(&["compare", "a.png", "b.png"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(text(&output.stderr), "the images differ in size: a.png is 8 × 8, b.png is 8 × 9\n");
}
