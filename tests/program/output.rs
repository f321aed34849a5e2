//! The destination of output: standard output on request, otherwise regular files. Nothing else is ever replaced.
use std::fs;

use crate::command_line::{Shell, json, scene, text};

const SMALL: [&str; 4] = ["--spp", "2", "--size", "8x8"];

#[test]
fn a_picture_on_standard_output_has_the_bytes_of_its_file_and_all_else_is_on_standard_error() {
    let shell = Shell::new();
    for format in ["png", "exr"] {
        let (furnace, file) = (scene("furnace"), format!("out.{format}"));
        let render = |rest: &[&str]| shell.run(&[&["render", &furnace], &SMALL[..], rest].concat());
        let to_file = render(&["-o", &file, "--format", format]);
        assert!(text(&to_file.stdout).starts_with(&format!("{file}: 2 spp in ")), "{}", text(&to_file.stdout));
        assert_eq!(text(&to_file.stderr), "");
        let bytes = fs::read(shell.path(&file)).expect("it is there");
        let streamed = render(&["-o", "-", "--format", format]);
        assert!(streamed.status.success() && streamed.stdout == bytes, "{}", text(&streamed.stderr));
        assert!(text(&streamed.stderr).starts_with("standard output: 2 spp in "), "{}", text(&streamed.stderr));
        let with_json = render(&["-o", "-", "--format", format, "--json"]);
        assert!(with_json.stdout == bytes);
        let line: serde_json::Value = serde_json::from_str(&text(&with_json.stderr)).expect("a line of JSON");
        assert_eq!((&line["spp"], &line["stopped_by"]), (&2.into(), &"samples".into()));
    }
}

#[test]
fn a_format_and_a_name_that_disagree_are_wrong_usage() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    for (rest, message) in [
        (&["-o", "-"][..], "-o - needs --format png or --format exr"),
        (&["-o", "out.png", "--format", "exr"], "out.png: the name ends in .png, but --format says exr"),
        (&["-o", "-", "--format", "jpg"], "expected png or exr"),
        (&["--pixel", "1,1", "--format", "png"], "cannot be used with"),
        (&["--format", "png"], "--output"),
        (&["-o", "out.png", "--sample", "5"], "cannot be used with"),
        (&["--sample", "5"], "--pixel"),
    ] {
        let output = shell.run(&[&["render", &furnace], rest].concat());
        assert_eq!(output.status.code(), Some(2), "{rest:?}");
        assert!(text(&output.stderr).contains(message), "{rest:?}: {}", text(&output.stderr));
    }
    let no_name = shell.run(&["render", &furnace, "-o", "out", "--format", "png"]);
    assert!(no_name.status.code() == Some(2) && text(&no_name.stderr).contains("must end in .png"));
    assert_eq!(fs::read_dir(shell.path("")).expect("it is there").count(), 0);
}

#[test]
fn a_name_that_says_no_known_format_is_wrong_usage_in_every_command() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    assert!(shell.run(&[&["render", &furnace, "-o", "a.exr"], &SMALL[..]].concat()).status.success());
    for (command, advice) in [
        (vec!["render", &furnace, "-o", "room.jpg"], "such as room.png"),
        (vec!["render", &furnace, "-o", "room"], "such as room.png"),
        (vec!["render", &furnace, "-o", "room-#.tif", "--turntable", "2"], "such as room-#.png"),
        (vec!["render", &furnace, "-o", "room.jpeg", "--samples", "0..2"], "such as room.png"),
        (vec!["merge", "a.nf", "-o", "room.jpg"], "such as room.png; or in .nf"),
        (vec!["compare", "a.exr", "a.exr", "-o", "room.jpg"], "such as room.png"),
        (vec!["compare", "a.exr", "a.exr", "-o", "room.nf"], ".png or .exr"),
        (vec!["sheet", &furnace, "-o", "room.jpg"], ".png"),
        (vec!["bench", &furnace, "-o", "room.jpg"], ".svg"),
        (vec!["convert", &furnace, "-o", "room.blend"], ".toml, .xml, .gltf or .glb"),
    ] {
        let done = shell.run(&command);
        let said = text(&done.stderr);
        assert!(done.status.code() == Some(2) && said.contains(advice), "{command:?}: {said}");
    }
    assert_eq!(fs::read_dir(shell.path("")).expect("it is there").count(), 1, "only the first image");
}

