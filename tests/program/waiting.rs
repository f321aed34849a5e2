//! Nothing waits for ever, and nothing leaves parts of files behind.
#![cfg(target_os = "linux")]
use std::{
    fs,
    io::Read,
    net::TcpListener,
    process::{Child, Command, Output, Stdio},
    time::{Duration, Instant},
};

use crate::command_line::{Shell, scene, text};

const SIZE: [&str; 2] = ["--size", "40x30"];

fn part(shell: &Shell, samples: &str, output: &str) {
    let done = shell.run(&[&["render", &scene("furnace"), "--samples", samples, "-o", output], &SIZE[..]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
}

/// The output of a process that must end by itself.
fn ended(mut child: Child) -> Output {
    let start = Instant::now();
    while child.try_wait().expect("its state").is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().expect("it is there");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    child.wait_with_output().expect("it has ended")
}

#[test]
fn a_watching_merge_joins_a_file_again_that_a_longer_one_replaces_and_names_files_that_are_none() {
    let shell = Shell::new();
    fs::create_dir(shell.path("parts")).expect("a folder");
    for (samples, name) in [("0..6", "whole.exr"), ("0..2", "parts/a.nf"), ("4..6", "parts/b.nf"), ("0..4", "longer.nf")] {
        part(&shell, samples, name);
    }
    let whole = fs::read(shell.path("longer.nf")).expect("it is there");
    fs::write(shell.path("parts/damaged.nf"), &whole[..whole.len() / 2]).expect("it is written");
    fs::write(shell.path("parts/foreign.nf"), "a text").expect("it is written");
    let mut command = shell.command(&["merge", "parts", "--watch", "0.05", "--until", "6", "-o", "joined.exr"]);
    let mut watching = command.stderr(Stdio::piped()).spawn().expect("the program starts");
    let mut said = String::new();
    let mut from = watching.stderr.take().expect("a pipe");
    let mut wait_for = |what: &str| {
        let mut byte = [0];
        while !said.contains(what) && from.read(&mut byte).expect("text") > 0 {
            said.push(char::from(byte[0]));
        }
    };
    wait_for("missing: 2..4\n");
    wait_for("damaged.nf: the file is cut off");
    wait_for("foreign.nf: this is not a render file");
    fs::rename(shell.path("longer.nf"), shell.path("parts/a.nf")).expect("it is moved");
    wait_for("samples 0..6, complete\n");
    assert!(ended(watching).status.success(), "{said}");
    assert!(said.contains("a.nf: was replaced; all files are joined again"), "{said}");
    assert_eq!(said.matches("damaged.nf").count(), 1, "it is told once: {said}");
    assert!(fs::read(shell.path("joined.exr")).expect("it is there") == fs::read(shell.path("whole.exr")).expect("it is there"));
}

#[test]
fn a_finished_render_does_not_wait_for_a_slow_server() {
    let shell = Shell::new();
    // It accepts connections, and takes what fits into the buffers of the system.
    let server = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
    let address = server.local_addr().expect("it has an address").to_string();
    let large = ["--size", "2000x1500", "--spp", "1", "--json"];
    let mut command = shell.command(&[&["render", &scene("furnace"), "-o", "out.exr", "--tev", &address], &large[..]].concat());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let mut line = [0];
    child.stdout.as_mut().expect("a pipe").read_exact(&mut line).expect("the summary");
    let interrupted = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(interrupted.is_ok_and(|status| status.success()));
    let start = Instant::now();
    let done = ended(child);
    let said = text(&done.stderr);
    assert!(start.elapsed() < Duration::from_secs(4) && done.status.success(), "{:?}: {said}", start.elapsed());
    assert!(said.contains("interrupted: closing the connection to tev") || said.contains("was lost"), "{said}");
    assert!(shell.path("out.exr").is_file());
}

#[test]
fn a_limit_on_the_size_of_files_is_an_error_that_leaves_no_part() {
    let shell = Shell::new();
    part(&shell, "0..2", "a.nf");
    fs::write(shell.path("small.png"), "old").expect("it is written");
    let program = env!("CARGO_BIN_EXE_noisefall");
    let furnace = scene("furnace");
    let large = "--size 200x150 --spp 1";
    for (command, output) in [
        (format!("render {furnace} -o out.exr {large}"), "out.exr"),
        (format!("render {furnace} -o - --format exr {large} > stream.exr"), "standard output"),
        (format!("render {furnace} -o small.nf --samples 0..2 --size 200x150"), "small.nf"),
        ("merge a.nf -o joined.exr".to_owned(), "joined.exr"),
    ] {
        let script = format!("ulimit -f 8; '{program}' {command}");
        let temporary = shell.path("temporary");
        fs::create_dir_all(&temporary).expect("a folder");
        let done = Command::new("sh").args(["-c", &script]).current_dir(shell.folder()).env("TMPDIR", &temporary).output();
        let done = done.expect("a shell");
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{command}: {said}");
        assert!(said.contains(output) && said.contains("File too large"), "{command}: {said}");
        assert_eq!(fs::read_dir(&temporary).expect("it is there").count(), 0, "{command}");
    }
    let mut left: Vec<_> = fs::read_dir(shell.folder()).expect("it is there").flatten().map(|entry| entry.file_name()).collect();
    left.sort();
    assert_eq!(left, ["a.nf", "small.png", "stream.exr", "temporary"]);
}
