//! Scene files: valid ones compile; invalid ones get a message with the error, its position, and the expected value.
use std::{
    fs,
    path::{Path, PathBuf},
};

use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{BUILT_IN, Roulette, SceneError, SceneReference, built_in, load, parse},
};

pub(super) const GOOD: &str = r#"format = 1
[camera]
eye = [0.0, 1.0, 4.0]
look_at = [0, 1, 0]
fov = 40
resolution = [32, 24]
[materials.white]
lambertian = { albedo = 0.8 }
[[objects]]
name = "ball"
shape = { sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 } }
material = "white"
emission = { radiance = [1.0, 2.0, 3.0] }
[render]
sampler = "stratified"
directions = "uniform"
roulette = { fixed = 0.75 }
max_bounces = 5
spp = 64
seed = 9
[reference]
radiance = 2.0
"#;

pub(super) fn error(text: &str) -> SceneError {
    parse("test.toml", text.to_owned()).err().unwrap_or_else(|| panic!("this compiles:\n{text}"))
}

/// Checks that `GOOD` with one line replaced fails at that line, with a message that contains `message`.
pub(super) fn refuses(line: &str, by: &str, message: &str) {
    assert!(GOOD.contains(line), "{line}");
    let text = GOOD.replacen(line, by, 1);
    let error = error(&text);
    let report = error.report();
    assert!(report.contains(message), "expected {message:?} in:\n{report}");
    let (line, column) = error.line_column().unwrap_or_else(|| panic!("no place in:\n{report}"));
    assert!(report.contains(&format!("test.toml:{line}:{column}")), "{report}");
    assert!(report.contains('─') || report.contains('▲'), "no caret in:\n{report}");
    let first = GOOD.lines().zip(text.lines()).position(|(a, b)| a != b).expect("a line differs") + 1;
    let last = first + by.lines().count().max(1) - 1;
    // A missing key is reported at its table.
    assert!((1..=last).contains(&line), "at line {line}, not {first}..={last}:\n{report}");
}

#[test]
fn a_good_file_is_read_as_written() {
    let scene = parse("test.toml", GOOD.to_owned()).expect("it is good");
    assert_eq!(scene.camera.resolution, [32, 24]);
    assert_eq!(scene.camera.fov, 40.0);
    assert_eq!((scene.settings.sampler, scene.settings.directions), (Sampler::Stratified, Directions::Uniform));
    assert_eq!((scene.settings.roulette, scene.settings.max_bounces), (Roulette::fixed(0.75), Some(5)));
    assert_eq!((scene.spp, scene.settings.seed), (Some(64), 9));
    assert_eq!(scene.reference, Some(SceneReference::Radiance([2.0; 3])));
    assert_eq!(scene.objects[0].name, "ball");
    assert!(scene.warnings().is_empty());
}

#[test]
fn the_built_in_scene_is_the_shipped_one() {
    assert_eq!(built_in().objects.len(), 8);
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell_spheres.toml");
    assert_eq!(fs::read_to_string(shipped).expect("it is shipped"), BUILT_IN);
}

/// The files of all shipped scenes.
pub fn shipped_scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = fs::read_dir(folder).expect("scenes are shipped").map(|entry| entry.expect("an entry").path());
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

#[test]
fn every_shipped_scene_compiles_has_notes_and_emits_light() {
    let mut count = 0;
    for path in shipped_scenes() {
        let scene = load(&path).unwrap_or_else(|error| panic!("{}", error.report()));
        assert!(!scene.title.is_empty() && !scene.notes.is_empty(), "{} says nothing", path.display());
        assert_eq!(scene.warnings(), [] as [String; 0], "{}", path.display());
        count += 1;
    }
    assert!(count >= 9);
}

