//! Invalid scenes, and scenes with a mistake.
use super::{Family, random::anything};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Expected, TrialScene},
};

pub const FAMILIES: [Family; 2] = [
    Family {
        name: "refused",
        what: "values out of range, shapes without extent, broken text",
        scenes: 150,
        trial_scene: refused,
    },
    Family { name: "mistakes", what: "random scenes with one number or character changed", scenes: 500, trial_scene: mistakes },
];

const CAMERA: &str = "eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0]";

/// Texts in which `X` stands for one of the invalid numbers that follow.
const CASES: [(&str, &[&str]); 26] = [
    ("camera = { CAMERA, fov = X, resolution = [8, 8] }", &["0.0", "180.0", "-40.0", "nan", "inf", "1e-4"]),
    ("camera = { CAMERA, fov = 40.0, resolution = [X, 8] }", &["0", "-1", "1000000", "4294967296", "1.5"]),
    (
        "camera = { eye = [X, 0.0, 0.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }",
        &["nan", "inf", "1e13", "0.0"],
    ),
    ("camera = { CAMERA, up = [0.0, 0.0, X], fov = 40.0, resolution = [8, 8] }", &["0.0", "1.0", "-1.0", "nan"]),
    ("camera = { CAMERA, fov = 40.0, resolution = [8, 8], lens = { radius = X, focus = 1.0 } }", &["-1.0", "nan", "inf", "1e12"]),
    ("camera = { CAMERA, fov = 40.0, resolution = [8, 8], lens = { radius = 1.0, focus = X } }", &["0.0", "-1.0", "nan", "inf"]),
    ("camera = { CAMERA, projection.orthographic.width = X, resolution = [8, 8] }", &["0.0", "-1.0", "nan", "1e30"]),
    ("camera = { CAMERA, fov = 40.0, resolution = [8, 8], shutter = [0.0, X] }", &["-1.0", "nan", "inf"]),
    (
        "camera = { CAMERA, fov = 40.0, resolution = [8, 8], filter = { gaussian = { sigma = X } } }",
        &["0.0", "-1.0", "1e3", "nan"],
    ),
    ("VIEW\nenvironment.radiance = X", &["-1.0", "1e16", "nan", "inf", "'white'"]),
    ("VIEW\nmaterials.m.lambertian.albedo = X", &["-0.1", "1.000001", "nan", "inf", "[1.0, 1.0]", "{ texture = 'none' }"]),
    ("VIEW\nmaterials.m.mirror.reflectance = X", &["-0.1", "2.0", "nan"]),
    ("VIEW\nmaterials.m.dielectric.ior = X", &["0.0", "-1.5", "1e9", "nan", "inf"]),
    ("VIEW\nmaterials.m.plastic = { albedo = 1.0, ior = X }", &["0.9", "-1.5", "nan", "1e9"]),
    ("VIEW\nmaterials.m.conductor = { f0 = 1.0, alpha = X }", &["-0.1", "1.1", "nan", "[0.1, 0.2, 0.3]"]),
    ("VIEW\nrender.roulette.fixed = X", &["0.0", "-1.0", "1.5", "nan", "1e-9"]),
    ("VIEW\nrender.max_bounces = X", &["-1", "1.5", "4294967296"]),
    (
        "VIEW\n[[objects]]\nshape.sphere = { center = [0.0, 0.0, 0.0], radius = X }",
        &["0.0", "-1.0", "nan", "inf", "1e-13", "1e13"],
    ),
    ("VIEW\n[[objects]]\nshape.sphere = { center = [X, 0.0, 0.0], radius = 1.0 }", &["nan", "inf", "-inf", "1e13", "1e300"]),
    ("VIEW\n[[objects]]\nshape.cuboid = { min = [0.0, 0.0, 0.0], max = [1.0, X, 1.0] }", &["0.0", "-1.0", "nan", "1e13"]),
    (
        "VIEW\n[[objects]]\nshape.triangle = { a = [0.0, 0.0, 0.0], b = [1.0, 1.0, 1.0], c = [X, X, X] }",
        &["0.0", "1.0", "2.0", "nan"],
    ),
    (
        "VIEW\n[[objects]]\nshape.rectangle = { origin = [0.0, 0.0, 0.0], edge_u = [1.0, 0.0, 0.0], edge_v = [X, 0.0, 0.0] }",
        &["0.0", "1.0", "nan"],
    ),
    ("VIEW\n[[objects]]\nshape.cylinder = { base = [0.0, 0.0, 0.0], top = [0.0, X, 0.0], radius = 1.0 }", &["0.0", "nan", "inf"]),
    ("VIEW\n[[objects]]\nSPHERE\ntransform = [{ scale = [1.0, X, 1.0] }]", &["0.0", "nan", "inf", "1e-300", "1e300"]),
    (
        "VIEW\n[[objects]]\nshape.mesh = { vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], triangles = [[0, 1, X]] }",
        &["2", "-1", "4294967296"],
    ),
    ("VIEW\n[[objects]]\nSPHERE\nX = 1.0", &["colour", "", "radius radius", "[", "\\u0000"]),
];

fn refused(dice: &mut Dice) -> TrialScene {
    let (text, values) = dice.pick(&CASES);
    let text = text
        .replace("VIEW", "camera = { CAMERA, fov = 40.0, resolution = [8, 8] }")
        .replace("SPHERE", "shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }")
        .replace("CAMERA", CAMERA)
        .replace('X', dice.pick(values));
    TrialScene::of(text, Expected::Refused)
}

const VALUES: [&str; 18] = [
    "0.0",
    "-0.0",
    "1.0",
    "-1.0",
    "1e-300",
    "1e300",
    "nan",
    "inf",
    "-inf",
    "1e12",
    "-1e12",
    "1e-12",
    "1e7",
    "1e-45",
    "3e38",
    "0",
    "-1",
    "4294967295",
];

fn mistakes(dice: &mut Dice) -> TrialScene {
    let trial_scene = anything(dice);
    let mut text = trial_scene.text;
    match dice.below(8) {
        0 => {
            text.remove(dice.below(text.len()));
        }
        1 => text.truncate(dice.below(text.len())),
        2 => text.insert_str(dice.below(text.len()), dice.pick(&["[", "}", "\"", "=", "\u{0}", "1e", "ε", "\n"])),
        _ => {
            let numbers = numbers(&text);
            let (start, end) = dice.pick(&numbers);
            text.replace_range(start..end, dice.pick(&VALUES));
        }
    }
    TrialScene { text, expected: Expected::ValidOrRefused, spp: 2, ..trial_scene }
}

/// Byte ranges of the numbers in a text.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let belongs = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
    let mut found = Vec::new();
    let mut start = None;
    for (i, c) in text.char_indices() {
        match (start, belongs(c)) {
            (None, true) if c.is_ascii_digit() || c == '-' => start = Some(i),
            (Some(from), false) => {
                found.push((from, i));
                start = None;
            }
            _ => {}
        }
    }
    found
}