/// A hard link to a file. Its content stays if the file is replaced, and changes if the file is overwritten.
fn second_name(shell: &Shell, name: &str) {
    fs::write(shell.path(name), "old").expect("it is written");
    fs::hard_link(shell.path(name), shell.path(&format!("{name}.old"))).expect("a second name");
}

#[test]
fn every_writer_replaces_files_whole() {
    let shell = Shell::new();
    fs::create_dir(shell.path("study")).expect("a folder");
    fs::create_dir(shell.path("validation")).expect("a folder");
    let names =
        ["out.png", "out.exr", "difference.png", "sheet.png", "samples.csv", "study/report.html", "validation/report.html"];
    names.iter().for_each(|name| second_name(&shell, name));
    // A temporary file of a killed process.
    let leftover = |name: &str| {
        let (folder, file) = name.rsplit_once('/').unwrap_or((".", name));
        shell.path(folder).join(format!(".{file}.noisefall-dead00.part"))
    };
    names.iter().for_each(|name| fs::write(leftover(name), "half a").expect("it is written"));
    let furnace = scene("furnace");
    let few = ["--estimators", "mis", "--directions", "bsdf", "--samplers", "sobol", "--roulette", "off", "--spp", "1"];
    for command in [
        [&["render", &furnace, "-o", "out.png"], &SMALL[..]].concat(),
        [&["render", &furnace, "-o", "out.exr"], &SMALL[..]].concat(),
        vec!["compare", "out.exr", "out.exr", "-o", "difference.png"],
        vec!["sheet", &furnace, "-o", "sheet.png", "--spp", "1", "--size", "8x8"],
        vec!["render", &furnace, "--pixel", "1,1", "--size", "8x8", "--csv", "samples.csv"],
        [&["study", &furnace, "-o", "study", "--size", "8x8"], &few[..]].concat(),
        vec!["validate", "--quick", "--stress", "-o", "validation"],
    ] {
        let output = shell.run(&command);
        assert!(output.status.success(), "{command:?}: {}", text(&output.stderr));
    }
    for name in names {
        assert!(fs::read(shell.path(name)).expect("it is there").len() > 3, "{name} is not written");
        assert_eq!(fs::read(shell.path(&format!("{name}.old"))).expect("it is there"), b"old", "{name}");
        assert!(!leftover(name).exists(), "{name}");
    }
    let csv = shell.path("study/study.csv");
    fs::hard_link(&csv, shell.path("study/old.csv")).expect("a second name");
    let more = [&["study", &furnace, "-o", "study", "--size", "8x8", "--repeats", "3"], &few[..]].concat();
    assert!(shell.run(&more).status.success());
    let [old, new] = [shell.path("study/old.csv"), csv].map(|path| fs::read(path).expect("it is there"));
    assert!(new.starts_with(&old) && new.len() > old.len(), "study.csv is written into");
}

