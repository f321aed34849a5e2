//! Textures of scene files: their compiled form, and messages about invalid ones.
use std::{fs, path::Path};

use noisefall_scene::scene::parse;

use super::scene_files::{GOOD, error, refuses};

/// `GOOD` with these tables in place of one line.
fn refuses_tables(tables: &str, message: &str) {
    refuses("[render]", &format!("{tables}\n[render]"), message);
}

fn texture(body: &str, message: &str) {
    refuses_tables(&format!("[textures.t]\n{body}"), message);
}

fn image(path: &Path, message: &str) {
    texture(&format!("image = {{ path = '{}' }}", path.display()), message);
}

/// A Radiance HDR file with a header and these bytes.
fn hdr(path: &Path, size: &str, pixels: &[u8]) {
    fs::write(path, [b"#?RADIANCE\n\n", size.as_bytes(), b"\n", pixels].concat()).expect("it is written");
}

#[test]
fn good_textures_compile() {
    let folder = tempfile::tempdir().expect("a folder");
    hdr(&folder.path().join("sky.hdr"), "-Y 1 +X 2", &[128, 64, 0, 129, 128, 64, 0, 130]);
    let tables = "[textures.a]\nchecker = { even = { texture = \"z\" }, odd = 0.5, scale = 8 }\n[textures.i]\n\
                  image = { path = \"sky.hdr\", encoding = \"linear\" }\n[textures.z]\n\
                  noise = { scale = 4.0, octaves = 5, low = 0.2, high = [0.4, 0.9, 0.8] }\n[render]";
    let name = folder.path().join("scene.toml");
    let scene = parse(&name.display().to_string(), GOOD.replace("[render]", tables)).unwrap_or_else(|e| panic!("{}", e.report()));
    // The noise and the constant of the checker, the checker, the image.
    assert_eq!(scene.textures.len(), 4);
    let close = |found: [f32; 3], expected: [f32; 3]| (0..3).all(|i| (found[i] - expected[i]).abs() < 1e-6);
    assert!(close(scene.textures.mean(2), [0.4, 0.525, 0.5]), "{:?}", scene.textures.mean(2));
    assert!(close(scene.textures.mean(3), [1.5, 0.75, 0.0]), "{:?}", scene.textures.mean(3));
}

#[test]
fn pictures_that_cannot_be_used_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    image(&file("nowhere.png"), "nowhere.png: cannot be read: there is no such file");
    fs::write(file("text.png"), "no image").expect("it is written");
    image(&file("text.png"), "not an image");
    image(folder.path(), "cannot be read");
    hdr(&file("empty.hdr"), "-Y 0 +X 0", &[]);
    image(&file("empty.hdr"), "0 × 0");
    hdr(&file("wide.hdr"), "-Y 2 +X 60000", &[]);
    image(&file("wide.hdr"), "60000 × 2");
    hdr(&file("short.hdr"), "-Y 2 +X 2", &[1, 2, 3, 4]);
    image(&file("short.hdr"), "ends within its pixels");
    hdr(&file("blinding.hdr"), "-Y 1 +X 2", &[1, 1, 0, 1, 255, 255, 255, 255]);
    image(&file("blinding.hdr"), "column 1, row 0");
}

#[test]
fn textures_say_exactly_one_kind() {
    texture("", "`t` has none of `image`, `checker`, `noise`");
    let noise = "noise = { scale = 1, octaves = 1, low = 0, high = 1 }";
    texture(&format!("{noise}\nchecker = {{ even = 0, odd = 1, scale = 1 }}"), "`checker` and `noise` exclude each other");
    texture("marble = { scale = 1 }", "unknown type `marble`");
    texture("image = { path = \"a.png\", encoding = \"gamma\" }", "unknown value `gamma`");
    texture("image = {}", "missing key `path`");
}

#[test]
fn parameters_out_of_range_are_refused() {
    let checker = |even: &str, scale: &str| format!("checker = {{ even = {even}, odd = 0.1, scale = {scale} }}");
    texture(&checker("\"red\"", "1"), "expected a colour");
    texture(&checker("[1, 2]", "1"), "expected a colour");
    texture(&checker("-1", "1"), "`even` is out of range");
    texture(&checker("nan", "1"), "`even` is out of range");
    texture(&checker("{ name = \"x\" }", "1"), "unknown key `name`");
    texture(&checker("{}", "1"), "missing key `texture`");
    for scale in ["0", "-1", "nan", "inf", "1e9"] {
        texture(&checker("0.5", scale), "expected a number from 1e-6 to 100000");
    }
    let noise = |scale: &str, octaves: &str, low: &str| {
        format!("noise = {{ scale = {scale}, octaves = {octaves}, low = {low}, high = 1 }}")
    };
    texture(&noise("0", "5", "0"), "`scale` is out of range");
    texture(&noise("1", "0", "0"), "`octaves` is out of range");
    texture(&noise("1", "17", "0"), "`octaves` is out of range");
    texture(&noise("1", "5", "\"dark\""), "expected a colour");
    texture(&noise("1", "5", "{ texture = \"t\" }"), "cannot be a texture here");
}

fn checkers(pairs: &[(&str, &str)]) -> String {
    let table = |(name, even): &(&str, &str)| {
        format!("[textures.{name}]\nchecker = {{ even = {{ texture = \"{even}\" }}, odd = 0.5, scale = 2 }}\n")
    };
    pairs.iter().map(table).collect()
}

#[test]
fn names_of_textures_must_be_defined_and_go_in_no_circle() {
    refuses_tables(&checkers(&[("a", "b")]), "there is no texture `b`");
    assert!(error(&GOOD.replace("[render]", &(checkers(&[("a", "b")]) + "[render]"))).report().contains("defines `a`"));
    refuses_tables(&checkers(&[("a", "a")]), "textures in a circle: `a` uses `a`");
    refuses_tables(&checkers(&[("a", "b"), ("b", "c"), ("c", "b")]), "textures in a circle: `b` uses `c` uses `b`");
    refuses("albedo = 0.8", "albedo = { texture = \"tiles\" }", "there is no texture `tiles`");
    let chain: Vec<String> = (0..200).map(|i| format!("t{i:06}")).collect();
    let pairs: Vec<_> = chain.windows(2).map(|pair| (pair[0].as_str(), pair[1].as_str())).collect();
    refuses_tables(&checkers(&pairs), "nested deeper than 64");
}

#[test]
fn textures_of_materials_are_held_to_their_range() {
    let with = |even: &str| {
        let tables = format!("[textures.t]\nchecker = {{ even = {even}, odd = 0.5, scale = 2 }}\n[render]");
        let text = GOOD.replace("[render]", &tables).replace("albedo = 0.8", "albedo = { texture = \"t\" }");
        parse("test.toml", text)
    };
    let bright = with("1.5").err().expect("no surface reflects so much").report();
    assert!(bright.contains("texture `t` reaches 1.5"), "{bright}");
    assert!(with("0.9").is_ok());
}
