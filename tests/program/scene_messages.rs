//! Messages about invalid scene files: plain words, with a position, and of readable length.
use std::{fs, path::Path};

use noisefall_scene::scene::{load, parse};

use super::scene_files::{GOOD, error, refuses};

#[test]
fn messages_about_wrong_values_use_plain_words() {
    refuses("max_bounces = 5", "max_bounces = \"none\"", "leave it out for no cap");
    refuses("[[objects]]", "[objects]", "write `[[objects]]`");
    refuses(
        "{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }",
        "{ sphere = 3 }",
        "`sphere`: expected a table { … }, found 3",
    );
    refuses("{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }", "\"sphere\"", "write { sphere = … }");
    refuses("{ sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }", "{}", "`shape` has none of `sphere`");
    refuses("\"stratified\"", "3", "expected a name in quotes");
    assert!(!error(&GOOD.replace("look_at = [0, 1, 0]", "look_at = [[0], 1, 0]")).report().contains("help"));
    refuses("seed = 9", "seed = 2024-01-01", "found a date");
    refuses("name = \"ball\"", "name = 3", "`name`: expected text in quotes, found 3");
    refuses("name = \"ball\"", "flip = 1", "`flip`: expected true or false, found 1");
    refuses("fov = 40", "fov = ", "a value is missing");
    refuses("{ fixed = 0.75 }", "\"fixed\"", "write { fixed = … }");
    refuses("{ fixed = 0.75 }", "{ fixed = 0.5, throughput = {} }", "`fixed` and `throughput` exclude each other");
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
fn messages_name_the_probable_meaning() {
    refuses("look_at = [0, 1, 0]", "lookat = [0, 1, 0]", "did you mean `look_at`?");
    refuses("[render]", "[rendr]", "did you mean `render`?");
    refuses("\"stratified\"", "\"stratifed\"", "did you mean `stratified`?");
    refuses("material = \"white\"", "material = \"whit\"", "did you mean `white`?");
}

/// A change of `GOOD`, and the message about it.
const MEANT: [(&str, &str, &str); 39] = [
    ("spp = 64", "samples = 64", "did you mean `spp`?"),
    ("max_bounces = 5", "depth = 5", "did you mean `max_bounces`?"),
    ("sampler = \"stratified\"", "integrator = \"mis\"", "did you mean `estimator`?"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "10.0", "write { radiance = 10.0 }"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "[1.0, 2.0, 3.0]", "write { radiance = [1.0, 2.0, 3.0] }"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "{ power = 60.0 }", "did you mean `radiance`?"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "{ power = 60.0 }", "has Φ/(π A)"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "{ intensity = 60.0 }", "did you mean `radiance`?"),
    ("{ radiance = [1.0, 2.0, 3.0] }", "{ color = 60.0 }", "did you mean `radiance`?"),
    ("albedo = 0.8", "albedo = \"tiles\"", "write { texture = \"tiles\" }"),
    ("albedo = 0.8", "color = 0.8", "did you mean `albedo`?"),
    ("lambertian = { albedo = 0.8 }", "lambertian = 0.8", "write { albedo = 0.8 }"),
    ("lambertian = { albedo = 0.8 }", "lambert = { albedo = 0.8 }", "did you mean `lambertian`?"),
    ("lambertian = { albedo = 0.8 }", "diffuse = { albedo = 0.8 }", "did you mean `lambertian`?"),
    ("lambertian = { albedo = 0.8 }", "glass = { ior = 1.5 }", "did you mean `dielectric`?"),
    ("lambertian = { albedo = 0.8 }", "metal = { roughness = 0.3 }", "did you mean `conductor`?"),
    ("lambertian = { albedo = 0.8 }", "dielectric = { eta = 1.5 }", "did you mean `ior`?"),
    ("{ fixed = 0.75 }", "0.9", "write { fixed = 0.9 }"),
    ("sphere = {", "box = {", "did you mean `cuboid`?"),
    ("eye = [0.0, 1.0, 4.0]", "position = [0.0, 1.0, 4.0]", "did you mean `eye`?"),
    ("fov = 40", "fov = 40;", "leave it out: a value ends with its line"),
    ("radius = 1.0 }", "radius = 1.0; }", "there is no `;` in a scene file"),
    ("eye = [0.0, 1.0, 4.0]", "eye = (0.0, 1.0, 4.0)", "write [ … ]"),
    ("fov = 40", "fov: 40", "write `=`"),
    ("center = [", "center: [", "write `=`"),
    ("fov = 40", "fov = 40 // degrees", "a comment begins with `#`"),
    ("fov = 40", "fov = 40 deg", "text must be in quotes"),
    ("radius = 1.0 } }", "radius = 1.0 }", "this `{` is not closed"),
    ("radius = 1.0 } }", "radius = 1.0", "`} }` are missing"),
    ("radius = 1.0 } }", "radius = 1.0 } } }", "there is one `}` too many"),
    ("albedo = 0.8 }", "albedo = 0.8", "`}` is missing"),
    ("4.0]", "4.0", "`]` is missing"),
    ("4.0]", "4.0}", "`[` is closed by `}`"),
    ("[camera]", "[camera", "`]` is missing"),
    ("[[objects]]", "[[objects]", "`]` is missing"),
    ("\"ball\"", "\"ball", "the text in quotes does not end"),
    ("\"white\"", "white", "text must be in quotes"),
    ("radius = 1.0", "radius = oops", "`oops` is not a number"),
    ("radiance = 2.0", "radiance = 2,0", "a value must end on its line"),
];

#[test]
fn keys_of_other_formats_are_translated() {
    for (line, by, says) in MEANT {
        refuses(line, by, says);
        let said = error(&GOOD.replacen(line, by, 1));
        assert_eq!(said.count(), 1, "{by}: one slip is one error:\n{}", said.report());
    }
    // The label is at the bracket, not between two characters.
    let bracket = error(&GOOD.replacen("4.0]", "4.0}", 1)).report();
    assert!(bracket.contains('┬') && !bracket.contains('▲'), "{bracket}");
}

#[test]
fn all_errors_of_a_file_are_reported_in_the_order_of_its_lines() {
    let all = |text: &str, says: &[(usize, &str)]| {
        let error = error(text);
        let report = error.report();
        let lines = report.lines().filter_map(|line| line.split_once("test.toml:")?.1.split(':').next()?.parse::<usize>().ok());
        assert_eq!(lines.collect::<Vec<_>>(), says.iter().map(|(line, _)| *line).collect::<Vec<_>>(), "{report}");
        says.iter().for_each(|(_, what)| assert!(report.contains(what), "{what}: {report}"));
        assert_eq!((error.count(), error.line_column().map(|place| place.0)), (says.len(), Some(says[0].0)));
    };
    // One error of form and one of value, in two tables. Consequential errors are not reported.
    let wrong = GOOD
        .replace("fov = 40", "fov = \"wide\"")
        .replace("eye = [0.0", "eye = [1e300")
        .replace("albedo = 0.8", "albedo = 1.8")
        .replace("radius = 1.0", "radios = 1.0")
        .replace("spp = 64", "samples = 64")
        .replace("{ fixed = 0.75 }", "{ fixed = 2.0 }")
        .replace("radiance = 2.0", "radiance = -2.0");
    let two_balls = "[[objects]]\nshape = { sphere = { center = [0, 0, 0], radius = -1 } }\nmaterial = \"wite\"\n[render]";
    all(
        &wrong.replace("[render]", two_balls),
        &[
            (3, "`eye` is not a position"),
            (5, "`fov`: expected a number"),
            (8, "`albedo` is out of range"),
            (11, "did you mean `radius`?"),
            (15, "`radius` is negative: -1"),
            (16, "did you mean `white`?"),
            (20, "`fixed` is out of range: 2"),
            (22, "did you mean `spp`?"),
            (25, "`radiance` is out of range: -2"),
        ],
    );
    // An invalid material or texture is still defined.
    all(&GOOD.replace("lambertian", "lambert"), &[(8, "did you mean `lambertian`?")]);
    all(&GOOD.replace("{ albedo = 0.8 }", "{ albedo = { texture = \"t\" } }\n[textures.t]\nchecker = 3"), &[(10, "a table")]);
    // Syntax errors of TOML: one per line.
    let slips = GOOD.replace("fov = 40", "fov = 40;").replace("eye = [0.0, 1.0, 4.0]", "eye = (0, 1, 4)");
    all(&slips.replace("= \"ball\"", ": \"ball\""), &[(3, "write [ … ]"), (5, "no `;`"), (10, "write `=`")]);
    // Many syntax errors of TOML: only the first one.
    let long = format!("{}# {}\n", slips.replace("= \"ball\"", ": \"ball\""), "x".repeat(1 << 18));
    assert_eq!(error(&long).count(), 1);
    let braces = GOOD.replace("radius = 1.0 } }", "radius = 1.0 }").replace("resolution = [32, 24]", "resolution = [32, 24");
    all(&braces, &[(6, "`]` is missing"), (11, "`}` is missing")]);
    // Many are counted.
    let many = "[[objects]]\nshape = { sphere = { center = [0, 0, 0], radius = -1 } }\n".repeat(1000);
    let report = error(&GOOD.replace("[render]", &format!("{many}[render]"))).report();
    assert!(report.matches("`radius` is negative").count() == 40 && report.contains("more errors"), "{report}");
}

#[test]
fn legal_values_on_several_lines_have_no_warning() {
    let lines = GOOD
        .replace(
            "center = [0.0, 1.0, 0.0], radius = 1.0 }",
            "\n  center = [\n 0.0,\n 1.0, # (x; y)\n 0.0\n],\n  radius = 1.0,\n}",
        )
        .replace("name = \"ball\"", "name = \"a (ball); it's: {\"\ntransform = [\n{ scale = 1 },\n]");
    let lines = lines.replace("[camera]", "notes = \"\"\"\nA (note); with {\nx = 3\n[camera]\n\"\"\"\n[camera]");
    parse("test.toml", lines.clone()).unwrap_or_else(|error| panic!("{}", error.report()));
    let with_slip = error(&lines.replace("spp = 64", "spp = 64;"));
    assert!(with_slip.count() == 1 && with_slip.report().contains("no `;`"), "{}", with_slip.report());
}

#[test]
fn text_that_is_not_toml_is_refused_with_its_position() {
    refuses("fov = 40", "fov = = 40", "");
    refuses("format = 1", "format = 1\nformat = 1", "duplicate key `format`");
    for nothing in ["", "\n\n", "# only a remark\n"] {
        assert!(error(nothing).report().contains("the file is empty") && error(nothing).report().contains("`format = 1`"));
    }
}

#[test]
fn a_colon_between_key_and_value_is_a_slip_and_one_in_a_time_is_not() {
    let text = GOOD.replace("fov = 40", "fov: 40").replace("seed = 9", "seed = 07:32:00");
    let report = error(&text).report();
    assert!(report.matches("joined by `=`").count() == 1 && report.contains("test.toml:5:4"), "{report}");
}

#[test]
fn files_that_are_no_scenes_are_refused_in_one_message() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    // Lines are wrapped behind a bar.
    let report = |path: &Path| {
        let report = load(path).err().expect("it is no scene").report();
        report.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
    };

    assert!(report(&file("nowhere.toml")).contains("there is no such file"));
    assert!(report(folder.path()).contains("not a regular file but a folder"));

    fs::write(file("latin1.toml"), b"format = 1\ntitle = \"caf\xe9\"\n").expect("it is written");
    let not_utf8 = report(&file("latin1.toml"));
    assert!(not_utf8.contains("not UTF-8") && not_utf8.contains("latin1.toml:2:13"), "{not_utf8}");

    fs::write(file("picture.toml"), b"\x89PNG\r\n\x1a\n\xff\xfe").expect("it is written");
    let picture = report(&file("picture.toml"));
    assert!(picture.contains("looks like a PNG image without a scene in it") && !picture.contains('\u{fffd}'));
    fs::write(file("bytes.toml"), b"format = 1\0\x01").expect("it is written");
    assert!(report(&file("bytes.toml")).contains("this is not a scene"));
    for (name, content, what) in [
        ("paper.pdf", &b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n1 0 obj\n"[..], "a PDF document, not like a scene"),
        ("paper.toml", b"%PDF-1.7\n", "a PDF document"),
        ("tool", b"\x7fELF\x02\x01\x01", "a program, not like a scene"),
        ("run.sh", b"#!/bin/sh\necho format\n", "a script"),
        ("room.blend", b"BLENDER-v300", "a Blender file"),
        ("README.md", b"# A room\n\nWith two lights.\n", "this is not a scene"),
        ("letter.txt", b"Sehr geehrte Damen, \xe4\xf6\xfc\n", "this is not a scene"),
    ] {
        fs::write(file(name), content).expect("it is written");
        let said = report(&file(name));
        assert!(said.contains(what) && said.contains("scenes are TOML, glTF") && !said.contains("quotes"), "{name}: {said}");
    }
    // A scene may have any name.
    fs::write(file("room.txt"), GOOD).expect("it is written");
    assert!(load(&file("room.txt")).is_ok());

    // A sparse file of 200 MB.
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

/// Checks the message about `GOOD` with `from` replaced by `to`: it is short, its lines are narrow, and it has no control
/// characters.
fn short_report(from: &str, to: &str) -> String {
    let text = GOOD.replacen(from, to, 1);
    assert_ne!(text, GOOD, "{from} is in the file");
    let report = error(&text).report();
    let start: String = to.chars().take(60).collect();
    assert!(report.chars().count() < 2500, "{start}: {} characters", report.chars().count());
    assert!(report.lines().all(|line| line.chars().count() < 260), "{start}: {report}");
    let obeyed = |c: char| c.is_control() && c != '\n' || ('\u{202a}'..='\u{202e}').contains(&c);
    assert!(!report.contains(obeyed), "{start}: {report:?}");
    report
}

#[test]
fn values_of_megabytes_are_not_repeated() {
    let long = "m".repeat(1 << 20);
    let said = |from: &str, to: &str, what: &str| {
        let report = short_report(from, &to.replace("LONG", &long)).replace(['│', '\n'], " ");
        let plain = report.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(plain.contains(what), "{to}: {plain}");
    };
    said("fov = 40", "fov = \"LONG\"", "`fov`: expected a number");
    said("fov = 40", "LONG = 40", "unknown key `mmm");
    said("fov = 40", "\"LONG\" = 40", "unknown key `mmm");
    said("fov = 40", "fov = 40\n\"LONG\" = 1\n\"LONG\" = 2", "duplicate key");
    said("fov = 40", "fov = LONG", "");
    said("fov = 40", &format!("fov = {}", "9".repeat(1 << 20)), "");
    said("\"stratified\"", "\"LONG\"", "unknown value `mmm");
    said("{ fixed = 0.75 }", "{ LONG = 0.75 }", "unknown type `mmm");
    said("{ fixed = 0.75 }", "{ fixed = 0.5, LONG = 1 }", "unknown type `mmm");
    said("sphere = {", "LONG = {", "unknown type `mmm");
    said("material = \"white\"", "material = \"LONG\"", "there is no material `mmm");
    said("material = \"white\"", "shape.mesh.path = \"LONG\"", "");
    said("albedo = 0.8", "albedo = { texture = \"LONG\" }", "there is no texture `mmm");
    said("[render]", "[textures.LONG]\n[render]", "` has none of");
    said("[render]", "[materials.LONG]\n[render]", "` has none of");
    said("[render]", "[textures.a]\nimage = { path = \"LONG\" }\n[render]", "mmm: cannot be read");
    said("[render]", "[environment]\nimage = \"LONG.exr\"\n[render]", "cannot be read");
    said("[render]", "[LONG]\n[render]", "unknown key `mmm");
    let iso = |expression: &str| {
        format!("isosurface = {{ expression = \"{expression}\", bounds = {{ min = [0, 0, 0], max = [1, 1, 1] }} }}")
    };
    let ball = "sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 }";
    said(ball, &iso("LONG"), "the expression has 1048576 bytes");
    said(ball, &iso(&format!("x + {}", "q".repeat(2000))), "");
    said("name = \"ball\"", "title = \"LONG\"", "unknown key `title`");
}

#[test]
fn long_lists_of_keys_are_cut() {
    let many = |table: &str, body: &str| -> String {
        (0..2000).map(|i| format!("[{table}.{}{i}]\n{body}\n", "n".repeat(50))).collect::<String>() + "[render]"
    };
    let materials = many("materials", "lambertian = { albedo = 0.5 }");
    let text = GOOD.replace("material = \"white\"", "material = \"black\"").replacen("[render]", &materials, 1);
    let report = error(&text).report();
    assert!(report.contains("and 1995 more") && report.chars().count() < 2500, "{report}");
    let chain: String = (0..40)
        .map(|i| format!("[textures.t{i}]\nchecker = {{ even = {{ texture = \"t{}\" }}, odd = 0.5, scale = 2 }}\n", (i + 1) % 40))
        .collect();
    let circle = short_report("[render]", &(chain + "[render]"));
    assert!(circle.contains("textures in a circle: `t0` uses `t1` uses … uses `t0`"), "{circle}");
}

#[test]
fn numbers_are_written_with_few_digits() {
    assert!(short_report("radius = 1.0", "radius = -1e300").contains("`radius` is negative: -1e300"));
    assert!(short_report("albedo = 0.8", "albedo = 1e-300, ior = 3").contains("unknown key"));
    assert!(short_report("albedo = 0.8", "albedo = 1e300").contains("`albedo` is out of range: 1e300"));
    assert!(short_report("{ fixed = 0.75 }", "{ fixed = 1e300 }").contains("`fixed` is out of range: 1e300"));
    assert!(short_report("fov = 40", "fov = 40\nshutter = [0.0, 1e300]").contains("closes at 1e300"));
    assert!(
        short_report("material = \"white\"", "material = \"white\"\ntransform = [{ translate = [1e300, 0, 0] }]")
            .contains("1e300")
    );
}

#[test]
fn messages_contain_no_control_characters() {
    let escape = short_report("fov = 40", "fov = 40 # \u{1b}]0;title\u{7}");
    assert!(escape.contains("test.toml:"), "{escape}");
    short_report("[render]", &format!("{}\ntitle = \"\u{1b}[2J\"\n[render]", "# a line\n".repeat(1000)));
    assert!(
        short_report("material = \"white\"", "material = \"\\u001b[31mwhite\"")
            .contains("there is no material `\\u{1b}[31mwhite`")
    );
    short_report("material = \"white\"", "material = \"a\u{202e}b\" # \u{9b}31m");
    short_report("name = \"ball\"", "\"a\\nb\\u0000\" = 1");
    let scene = parse("test.toml", GOOD.replacen("name = \"ball\"", "name = \"a\\u001b[31m\"", 1)).expect("it is good");
    assert!(scene.objects.iter().any(|object| object.name == "a\\u{1b}[31m"));
}

#[test]
fn of_an_error_over_many_lines_the_first_is_shown_at_its_number() {
    let before = "# a line\n".repeat(3000);
    let rows = "[0, 0, 0],\n".repeat(5000);
    let mesh = format!("mesh = {{ vertices = [{rows}[nan, 0, 0]], triangles = [[0, 1, 2]] }}");
    let text = GOOD.replacen("[[objects]]", &format!("{before}[[objects]]"), 1);
    let text = text.replacen("sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 }", &mesh, 1);
    let error = error(&text);
    let report = error.report();
    let line = text[..text.find("mesh =").expect("it is there")].matches('\n').count() + 1;
    assert_eq!(error.line_column().map(|place| place.0), Some(line));
    assert!(report.contains("vertex 5000 is not finite") && report.lines().count() < 20, "{report}");
    assert!(report.contains(&format!("test.toml:{line}:")) && report.contains(&format!(" {line} │ ")), "{report}");
}

#[test]
fn a_byte_that_is_not_text_is_located() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("latin1.toml");
    fs::write(&path, [b"# line\n".repeat(2000), b"title = \"caf\xe9\"".to_vec()].concat()).expect("it is written");
    let report = load(&path).err().expect("it is no scene").report();
    assert!(report.contains("latin1.toml:2001:13") && report.contains("2001 │ title"), "{report}");
}
