//! `render --checkpoint` and `--resume`.
use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use noisefall_render::render::{checkpoint::CheckpointFile, image_file::SETTINGS_KEY};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use crate::command_line::{Shell, json, scene, text};

const SIZE: [&str; 2] = ["--size", "60x40"];

/// Runs a command that must succeed, and returns what it printed on standard error.
fn done(shell: &Shell, words: &[&str]) -> String {
    let output = shell.run(words);
    assert!(output.status.success(), "{words:?}: {}", text(&output.stderr));
    text(&output.stderr)
}

/// Runs a command that must fail, and returns what it printed on standard error.
fn refused(shell: &Shell, words: &[&str]) -> String {
    let output = shell.run(words);
    assert!(matches!(output.status.code(), Some(1 | 2)), "{words:?}: {:?}", output.status);
    text(&output.stderr)
}

fn bytes(shell: &Shell, name: &str) -> Vec<u8> {
    fs::read(shell.path(name)).expect("it is there")
}

/// Begins a render of a few samples, which is kept in `a.nf`.
fn begin(shell: &Shell, scene: &str, options: &[&str]) {
    done(shell, &[&["render", scene, "-o", "a.exr", "--checkpoint", "a.nf", "--spp", "5"], &SIZE[..], options].concat());
}

#[test]
fn a_render_that_is_continued_has_the_file_of_one_in_one_go() {
    let shell = Shell::new();
    let plates = scene("veach_plates");
    begin(&shell, &plates, &["--adaptive", "on", "--seed", "4"]);
    assert_eq!(done(&shell, &["render", "--resume", "a.nf", "-o", "same.exr"]), "");
    assert!(bytes(&shell, "same.exr") == bytes(&shell, "a.exr"), "its target is reached");
    // The scene is inside, and settings that are the same are not refused.
    done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr", "--spp", "33", "--seed", "4"]);
    let options = ["--spp", "70", "--denoise", "--layers", "bounces"];
    done(&shell, &[&["render", "--resume", "a.nf", "-o", "b.exr"], &options[..]].concat());
    let at_once = [&["render", &plates, "-o", "c.exr", "--adaptive", "on", "--seed", "4"], &SIZE[..], &options].concat();
    done(&shell, &at_once);
    assert!(bytes(&shell, "b.exr") == bytes(&shell, "c.exr"));
}

#[test]
fn a_render_with_paths_from_lights_that_is_continued_has_the_file_of_one_in_one_go() {
    let shell = Shell::new();
    let caustic = scene("glass_ball_caustic");
    begin(&shell, &caustic, &["--estimator", "bidirectional"]);
    done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr", "--spp", "21"]);
    done(&shell, &[&["render", &caustic, "-o", "c.exr", "--spp", "21", "--estimator", "bidirectional"], &SIZE[..]].concat());
    assert!(bytes(&shell, "b.exr") == bytes(&shell, "c.exr"));
}

#[test]
fn options_that_would_change_the_image_or_lose_a_render_are_refused_by_name() {
    let shell = Shell::new();
    let spheres = scene("cornell_spheres");
    begin(&shell, &spheres, &[]);
    let before = bytes(&shell, "a.nf");
    let resume = |rest: &[&str]| refused(&shell, &[&["render", "--resume", "a.nf", "-o", "b.exr"], rest].concat());
    for (options, expected) in [
        (
            &["--sampler", "stratified"][..],
            "`--sampler stratified` would change the image, which was started with `--sampler sobol`",
        ),
        (&["--seed", "3", "--adaptive", "on"], "`--adaptive on --seed 3` would change"),
        (&["--size", "8x8"], "`--size 8x8` would change the image, which was started with `--size 60x40`"),
        (&["-D", "a=1"], "the file has its scene with its options"),
        (&[&spheres], "give either a scene or --resume FILE"),
        (&["--checkpoint", "a.txt"], "must end in .nf"),
    ] {
        let told = resume(options);
        assert!(told.contains(expected), "{told}");
    }
    for (words, expected) in [
        (&["render", &spheres, "-o", "b.exr", "--checkpoint", "a.nf"][..], "there is a render already"),
        (&["render", &spheres, "-o", "b.exr", "--checkpoint", "nowhere/a.nf"], "there is no folder"),
        (&["render", &spheres, "-o", "b.exr", "--every", "3"], "--every is the time between checkpoints"),
        (&["render", "--resume", "-o", "b.exr"], "--resume needs the file of a render"),
        (&["render", "a.nf", "-o", "b.exr"], "`render --resume a.nf` continues it"),
        (&["render", "--resume", "a.exr", "-o", "b.exr"], "this is not a render file"),
        (&["render", &spheres, "-o", "b-#.png", "--turntable", "2", "--checkpoint", "b.nf"], "need checkpoints with a number"),
    ] {
        let told = refused(&shell, words);
        assert!(told.contains(expected), "{told}");
    }
    fs::write(shell.path("cut.nf"), &before[..before.len() - 9]).expect("it is written");
    assert!(refused(&shell, &["render", "--resume", "cut.nf", "-o", "b.exr"]).contains("cut.nf: the file is cut off"));
    assert!(!shell.path("b.exr").exists() && bytes(&shell, "a.nf") == before);
}

