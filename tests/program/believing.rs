//! Claims of a file about itself are checked.
use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

use noisefall_render::{
    render::split::{SampleFile, SampleFileError, write},
    render_file::Header,
};

use crate::command_line::{Shell, scene, text};

/// A file with samples, whose header `change` has changed.
fn forged(shell: &Shell, name: &str, change: impl Fn(&mut Header)) {
    let path = shell.path("true.nf");
    if !path.exists() {
        let samples = ["--samples", "0..4", "-o", "true.nf", "--size", "40x30"];
        let done = shell.run(&[&["render", &scene("furnace")], &samples[..]].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let file = SampleFile::open(&path).expect("it is whole");
    let (mut header, mut tiles) = (file.header().clone(), Vec::new());
    file.read(|_, sums| {
        tiles.push(sums);
        Ok::<(), SampleFileError>(())
    })
    .expect("it is whole");
    change(&mut header);
    write(&shell.path(name), &header, tiles.iter()).expect("it is written");
}

#[test]
fn a_header_that_claims_other_samples_than_its_file_holds_is_refused() {
    let shell = Shell::new();
    for (samples, adaptive) in [
        (vec![[0, u32::MAX]], false),
        (vec![[0, u32::MAX]], true),
        (vec![[0, 8_388_608]], true),
        // Blocks can have a quarter of the average, and 16 times as much.
        (vec![[0, 20]], true),
        (vec![[0, 5]], false),
        (vec![[1, 4]], false),
        (vec![[0, 2], [7, 8]], false),
    ] {
        forged(&shell, "forged.nf", |header| {
            header.samples.clone_from(&samples);
            header.settings.adaptive = adaptive;
        });
        for output in ["out.exr", "out.nf"] {
            let done = shell.run(&["merge", "forged.nf", "-o", output]);
            let said = text(&done.stderr);
            assert!(done.status.code() == Some(1) && said.contains("forged.nf: the file cannot be used"), "{samples:?}: {said}");
            assert!(!shell.path(output).exists());
        }
    }
    forged(&shell, "other.nf", |header| header.samples = vec![[4, 8]]);
    let done = shell.run(&["merge", "true.nf", "other.nf", "-o", "out.exr"]);
    assert!(done.status.success(), "as many samples as it holds: {}", text(&done.stderr));
}

/// Fails if an output could act on a terminal.
fn assert_harmless(what: &str, output: &Output) {
    for stream in [&output.stdout, &output.stderr] {
        let said = text(stream);
        let acting = said.chars().find(|c| c.is_control() && *c != '\n' || *c == '\u{202e}');
        assert!(acting.is_none(), "{what}: {acting:?} in {said}");
    }
}

#[test]
fn escape_sequences_in_files_do_not_reach_the_terminal() {
    const EVIL: &str = "\u{1b}]0;title\u{7}\u{1b}[31m\u{9b}31m\u{202e}\r";
    let shell = Shell::new();
    type Change = fn(&mut Header);
    let changes: [(&str, Change); 6] = [
        ("program", |header| header.program += EVIL),
        ("name", |header| {
            header.scene.name += EVIL;
            header.counters.first_invalid = Some([1, 2, 3]);
        }),
        ("text", |header| header.scene.text += EVIL),
        ("title", |header| header.image.iter_mut().for_each(|image| image.title += EVIL)),
        ("remarks", |header| header.remarks.push(EVIL.to_owned())),
        ("probe", |header| header.probe.push((0, EVIL.to_owned()))),
    ];
    for (what, change) in changes {
        forged(&shell, "evil.nf", change);
        for command in [
            &["merge", "true.nf", "evil.nf", "-o", "out.exr"][..],
            &["merge", "evil.nf", "-o", "out.exr"],
            &["merge", "evil.nf", "-o", "out.png", "--json"],
            &["render", "--resume", "evil.nf", "-o", "out.exr"],
        ] {
            assert_harmless(what, &shell.run(command));
        }
    }
    let evil =
        "format = 1\ntitle = \"\\u001b]0;title\\u0007\\u009b31m\"\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\n";
    fs::write(shell.path("evil.toml"), evil).expect("it is written");
    fs::write(shell.path(&format!("{EVIL}.toml")), "format = 1\n\u{1b}[31m").expect("it is written");
    for command in [
        &["render", "evil.toml", "-o", "out.png", "--spp", "1", "--size", "8x8"][..],
        &["check", "evil.toml", &format!("{EVIL}.toml")],
        &["render", &format!("{EVIL}.toml"), "-o", &format!("{EVIL}.jpg")],
        &["convert", "evil.toml", "-o", &format!("{EVIL}.gltf")],
    ] {
        assert_harmless("title", &shell.run(command));
    }
}

#[test]
fn names_of_two_hundred_emoji_are_no_longer_than_a_file_system_allows() {
    let shell = Shell::new();
    let long = "🙂".repeat(200);
    let obj = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {long}\nf 1 2 3\nusemtl {long}b\nf 1 3 2\n");
    let glb = gltf(&long);
    for (name, text) in [("a.obj", obj.as_str()), ("a.gltf", &glb)] {
        fs::write(shell.path(name), text).expect("it is written");
        for out in ["toml", "xml", "gltf"] {
            let done = shell.run(&["convert", name, "-o", &format!("out.{out}")]);
            assert!(done.status.success(), "{name} as {out}: {}", text_of(&done));
        }
    }
    // The longest name that a file can have is also written, by way of a temporary file.
    let longest = format!("{}.png", "🙂".repeat(62));
    let done = shell.run(&["render", &scene("furnace"), "-o", &longest, "--spp", "1", "--size", "8x8"]);
    assert!(done.status.success() && shell.path(&longest).is_file(), "{}", text_of(&done));
}

fn text_of(output: &Output) -> String {
    text(&output.stderr)
}

/// A triangle with such a name, and an image with it.
fn gltf(name: &str) -> String {
    let png = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";
    let buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"name":"{name}"}}],
