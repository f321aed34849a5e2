//! `render --samples` and `merge` as a user types them.
use std::{fs, process::Output};

use super::command_line::{Shell, json, scene, text};

const SIZE: [&str; 2] = ["--size", "40x30"];

/// Renders samples of a scene; panics if that fails.
fn part(shell: &Shell, name: &str, samples: &str, output: &str, rest: &[&str]) {
    let done = try_part(shell, name, samples, output, rest);
    assert!(done.status.success(), "{}", text(&done.stderr));
}

fn try_part(shell: &Shell, name: &str, samples: &str, output: &str, rest: &[&str]) -> Output {
    shell.run(&[&["render", &scene(name), "--samples", samples, "-o", output], &SIZE[..], rest].concat())
}

fn merge(shell: &Shell, arguments: &[&str]) -> Output {
    shell.run(&[&["merge"], arguments].concat())
}

/// The message of a merge that is refused.
fn refusal(shell: &Shell, arguments: &[&str]) -> String {
    let done = merge(shell, arguments);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    text(&done.stderr)
}

fn bytes(shell: &Shell, name: &str) -> Vec<u8> {
    fs::read(shell.path(name)).expect("a file")
}

#[test]
fn parts_join_to_the_file_of_one_render() {
    let shell = Shell::new();
    part(&shell, "cornell_spheres", "0..9", "whole.exr", &[]);
    part(&shell, "cornell_spheres", "0..9", "whole.png", &[]);
    for (samples, name) in [("0..2", "a.nf"), ("2..6", "b.nf"), ("6..9", "c.nf")] {
        part(&shell, "cornell_spheres", samples, name, &["--threads", "1"]);
    }
    let done = merge(&shell, &["c.nf", "a.nf", "b.nf", "-o", "joined.exr"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("c.nf: samples 6..9"), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("joined.exr: samples 0..9 (9 spp), estimated error at most "), "{}", text(&done.stdout));
    assert!(bytes(&shell, "joined.exr") == bytes(&shell, "whole.exr"));
    assert!(merge(&shell, &["c.nf", "b.nf", "-o", "bc.nf"]).status.success());
    assert!(merge(&shell, &["bc.nf", "a.nf", "-o", "joined.png"]).status.success());
    assert!(bytes(&shell, "joined.png") == bytes(&shell, "whole.png"));
    let compared = shell.run(&["compare", "joined.exr", "whole.exr", "--json"]);
    assert_eq!(json(&compared)["rmse"], 0.0);
}

#[test]
fn parts_with_paths_from_lights_join_to_the_file_of_one_render() {
    let shell = Shell::new();
    for estimator in ["light_tracing", "bidirectional"] {
        let of = ["--estimator", estimator];
        part(&shell, "glass_ball_caustic", "0..7", "whole.exr", &of);
        for (samples, name) in [("0..3", "a.nf"), ("3..4", "b.nf"), ("4..7", "c.nf")] {
            part(&shell, "glass_ball_caustic", samples, name, &[&of[..], &["--threads", "1"]].concat());
        }
        let done = merge(&shell, &["c.nf", "a.nf", "b.nf", "-o", "joined.exr"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        assert!(bytes(&shell, "joined.exr") == bytes(&shell, "whole.exr"), "{estimator}");
    }
}

#[test]
fn overlaps_gaps_and_foreign_files_are_refused_by_name() {
    let shell = Shell::new();
    part(&shell, "furnace", "0..4", "a.nf", &[]);
    part(&shell, "furnace", "3..6", "b.nf", &[]);
    part(&shell, "furnace", "8..10", "c.nf", &[]);
    part(&shell, "furnace", "4..8", "seed.nf", &["--seed", "5"]);
    part(&shell, "bright_sky", "4..8", "sky.nf", &[]);
    let said = refusal(&shell, &["a.nf", "b.nf", "-o", "out.exr"]);
    assert!(said.contains("b.nf and a.nf both have the samples 3..4"), "{said}");
    let said = refusal(&shell, &["a.nf", "c.nf", "-o", "out.exr"]);
    assert!(said.contains("the samples 4..8 are missing") && said.contains("--allow-gaps"), "{said}");
    let said = refusal(&shell, &["c.nf", "-o", "out.exr"]);
    assert!(said.contains("the samples 0..8 are missing"), "{said}");
    let said = refusal(&shell, &["a.nf", "--until", "5", "-o", "out.exr"]);
    assert!(said.contains("the samples 4..5 are missing"), "{said}");
    let said = refusal(&shell, &["a.nf", "seed.nf", "-o", "out.exr"]);
    assert!(said.contains("seed.nf cannot be joined with a.nf: its setting `seed` is 5, and not 0"), "{said}");
    let said = refusal(&shell, &["a.nf", "sky.nf", "-o", "out.exr"]);
    assert!(said.contains("sky.nf cannot be joined with a.nf: it is of another scene"), "{said}");
    fs::write(shell.path("foreign.nf"), "no render").expect("it is written");
    let said = refusal(&shell, &["a.nf", "foreign.nf", "-o", "out.exr"]);
    assert!(said.contains("foreign.nf: this is not a render file"), "{said}");
    let whole = bytes(&shell, "a.nf");
    fs::write(shell.path("cut.nf"), &whole[..whole.len() / 2]).expect("it is written");
    let said = refusal(&shell, &["cut.nf", "-o", "out.exr"]);
    assert!(said.contains("cut.nf: the file is cut off"), "{said}");
    assert!(!shell.path("out.exr").exists());

    let done = merge(&shell, &["a.nf", "c.nf", "--allow-gaps", "-o", "gaps.exr"]);
    assert!(done.status.success() && text(&done.stderr).contains("the samples 4..8 are missing"), "{}", text(&done.stderr));
    let metadata = String::from_utf8_lossy(&bytes(&shell, "gaps.exr")).into_owned();
    assert!(metadata.contains("\"missing_samples\":\"4..8\"") && metadata.contains("\"sample_ranges\":\"0..4, 8..10\""));
}

#[test]
fn targets_that_depend_on_the_samples_are_refused_with_advice() {
    let shell = Shell::new();
    for option in ["--noise", "--time"] {
        let done = try_part(&shell, "furnace", "0..4", "a.nf", &[option, "0.5"]);
        assert_eq!(done.status.code(), Some(2));
        assert!(
            text(&done.stderr).contains("rounds of a fixed number of samples") || text(&done.stderr).contains("Render rounds")
        );
    }
    let done = try_part(&shell, "furnace", "0..4", "a.exr", &["--denoise"]);
    assert!(done.status.code() == Some(2) && text(&done.stderr).contains("--denoise cannot be combined with --samples"));
    let done = shell.run(&["render", &scene("furnace"), "-o", "a.nf"]);
    assert!(done.status.code() == Some(2) && text(&done.stderr).contains("--samples A..B"), "{}", text(&done.stderr));
    let many = try_part(&shell, "furnace", "0..9000000", "a.nf", &[]);
    assert!(many.status.code() == Some(1) && text(&many.stderr).contains("8388608 samples"), "{}", text(&many.stderr));
}

#[test]
fn a_watching_merge_waits_for_whole_files_until_all_samples_are_there() {
    let shell = Shell::new();
    fs::create_dir(shell.path("parts")).expect("a folder");
    part(&shell, "furnace", "0..6", "whole.exr", &[]);
    part(&shell, "furnace", "0..4", "parts/a.nf", &[]);
    part(&shell, "furnace", "4..6", "late.nf", &[]);
    let late = bytes(&shell, "late.nf");
    fs::write(shell.path("parts/b.nf"), &late[..late.len() / 3]).expect("it is written");
    let watching = shell
        .command(&["merge", "parts", "--watch", "0.05", "--until", "6", "-o", "joined.exr"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(400));
    assert!(!shell.path("joined.exr").exists());
    fs::rename(shell.path("late.nf"), shell.path("parts/b.nf")).expect("it is moved");
    let done = watching.wait_with_output().expect("it ends");
    let said = text(&done.stderr);
    assert!(done.status.success() && said.contains("missing: 4..6") && said.contains("samples 0..6, complete"), "{said}");
    assert!(bytes(&shell, "joined.exr") == bytes(&shell, "whole.exr"));
}

#[test]
fn frames_of_a_sequence_are_split_too() {
    let shell = Shell::new();
    let turn = |rest: &[&str]| {
        let command = ["render", &scene("furnace"), "--turntable", "4", "--samples", "0..2"];
        shell.run(&[&command[..], &SIZE[..], rest].concat())
    };
    assert!(turn(&["-o", "all-#.nf"]).status.success());
    let some = turn(&["-o", "some-#.nf", "--frames", "2..4"]);
    assert!(some.status.success(), "{}", text(&some.stderr));
    assert!(!shell.path("some-1.nf").exists() && !shell.path("some-4.nf").exists());
    for frame in ["2", "3"] {
        for kind in ["all", "some"] {
            assert!(merge(&shell, &[&format!("{kind}-{frame}.nf"), "-o", &format!("{kind}-{frame}.exr")]).status.success());
        }
        assert!(bytes(&shell, &format!("all-{frame}.exr")) == bytes(&shell, &format!("some-{frame}.exr")));
    }
    let said = refusal(&shell, &["all-1.nf", "all-2.nf", "-o", "out.exr"]);
    assert!(said.contains("all-2.nf cannot be joined with all-1.nf: it has another camera"), "{said}");
    let beyond = turn(&["-o", "some-#.nf", "--frames", "4..6"]);
    assert!(beyond.status.code() == Some(1) && text(&beyond.stderr).contains("the sequence has the frames 1 to 4"));
}