#[test]
fn a_scene_that_has_changed_is_noticed_and_anyway_is_labelled() {
    let shell = Shell::new();
    let sky = |grey: u8| {
        let picture = image::RgbImage::from_pixel(8, 4, image::Rgb([grey; 3]));
        picture.save(shell.path("sky.png")).expect("it is written");
    };
    sky(200);
    let scene = "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = [16, 16]\n\
                [environment]\nimage = \"sky.png\"\n";
    fs::write(shell.path("sky.toml"), scene).expect("it is written");
    done(&shell, &["render", "sky.toml", "-o", "a.exr", "--checkpoint", "a.nf", "--spp", "2"]);
    // The scene is in the file; only what it names must be there.
    fs::remove_file(shell.path("sky.toml")).expect("it is there");
    done(&shell, &["render", "--resume", "a.nf", "-o", "a.exr", "--spp", "4"]);
    sky(100);
    let resume = ["render", "--resume", "a.nf", "-o", "b.exr", "--spp", "8"];
    let told = refused(&shell, &resume);
    assert!(told.contains("sky.png has ") && told.contains("--anyway"), "{told}");
    let label = "of another scene or program";
    let mixed = shell.run(&[&resume[..], &["--anyway"]].concat());
    assert!(text(&mixed.stderr).contains(label));
    assert!(text(&mixed.stdout).contains("biased: first samples of another scene or program"), "{}", text(&mixed.stdout));
    let meta = exr::meta::MetaData::read_from_file(shell.path("b.exr"), false).expect("it has a header");
    let settings = &meta.headers[0].own_attributes.other[&exr::meta::attribute::Text::from(SETTINGS_KEY)];
    let exr::meta::attribute::AttributeValue::Text(settings) = settings else { panic!("no text") };
    assert!(settings.to_string().contains("\"continued\":") && settings.to_string().contains("sky.png has "));
    // It stays labelled.
    assert!(done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr", "--spp", "9"]).contains(label));
}

#[test]
fn a_scene_of_another_program_with_its_meshes_is_read_again() {
    let shell = Shell::new();
    done(&shell, &["convert", &scene("cornell_box"), "-o", "box.glb"]);
    begin(&shell, "box.glb", &["--reuse", "suffixes"]);
    done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr", "--spp", "20"]);
    done(&shell, &[&["render", "box.glb", "-o", "c.exr", "--spp", "20", "--reuse", "suffixes"], &SIZE[..]].concat());
    assert!(bytes(&shell, "b.exr") == bytes(&shell, "c.exr"));
    fs::remove_file(shell.path("box.glb")).expect("it is there");
    assert!(refused(&shell, &["render", "--resume", "a.nf", "-o", "b.exr"]).contains("box.glb is missing"));
}

#[test]
fn a_file_that_a_scene_of_another_program_includes_counts_too() {
    let shell = Shell::new();
    let light = |radiance: &str| {
        let light = format!(
            "<scene version=\"3.0.0\"><emitter type=\"constant\"><rgb name=\"radiance\" value=\"{radiance}\"/></emitter></scene>"
        );
        fs::write(shell.path("light.xml"), light).expect("it is written");
    };
    light("1");
    let room = "<scene version=\"3.0.0\"><shape type=\"sphere\"/><include filename=\"light.xml\"/></scene>";
    fs::write(shell.path("room.xml"), room).expect("it is written");
    begin(&shell, &shell.path("room.xml").display().to_string(), &[]);
    done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr"]);
    light("2");
    let message = refused(&shell, &["render", "--resume", "a.nf", "-o", "b.exr"]);
    assert!(message.contains("light.xml has other contents"), "{message}");
}

#[test]
fn a_buffer_of_a_gltf_counts_too() {
    let shell = Shell::new();
    done(&shell, &["convert", &scene("cornell_box"), "-o", "box.gltf"]);
    begin(&shell, "box.gltf", &[]);
    done(&shell, &["render", "--resume", "a.nf", "-o", "b.exr"]);
    let mut buffer = bytes(&shell, "box.files/meshes/box.bin");
    *buffer.last_mut().expect("it has bytes") ^= 1;
    fs::write(shell.path("box.files/meshes/box.bin"), buffer).expect("it is written");
    let message = refused(&shell, &["render", "--resume", "a.nf", "-o", "b.exr"]);
    assert!(message.contains("box.bin has other contents"), "{message}");
}

#[test]
#[cfg(unix)]
fn a_disk_without_room_fails_the_checkpoint_and_neither_the_render_nor_the_checkpoint_before() {
    let shell = Shell::new();
    begin(&shell, &scene("cornell_spheres"), &[]);
    let before = bytes(&shell, "a.nf");
    // The image is a small PNG; the checkpoint is larger than any file may be.
    let limited = "trap '' XFSZ; ulimit -f 60; exec \"$0\" \"$@\"";
    let mut command = Command::new("sh");
    command.args(["-c", limited, env!("CARGO_BIN_EXE_noisefall"), "render", "--resume", "a.nf", "-o", "b.png", "--spp", "9"]);
    let output = command.current_dir(shell.folder()).output().expect("it starts");
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("no checkpoint was written") && told.contains("the render is not kept"), "{told}");
    assert!(text(&output.stdout).contains("9 spp") && shell.path("b.png").exists());
    assert!(bytes(&shell, "a.nf") == before);
    let parts = fs::read_dir(shell.folder()).expect("it is there").flatten();
    assert!(!parts.into_iter().any(|entry| entry.file_name().to_string_lossy().contains(".part")));
}

