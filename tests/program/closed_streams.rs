//! Closed standard output and standard error: every command ends quietly, with the exit status of its work.
#![cfg(unix)]
use std::{
    fs,
    io::{Read, pipe},
    process::Stdio,
};

use crate::command_line::{Shell, scene, text};

/// A pipe without a reader.
fn unread() -> Stdio {
    let (reader, writer) = pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

/// Commands, their messages on standard error, and their exit status.
fn commands() -> Vec<(Vec<String>, i32)> {
    let furnace = scene("furnace");
    let commands: [(&[&str], i32); 15] = [
        (&["render", "nowhere.toml", "-o", "out.png"], 1),
        (&["render", &furnace, "-o", "nowhere/out.png"], 1),
        (&["render", &furnace, "-o", "-"], 2),
        (&["render", &furnace], 2),
        (&["rendr", &furnace], 2),
        (&["compare", "a.exr", "b.exr"], 1),
        (&["check", "nowhere.toml"], 1),
        (&["check", &furnace], 0),
        (&["validate", "--references", "nowhere"], 1),
        (&["study", "nowhere.toml", "-o", "out"], 1),
        (&["study", &furnace, &furnace, "-o", "out", "--reference", "a.exr"], 2),
        (&["render", &furnace, "-o", "black.png", "--spp", "1", "--size", "8x8", "--max-bounces", "0"], 0),
        (&["sheet", &furnace, "-o", "sheet.png", "--spp", "1", "--size", "8x8"], 0),
        (&["render", &furnace, "--pixel", "1,1", "--size", "8x8"], 0),
        (&["--help"], 0),
    ];
    commands.into_iter().map(|(words, code)| (words.iter().map(ToString::to_string).collect(), code)).collect()
}

#[test]
fn commands_whose_readers_are_gone_end_with_the_status_of_their_work() {
    let shell = Shell::new();
    for (words, code) in commands() {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let both = shell.command(&words).stdout(unread()).stderr(unread()).status().expect("it starts");
        assert_eq!(both.code(), Some(code), "{words:?}");
        let quiet = shell.command(&words).stdout(unread()).output().expect("it starts");
        assert_eq!(quiet.status.code(), Some(code), "{words:?}");
        assert!(code != 0 || text(&quiet.stderr).is_empty(), "{words:?}: {}", text(&quiet.stderr));
    }
    assert!(["black.png", "sheet.png"].iter().all(|name| shell.path(name).is_file()));
}

#[test]
fn commands_without_standard_streams_end_with_the_status_of_their_work() {
    let shell = Shell::new();
    for (words, code) in commands() {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let program = env!("CARGO_BIN_EXE_noisefall");
        let mut closed = std::process::Command::new("sh");
        closed.args(["-c", "exec \"$0\" \"$@\" >&- 2>&-", program]).args(&words).current_dir(shell.path(""));
        assert_eq!(closed.status().expect("it starts").code(), Some(code), "{words:?}");
    }
}

#[test]
fn a_study_whose_reader_has_gone_still_writes_its_report() {
    let shell = Shell::new();
    let few = ["--estimators", "mis", "--directions", "bsdf", "--samplers", "sobol", "--roulette", "off", "--spp", "2"];
    let sky = scene("bright_sky");
    let study = [&["study", &sky, "-o", "out", "--size", "8x8"], &few[..]].concat();
    let status = shell.command(&study).stdout(unread()).stderr(unread()).status().expect("it starts");
    assert_eq!(status.code(), Some(0));
    assert!(shell.path("out/report.html").is_file() && shell.path("out/study.csv").is_file());
}

#[test]
fn a_picture_without_a_reader_fails_silently() {
    let shell = Shell::new();
    for format in ["png", "exr"] {
        let words = ["render", &scene("furnace"), "-o", "-", "--format", format, "--spp", "1", "--size", "8x8"];
        let output = shell.command(&words).stdout(unread()).output().expect("it starts");
        assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(1), ""));
    }
    let closed = "exec \"$0\" render \"$1\" -o - --format png --spp 1 --size 8x8 >&-";
    let mut command = std::process::Command::new("sh");
    command.args(["-c", closed, env!("CARGO_BIN_EXE_noisefall"), &scene("furnace")]);
    let output = command.current_dir(shell.path("")).output().expect("it starts");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(text(&output.stderr), "standard output is closed: the image would be lost\n");
}

#[test]
#[cfg(target_os = "linux")]
fn a_failed_write_to_standard_output_is_reported_and_the_picture_is_kept() {
    let shell = Shell::new();
    let full = || fs::File::options().write(true).open("/dev/full").expect("a full device");
    let check = shell.command(&["check", &scene("furnace")]).stdout(full()).output().expect("it starts");
    assert_eq!(check.status.code(), Some(1));
    assert!(text(&check.stderr).starts_with("standard output: "), "{}", text(&check.stderr));
    let words = ["render", &scene("furnace"), "-o", "-", "--format", "exr", "--spp", "1", "--size", "8x8"];
    let mut render = shell.command(&words);
    let output = render.stdout(full()).env("TMPDIR", shell.path("")).output().expect("it starts");
    assert_eq!(output.status.code(), Some(1));
    let kept: Vec<_> = fs::read_dir(shell.path("")).expect("it is there").flatten().map(|entry| entry.path()).collect();
    let told = text(&output.stderr);
    assert!(kept.len() == 1 && told.contains(&format!("the image was saved as {} instead", kept[0].display())), "{told}");
    let picture = noisefall_render::render::image_file::read(&kept[0]).expect("an image");
    assert_eq!((picture.width, picture.height), (8, 8));
    // Empty output is valid too.
    let null = fs::File::options().write(true).open("/dev/null").expect("it is there");
    assert!(shell.command(&words).stdout(null).status().expect("it starts").success());
}

#[test]
#[cfg(target_os = "linux")]
fn a_picture_is_not_written_to_a_terminal() {
    let shell = Shell::new();
    let terminal = fs::File::options().read(true).write(true).open("/dev/ptmx").expect("a terminal");
    let words = ["render", &scene("furnace"), "-o", "-", "--format", "png", "--spp", "1", "--size", "8x8"];
    let mut child = shell.command(&words).stdout(terminal).stderr(Stdio::piped()).spawn().expect("it starts");
    assert_eq!(child.wait().expect("it ends").code(), Some(1));
    let mut told = String::new();
    child.stderr.take().expect("a pipe").read_to_string(&mut told).expect("text");
    assert!(told.starts_with("standard output is a terminal"), "{told}");
}