#[test]
#[cfg(unix)]
fn no_writer_replaces_a_special_file_or_waits_for_it() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let shell = Shell::new();
    let furnace = scene("furnace");
    assert!(shell.run(&[&["render", &furnace, "-o", "a.exr"], &SMALL[..]].concat()).status.success());
    for folder in ["report", "csv"] {
        fs::create_dir(shell.path(folder)).expect("a folder");
    }
    let pipes = ["pipe.png", "pipe.exr", "pipe.csv", "report/report.html", "csv/study.csv"];
    for pipe in pipes {
        let made = std::process::Command::new("mkfifo").arg(shell.path(pipe)).status();
        assert!(made.expect("mkfifo starts").success());
    }
    symlink("pipe.png", shell.path("link.png")).expect("a link");
    for (command, what) in [
        (vec!["render", &furnace, "-o", "pipe.png"], "pipe.png: cannot be written: it is a named pipe"),
        (vec!["render", &furnace, "-o", "pipe.exr"], "`-o - --format png` writes the image to standard output"),
        (vec!["render", &furnace, "-o", "link.png"], "link.png: cannot be written: it is a named pipe"),
        (vec!["compare", "a.exr", "a.exr", "-o", "pipe.png"], "pipe.png: cannot be written: it is a named pipe"),
        (vec!["validate", "--quick", "-o", "report"], "report/report.html: cannot be written: it is a named pipe"),
        (vec!["study", &furnace, "-o", "report"], "report/report.html: cannot be written: it is a named pipe"),
        (vec!["study", &furnace, "-o", "csv"], "csv/study.csv: cannot be written: it is a named pipe"),
        (vec!["evidence", &furnace, "-o", "report"], "report/report.html: cannot be written: it is a named pipe"),
        (vec!["evidence", &furnace, "-o", "csv"], "csv/study.csv: cannot be written: it is a named pipe"),
        (vec!["sheet", &furnace, "-o", "pipe.png"], "pipe.png: cannot be written: it is a named pipe"),
        (vec!["render", &furnace, "--pixel", "1,1", "--csv", "pipe.csv"], "pipe.csv: cannot be written: it is a named pipe"),
    ] {
        let output = shell.run(&command);
        assert_eq!(output.status.code(), Some(1), "{command:?}");
        assert!(text(&output.stderr).contains(what), "{command:?}: {}", text(&output.stderr));
    }
    for pipe in pipes {
        assert!(fs::metadata(shell.path(pipe)).expect("it is there").file_type().is_fifo(), "{pipe}");
    }
}

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn names_need_not_be_text() {
    use std::{ffi::OsStr, os::unix::ffi::OsStrExt};
    let shell = Shell::new();
    let name = |bytes: &'static [u8]| OsStr::from_bytes(bytes);
    let (toml, exr, folder) = (name(b"caf\xe9.toml"), name(b"caf\xe9.exr"), name(b"stud\xe9"));
    fs::copy(scene("furnace"), shell.folder().join(toml)).expect("a scene");
    let run = |words: &[&OsStr]| shell.command(&[]).args(words).output().expect("it starts");
    let words = |text: &'static str| text.split(' ').map(OsStr::new).collect::<Vec<_>>();
    let rendered = run(&[&words("render")[..], &[toml, OsStr::new("-o"), exr], &words("--json --spp 1 --size 8x8")].concat());
    assert_eq!(json(&rendered)["scene"], "caf\u{fffd}.toml");
    assert!(shell.folder().join(exr).is_file());
    let small = words("--size 8x8 --spp 1 --estimators mis --directions bsdf --samplers sobol --roulette off");
    for (command, said) in [
        ([&words("compare")[..], &[exr, exr], &words("--json")].concat(), "rmse"),
        ([&words("check")[..], &[toml]].concat(), "ok"),
        ([&words("render")[..], &[toml], &words("--pixel 1,1 --json")].concat(), "vertices"),
        ([&words("study")[..], &[toml, OsStr::new("-o"), folder], &small].concat(), "report: "),
        ([&words("compare")[..], &[exr, exr, OsStr::new("-o"), name(b"diff\xe9.png")]].concat(), "full colour"),
    ] {
        let output = run(&command);
        assert!(output.status.success(), "{command:?}: {}", text(&output.stderr));
        assert!(text(&output.stdout).contains(said), "{command:?}: {}", text(&output.stdout));
    }
}