/// How often the program is killed: `NOISEFALL_KILLS`.
fn kills() -> u32 {
    std::env::var("NOISEFALL_KILLS").map_or(6, |text| text.parse().expect("a number"))
}

#[test]
fn a_program_that_is_killed_at_any_moment_leaves_a_whole_checkpoint() {
    let shell = Shell::new();
    let plates = scene("veach_plates");
    let mut random = SmallRng::seed_from_u64(3);
    let (mut whole, mut none) = (0, 0);
    for _ in 0..kills() {
        let kept = shell.path("a.nf").exists();
        let endless = ["-o", "a.png", "--every", "0.001", "--spp", "100000000"];
        let first = ["render", &plates, "--checkpoint", "a.nf", "--size", "200x150"];
        let again = ["render", "--resume", "a.nf"];
        let words = if kept { [&again[..], &endless].concat() } else { [&first[..], &endless].concat() };
        let mut child = shell.command(&words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
        sleep(Duration::from_millis(random.random_range(200..1500)));
        child.kill().expect("it runs");
        let output = child.wait_with_output().expect("it ends");
        assert!(output.status.code().is_none(), "it ended by itself: {}", text(&output.stderr));
        match shell.path("a.nf").exists() {
            true => {
                let file = CheckpointFile::open(&shell.path("a.nf")).expect("it is whole");
                file.read().expect("it is whole");
                whole += 1;
            }
            false => none += 1,
        }
    }
    println!("{whole} whole checkpoints, {none} kills before the first one");
    assert!(whole > 0);
    let resumed = shell.run(&["render", "--resume", "a.nf", "-o", "a.exr", "--spp", "1", "--json"]);
    let spp = json(&resumed)["spp"].to_string();
    done(&shell, &["render", &plates, "-o", "b.exr", "--size", "200x150", "--spp", &spp]);
    assert!(bytes(&shell, "a.exr") == bytes(&shell, "b.exr"), "after all, {spp} samples differ");
    let names = fs::read_dir(shell.folder()).expect("it is there").flatten().map(|entry| entry.file_name());
    assert!(!names.into_iter().any(|name| Path::new(&name).extension().is_some_and(|end| end == "part")), "a leftover");
}