#[test]
fn unknown_keys_and_kinds_are_refused() {
    refuses("fov = 40", "fov = 40\nfocal = 3", "unknown key `focal`");
    refuses("albedo = 0.8", "albedo = 0.8, color = 1", "unknown key `color`");
    refuses("sphere = {", "ball = {", "unknown type `ball`");
    refuses("\"stratified\"", "\"halton\"", "unknown value `halton`");
    refuses("format = 1", "format = 1\nsources = []", "unknown key `sources`");
    refuses("{ fixed = 0.75 }", "\"always\"", "unknown value `always`");
}

#[test]
fn wrong_types_are_refused() {
    refuses("fov = 40", "fov = \"wide\"", "`fov`: expected a number, found the text \"wide\"");
    refuses("look_at = [0, 1, 0]", "look_at = [0, 1]", "`look_at`: expected a list of 3, found 2 values");
    refuses("resolution = [32, 24]", "resolution = [32, 24, 3]", "expected a list of 2, found 3 values");
    refuses("albedo = 0.8", "albedo = [0.8, 0.8]", "expected a colour");
    refuses("albedo = 0.8", "albedo = [0.8, 0.8, 0.8, 0.8]", "expected a colour");
    refuses("albedo = 0.8", "albedo = \"white\"", "expected a colour");
    refuses("max_bounces = 5", "max_bounces = -1", "`max_bounces`: expected a whole number, 0 or more, found -1");
    refuses("seed = 9", "seed = 1.5", "expected a whole number, 0 or more, found 1.5");
}

#[test]
fn roulette_by_throughput_can_be_said_as_on_the_command_line() {
    let roulette = |text: &str| parse("test.toml", GOOD.replace("{ fixed = 0.75 }", text)).expect("it is good").settings.roulette;
    assert_eq!(roulette("\"throughput\""), Roulette::BY_THROUGHPUT);
    assert_eq!(roulette("{ throughput = {} }"), Roulette::BY_THROUGHPUT);
    assert_eq!(roulette("{ throughput = { start = 7 } }"), Roulette::by_throughput_from(7));
    assert_eq!(roulette("\"off\""), Roulette::Off);
}

#[test]
fn missing_keys_are_named() {
    refuses("fov = 40\n", "", "missing key `fov`");
    refuses("format = 1\n", "", "missing key `format`");
    assert!(error(&GOOD.replace("fov = 40\n", "")).to_string().starts_with("missing key `fov`"));
    refuses(", radius = 1.0", "", "missing key `radius`");
    refuses("lambertian = { albedo = 0.8 }", "", "`white` has none of `lambertian`, `mirror`");
    refuses("emission = { radiance = [1.0, 2.0, 3.0] }", "emission = {}", "`emission` has none of `radiance`, `texture`");
}

#[test]
fn names_must_be_defined() {
    refuses("material = \"white\"", "material = \"whit\"", "there is no material `whit`");
    assert!(error(&GOOD.replace("material = \"white\"", "material = \"x\"")).report().contains("defines `white`"));
    let more: String = (0..7).map(|i| format!("[materials.m{i}]\nmirror = {{ reflectance = 0.5 }}\n")).collect();
    let many = GOOD.replace("[[objects]]", &format!("{more}[[objects]]")).replace("material = \"white\"", "material = \"x\"");
    assert!(error(&many).report().contains("`m4`, `m5` and 2 more"), "of eight");
}

