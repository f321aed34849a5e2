//! Ctrl+C, once and twice.
#![cfg(target_os = "linux")]
use std::{
    fs,
    io::{BufRead, BufReader, Read},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use noisefall_render::render::image_file::{SETTINGS_KEY, read};

use crate::command_line::{Shell, scene, text};

/// Starts the program, and waits until it handles interruptions. Before that, an interruption would end it at once.
fn start(shell: &Shell, arguments: &[&str]) -> Child {
    let mut command = shell.command(arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let began = Instant::now();
    while !listens(&child) {
        assert!(began.elapsed() < Duration::from_secs(60), "it never listens");
        assert!(child.try_wait().expect("its state").is_none(), "it has ended");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

/// Whether a process has a handler for the interruption signal.
fn listens(child: &Child) -> bool {
    const INTERRUPTION: u64 = 1 << 1;
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    caught.is_some_and(|mask| u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & INTERRUPTION != 0))
}

fn interrupt(child: &Child) {
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()));
}

#[test]
fn an_interrupted_render_saves_its_samples_and_states_their_number() {
    let shell = Shell::new();
    let endless = ["--spp", "100000000", "--size", "200x150", "--json"];
    let child = start(&shell, &[&["render", &scene("cornell_spheres"), "-o", "out.exr"], &endless[..]].concat());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    assert!(text(&output.stderr).starts_with("interrupted: saving the unfinished image"), "{}", text(&output.stderr));
    assert_eq!(output.status.code(), Some(130));
    let line: serde_json::Value = serde_json::from_str(text(&output.stdout).trim()).expect("a line of JSON");
    let number = |line: &serde_json::Value, key: &str| line[key].as_f64().unwrap_or_else(|| panic!("{key} in {line}"));
    assert_eq!(line["stopped_by"], "interruption");
    assert_eq!((number(&line, "mean_spp") * 200.0 * 150.0).round(), number(&line, "paths"));
    assert!(number(&line, "spp") >= 1.0 && number(&line, "spp") <= number(&line, "mean_spp"), "{line}");
    let meta = exr::meta::MetaData::read_from_file(shell.path("out.exr"), false).expect("it has a header");
    let settings = meta.headers[0].own_attributes.other.get(&exr::meta::attribute::Text::from(SETTINGS_KEY));
    let Some(exr::meta::attribute::AttributeValue::Text(settings)) = settings else { panic!("no settings") };
    let settings: serde_json::Value = serde_json::from_str(&settings.to_string()).expect("it is JSON");
    for (in_file, in_line) in [("spp", "spp"), ("mean_spp", "mean_spp"), ("samples", "paths")] {
        assert_eq!(number(&settings, in_file), number(&line, in_line), "{in_file}");
    }
    assert!(read(&shell.path("out.exr")).expect("an image").radiance.iter().flatten().all(|c| c.is_finite()));
}

#[test]
fn an_interrupted_sequence_drops_its_unfinished_frame_even_if_it_is_the_only_one() {
    let shell = Shell::new();
    let endless = ["--turntable", "1", "--spp", "100000000", "--size", "40x30"];
    let child = start(&shell, &[&["render", &scene("cornell_spheres"), "-o", "out-#.png"], &endless[..]].concat());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    let told = text(&output.stderr);
    assert!(told.starts_with("interrupted: the unfinished frame is dropped"), "{told}");
    assert!(told.contains("the same command with --resume continues it"), "{told}");
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(fs::read_dir(shell.path("")).expect("it is there").count(), 0, "no frame");
}

#[test]
fn an_interrupted_sequence_keeps_its_unfinished_frame_in_its_checkpoint() {
    let shell = Shell::new();
    let spheres = scene("cornell_spheres");
    let turn = ["render", &spheres, "--turntable", "1", "--size", "60x40", "-o", "out-#.exr", "--checkpoint", "out-#.nf"];
    let child = start(&shell, &[&turn[..], &["--spp", "100000000"]].concat());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    let told = text(&output.stderr);
    assert!(
        told.starts_with("interrupted: keeping the unfinished frame") && told.contains("with --resume continues it"),
        "{told}"
    );
    assert!(output.status.code() == Some(130) && !shell.path("out-1.exr").exists());
    // The checkpoint is that of a render, and both go on from the same samples.
    let alone = shell.run(&["render", "--resume", "out-1.nf", "-o", "alone.exr", "--spp", "1", "--checkpoint", "alone.nf"]);
    let resumed = shell.run(&[&turn[..], &["--spp", "1", "--resume"]].concat());
    for output in [&alone, &resumed] {
        assert!(output.status.success(), "{}", text(&output.stderr));
    }
    let bytes = |name: &str| fs::read(shell.path(name)).expect("it is there");
    assert!(bytes("out-1.exr") == bytes("alone.exr") && !shell.path("out-1.nf").exists());
}

#[test]
fn an_interrupted_sequence_of_samples_leaves_no_part_of_a_frame() {
    let shell = Shell::new();
    let endless = ["--turntable", "2", "--samples", "0..8000000", "--size", "40x30"];
    let child = start(&shell, &[&["render", &scene("cornell_spheres"), "-o", "out-#.nf"], &endless[..]].concat());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    let told = text(&output.stderr);
    assert!(told.starts_with("interrupted: the unfinished frame is dropped"), "{told}");
    assert!(told.contains("the same command with --resume continues it") && output.status.code() == Some(130), "{told}");
    assert_eq!(fs::read_dir(shell.path("")).expect("it is there").count(), 0, "no frame");
}

#[test]
fn a_second_interruption_ends_a_render_at_once() {
    let shell = Shell::new();
    // Paths have thousands of bounces, so the first sample of all pixels would take much longer than this test.
    let slow = "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = [2048, 2048]\n\
                [materials.white]\nlambertian = { albedo = 0.9999 }\n\
                [[objects]]\nshape = { sphere = { center = [0, 0, 0], radius = 1 } }\nmaterial = \"white\"\n\
                flip = true\nemission = { radiance = 1 }\n[render]\nroulette = \"off\"\n";
    fs::write(shell.path("slow.toml"), slow).expect("it is written");
    let mut child = start(&shell, &["render", "slow.toml", "-o", "out.exr", "--spp", "1"]);
    interrupt(&child);
    let mut told = BufReader::new(child.stderr.take().expect("a pipe"));
    let mut first = String::new();
    told.read_line(&mut first).expect("text");
    assert!(first.starts_with("interrupted: saving the unfinished image (interrupt again to stop at once)"), "{first}");
    interrupt(&child);
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert_eq!(fs::read_dir(shell.path("")).expect("it is there").count(), 1, "only the scene");
}

#[test]
fn an_interrupted_study_keeps_its_runs_and_says_how_to_go_on() {
    let shell = Shell::new();
    let long = ["--spp", "1000000", "--seconds", "1000", "--size", "64x64"];
    let mut child = start(&shell, &[&["study", &scene("bright_sky"), "-o", "out"], &long[..]].concat());
    interrupt(&child);
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let mut told = String::new();
    child.stderr.take().expect("a pipe").read_to_string(&mut told).expect("text");
    assert!(told.contains("stopped: out has 0 runs; repeat the command to continue"), "{told}");
}

#[test]
fn an_interrupted_render_that_is_kept_says_how_it_is_continued() {
    let shell = Shell::new();
    let endless = ["--spp", "100000000", "--size", "60x40", "--checkpoint", "a b.nf"];
    let child = start(&shell, &[&["render", &scene("cornell_spheres"), "-o", "out.exr"], &endless[..]].concat());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    let told = text(&output.stderr);
    assert!(told.contains("'a b.nf' keeps the render: `noisefall render --resume 'a b.nf' -o out.exr` continues it"), "{told}");
    assert_eq!(output.status.code(), Some(130));
    // The samples of the image are those of the checkpoint, also if it has a row of tiles more here than there.
    let again = shell.run(&["render", "--resume", "a b.nf", "-o", "again.exr", "--spp", "1"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    let bytes = |name: &str| fs::read(shell.path(name)).expect("it is there");
    assert!(bytes("out.exr") == bytes("again.exr"));
}