"meshes":[{{"name":"{name}","primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
"materials":[{{"name":"{name}","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],
"images":[{{"name":"{name}","uri":"data:image/png;base64,{png}"}}],
"accessors":[{{"componentType":5126,"count":3,"type":"VEC3","bufferView":0}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{buffer}"}}]}}"#
    )
}

#[test]
#[cfg(unix)]
fn an_image_that_is_saved_elsewhere_is_a_new_file() {
    use std::os::unix::fs::symlink;
    let shell = Shell::new();
    let (home, temporary) = (shell.path("home"), shell.path("temporary"));
    [&home, &temporary].iter().for_each(|folder| fs::create_dir(folder).expect("a folder"));
    // Names that could be foreseen lead to the user's files.
    let program = env!("CARGO_BIN_EXE_noisefall");
    let script = format!(
        "for i in 0 1 2; do ln -s '{}'/mine noisefall-$$-$i-picture.png; done; exec '{program}' render '{}' -o - --format png --spp 1 \
         --size 8x8 > /dev/full",
        home.display(),
        scene("furnace")
    );
    symlink(home.join("mine"), temporary.join("noisefall-picture.png")).expect("a link");
    let done = Command::new("sh").args(["-c", &script]).current_dir(&temporary).env("TMPDIR", &temporary).output();
    let said = text(&done.expect("a shell").stderr);
    let saved = said.split("the image was saved as ").nth(1).and_then(|rest| rest.split(" instead").next());
    let saved = Path::new(saved.unwrap_or_else(|| panic!("{said}")));
    assert!(saved.starts_with(&temporary) && saved.symlink_metadata().expect("it is there").is_file(), "{said}");
    assert_eq!(fs::read_dir(&home).expect("it is there").count(), 0);
}