#[test]
fn numbers_out_of_range_are_refused() {
    refuses("radius = 1.0", "radius = -1.0", "`radius` is negative: -1");
    refuses("radius = 1.0", "radius = -1.0", "keep the radius positive");
    refuses("radius = 1.0", "radius = 0.0", "`radius` is out of range: 0");
    assert!(!error(&GOOD.replace("radius = 1.0", "radius = 0.0")).report().contains("keep the radius positive"));
    refuses("radius = 1.0", "radius = nan", "`radius` is not a number");
    refuses("radius = 1.0", "radius = inf", "`radius` is out of range: inf");
    refuses("albedo = 0.8", "albedo = 1.01", "`albedo` is out of range: 1.01");
    refuses("albedo = 0.8", "albedo = [0.1, -0.1, 0.5]", "`albedo` is out of range");
    refuses("albedo = 0.8", "albedo = nan", "`albedo` is out of range");
    refuses("[1.0, 2.0, 3.0]", "[1.0, -2.0, 3.0]", "`radiance` is out of range");
    refuses("[1.0, 2.0, 3.0]", "inf", "`radiance` is out of range");
    refuses("center = [0.0, 1.0, 0.0]", "center = [nan, 1.0, 0.0]", "`center` is not a position");
    refuses("eye = [0.0, 1.0, 4.0]", "eye = [1e300, 1.0, 4.0]", "`eye` is not a position");
    refuses("fov = 40", "fov = 180", "`fov` is out of range: 180");
    refuses("fov = 40", "fov = nan", "`fov` is not a number");
    refuses("look_at = [0, 1, 0]", "look_at = [0, 1, 4]", "the same point");
    refuses("look_at = [0, 1, 0]", "look_at = [0, 0, 4]", "parallel");
    refuses("look_at = [0, 1, 0]", "look_at = [0, 0, 4]", "`up` is [0, 1, 0] by default");
    refuses("resolution = [32, 24]", "resolution = [0, 24]", "resolution must be");
    refuses("resolution = [32, 24]", "resolution = [100000, 2]", "resolution must be");
    refuses("resolution = [32, 24]", "resolution = [16384, 16384]", "resolution must be");
    refuses("resolution = [32, 24]", "resolution = [-1, 24]", "expected a whole number, 0 or more, found -1");
    refuses("fixed = 0.75", "fixed = 0.0", "`fixed` is out of range: 0");
    refuses("fixed = 0.75", "fixed = 1.5", "`fixed` is out of range: 1.5");
    refuses("fixed = 0.75", "fixed = nan", "`fixed` is not a number");
    refuses("spp = 64", "spp = 0", "`spp` is out of range: 0");
    refuses("fixed = 0.75", "fixed = 0.001", "`fixed` is out of range: 0.001");
    refuses("format = 1", "format = 2", "scene format 2");
    assert!(error("format = 2\n").report().contains("scene format 2"), "whatever else it says");
}

#[test]
fn an_impossible_camera_is_refused() {
    let camera = |key: &str, message: &str| refuses("fov = 40", &format!("fov = 40\n{key}"), message);
    camera("lens = { radius = -0.05, focus = 3.0 }", "`radius` is negative: -0.05");
    camera("lens = { radius = nan, focus = 3.0 }", "`radius` is not a number");
    camera("lens = { radius = 0.05, focus = 0.0 }", "`focus` is out of range: 0");
    camera("lens = { radius = 0.05 }", "missing key `focus`");
    camera("filter = { tent = { radius = 0.0 } }", "`radius` is out of range: 0");
    camera("filter = { gaussian = { sigma = nan } }", "`sigma` is not a number");
    camera("filter = \"sinc\"", "unknown value `sinc`");
    camera("filter = 1.0", "`filter`: expected a name in quotes, or a table { … }");
    for filter in ["\"box\"", "\"tent\"", "\"gaussian\"", "{ tent = { radius = 1.5 } }", "{ gaussian = { sigma = 0.4 } }"] {
        let text = GOOD.replace("fov = 40", &format!("fov = 40\nfilter = {filter}"));
        assert!(parse("test.toml", text).is_ok(), "{filter}");
    }
    camera("projection = { orthographic = { width = 2.0 } }", "has no `fov`");
    refuses("fov = 40", "projection = { orthographic = { width = -2.0 } }", "`width` is negative: -2");
    refuses("fov = 40", "projection = { orthographic = { width = 1 } }\nlens = { radius = 1, focus = 1 }", "needs a perspective");
}

