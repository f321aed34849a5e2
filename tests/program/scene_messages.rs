//! What is said of files that are no scenes: in plain words, at the place, and no more than can be read.
use std::{fs, path::Path};

use noisefall::scene::{load, parse};

use super::scene_files::{GOOD, error, refuses};

#[test]
fn wrong_values_are_told_in_plain_words() {
    refuses("max_bounces = 5", "max_bounces = \"none\"", "leave it out for no cap");
    refuses("[[objects]]", "[objects]", "write `[[objects]]`");
    refuses(
        "{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }",
        "{ sphere = 3 }",
        "`sphere`: expected a table { … }, found 3",
    );
    refuses("{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }", "\"sphere\"", "write { sphere = … }");
    refuses("{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }", "{}", "says exactly one kind");
    refuses("\"stratified\"", "3", "expected a name in quotes");
    assert!(!error(&GOOD.replace("look_at = [0, 1, 0]", "look_at = [[0], 1, 0]")).report().contains("help"));
    refuses("seed = 9", "seed = 2024-01-01", "found a date");
    refuses("name = \"ball\"", "name = 3", "`name`: expected text in quotes, found 3");
    refuses("name = \"ball\"", "flip = 1", "`flip`: expected true or false, found 1");
    refuses("fov = 40", "fov = ", "a value is missing");
    refuses("{ fixed = 0.75 }", "\"fixed\"", "write { fixed = … }");
    refuses("{ fixed = 0.75 }", "{ fixed = 0.5, throughput = {} }", "a second kind of roulette, `throughput`");
    refuses("{ fixed = 0.75 }", "{ throughput = { begin = 4 } }", "unknown key `begin`");
    for jargon in ["f64", "u32", "i64", "map", "struct", "variant", "sequence"] {
        for (line, by) in
            [("fov = 40", "fov = []"), ("seed = 9", "seed = {}"), ("format = 1", "format = 1.0"), ("eye = [", "eye = [[],")]
        {
            let report = error(&GOOD.replacen(line, by, 1)).report();
            assert!(!report.contains(jargon), "{report}");
        }
    }
}

#[test]
fn what_was_probably_meant_is_named() {
    refuses("look_at = [0, 1, 0]", "lookat = [0, 1, 0]", "did you mean `look_at`?");
    refuses("[render]", "[rendr]", "did you mean `render`?");
    refuses("\"stratified\"", "\"stratifed\"", "did you mean `stratified`?");
    refuses("material = \"white\"", "material = \"whit\"", "did you mean `white`?");
}

#[test]
fn what_is_not_toml_is_refused_at_its_place() {
    refuses("fov = 40", "fov = = 40", "");
    refuses("format = 1", "format = 1\nformat = 1", "duplicate key `format`");
    for nothing in ["", "\n\n", "# only a remark\n"] {
        assert!(error(nothing).report().contains("the file is empty") && error(nothing).report().contains("`format = 1`"));
    }
}

#[test]
fn files_that_are_no_scenes_are_refused_in_one_message() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    let report = |path: &Path| load(path).err().expect("it is no scene").report();

    assert!(report(&file("nowhere.toml")).contains("there is no such file"));
    assert!(report(folder.path()).contains("not a regular file but a folder"));

    fs::write(file("latin1.toml"), b"format = 1\ntitle = \"caf\xe9\"\n").expect("it is written");
    let not_utf8 = report(&file("latin1.toml"));
    assert!(not_utf8.contains("not UTF-8") && not_utf8.contains("latin1.toml:2:13"), "{not_utf8}");

    fs::write(file("picture.toml"), b"\x89PNG\r\n\x1a\n\xff\xfe").expect("it is written");
    let picture = report(&file("picture.toml"));
    assert!(picture.contains("not a text file: it looks like a PNG picture") && !picture.contains('\u{fffd}'));
    fs::write(file("bytes.toml"), b"format = 1\0\x01").expect("it is written");
    assert!(report(&file("bytes.toml")).contains("not a text file"));

    // A file of 200 MB that takes no room.
    fs::File::create(file("huge.toml")).and_then(|huge| huge.set_len(200 << 20)).expect("it is made");
    assert!(report(&file("huge.toml")).contains("larger than 64 MB"));
}

#[test]
fn long_lines_are_cut_around_the_caret() {
    let long = format!("fov = 40 # {}\ntitel = \"{}\"", "y".repeat(5000), "x".repeat(5000));
    let error =
        error(&GOOD.replace("format = 1", &format!("format = 1\n{}albedo = 3", " ".repeat(1000))).replace("fov = 40", &long));
    let report = error.report();
    assert_eq!(error.line_column(), Some((2, 1001)));
    assert!(report.contains("unknown key `albedo`") && report.contains("test.toml:2:1001"), "{report}");
    assert!(report.lines().all(|line| line.chars().count() < 260), "{report}");
    let with_title = GOOD.replace("format = 1", &format!("format = 1\ntitle = \"{}\" 3", "ü".repeat(5000)));
    let report = parse("test.toml", with_title).err().expect("it is no TOML").report();
    assert!(report.lines().all(|line| line.chars().count() < 260), "{report}");
}

#[test]
#[cfg(unix)]
fn a_pipe_is_refused_without_waiting_for_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let pipe = folder.path().join("pipe.toml");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs");
    assert!(made.success());
    assert!(load(&pipe).err().expect("it is no scene").report().contains("not a regular file"));
    let textured = format!("[textures.t]\nimage = {{ path = '{}' }}\n[render]", pipe.display());
    refuses("[render]", &textured, "not a regular file");
}