#[test]
fn invalid_materials_are_refused() {
    let material = |by: &str, message: &str| refuses("lambertian = { albedo = 0.8 }", by, message);
    material("lambertian = { albedo = 0.8 }\nmirror = { reflectance = 1.0 }", "`lambertian` and `mirror` exclude each other");
    material("mirror = { reflectance = 1.1 }", "`reflectance` is out of range");
    material("dielectric = { ior = 0.0 }", "expected a number from 0.05 to 20");
    material("dielectric = { ior = -1.5 }", "`ior` is negative: -1.5");
    material("dielectric = { ior = nan }", "`ior` is");
    material("dielectric = { ior = 1.5, ior_outside = 0.0 }", "`ior_outside` is out of range");
    material("dielectric = { ior = 1.5, transmittance = 1.5 }", "`transmittance` is out of range");
    material("dielectric = { ior = 1.5, roughness = 1.5 }", "`roughness` is out of range");
    material("dielectric = { ior = 1.5, roughness = [0.1, 0.2, 0.3] }", "`roughness`: expected one number, found a list");
    material("dielectric = { ior = 1.5 }\ntwo_sided = false", "has two sides");
    material("conductor = { roughness = 0.1 }", "`conductor` has none of `eta`, `f0`, `reflectance`");
    material("conductor = { eta = nan, k = 1.0 }", "`eta` is out of range");
    material("conductor = { f0 = 0.5, reflectance = 0.5 }", "`f0` and `reflectance` exclude each other");
    material("conductor = { f0 = 0.5, roughness = -0.1 }", "`roughness` is negative");
    material("conductor = { f0 = 0.5, roughness = 0.1, alpha = 0.1 }", "`roughness` and `alpha` exclude each other");
    material("plastic = { albedo = 0.5, ior = 0.9 }", "`ior` is out of range");
    material("plastic = { albedo = 2.0, ior = 1.5 }", "`albedo` is out of range");
    material("lambertian = { albedo = 0.8 }\nbump = { texture = \"no\", height = 1.0 }", "there is no texture `no`");
    material("lambertian = { albedo = 0.8 }\nnormal_map = \"no.png\"", "no.png");
}

#[test]
fn invalid_lights_are_refused() {
    refuses("radiance = [1.0, 2.0, 3.0]", "radiance = 0.0", "a light of zero power");
    refuses("radiance = [1.0, 2.0, 3.0]", "radiance = 1.0, scale = 0.0", "a light of zero power");
    refuses("radiance = [1.0, 2.0, 3.0]", "texture = \"no\"", "there is no texture `no`");
    refuses("[render]", "[environment]\nimage = \"no.exr\"\n[render]", "no.exr");
    refuses("[render]", "[environment]\n[render]", "`environment` has none of `radiance`, `image`");
    refuses("[render]", "[environment]\nradiance = 1.0\nrotate = 3.0\n[render]", "`radiance` and `image` exclude each other");
}

#[test]
fn a_scene_that_cannot_show_anything_says_so() {
    let dark = GOOD.replace("emission = { radiance = [1.0, 2.0, 3.0] }\n", "");
    let scene = parse("test.toml", dark).expect("it is legal");
    assert!(scene.warnings()[0].contains("nothing in this scene emits light"));
}

#[test]
fn flip_turns_the_emitting_side_and_two_sided_has_both() {
    use noisefall_scene::light::Side;
    let side = |emission: &str, flip: &str| {
        let text = GOOD.replace("emission = { radiance = [1.0, 2.0, 3.0] }", &format!("emission = {emission}\n{flip}"));
        parse("test.toml", text).expect("it is good").objects[0].emission.map(|emission| emission.side)
    };
    assert_eq!(side("{ radiance = 1 }", ""), Some(Side::Front));
    assert_eq!(side("{ radiance = 1 }", "flip = true"), Some(Side::Back));
    assert_eq!(side("{ radiance = 1, two_sided = true }", "flip = true"), Some(Side::Both));
}
