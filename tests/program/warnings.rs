//! Warnings about scenes that are valid but probably not as intended.
use std::fs;

use noisefall_scene::scene::parse;

use super::{
    command_line::{Shell, scene, text},
    scene_files::GOOD,
};

/// The warnings of `GOOD` with something replaced.
fn warnings(from: &str, to: &str) -> Vec<String> {
    let text = GOOD.replacen(from, to, 1);
    assert!(from == to || text != GOOD, "{from}");
    let scene = parse("test.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
    scene.warnings().to_vec()
}

#[test]
fn each_slip_has_its_warning() {
    let light = "emission = { radiance = [1.0, 2.0, 3.0] }";
    let glass = "lambertian = { albedo = 0.8 }\n[materials.glass]\ndielectric = { ior = 1.5 }";
    for (from, to, says) in [
        ("material = \"white\"\nemission = { radiance = [1.0, 2.0, 3.0] }", "", "`ball` has neither `material` nor `emission`"),
        ("lambertian = { albedo = 0.8 }", "null = {}", "`ball` has `emission` but a material that lets all light pass"),
        ("eye = [0.0, 1.0, 4.0]", "eye = [0.1, 1.0, 0.2]", "inside `ball`, which emits outwards only: `flip = true`"),
        ("fov = 40", "fov = 0.7", "0.7 is a narrow view: taken as radians, it would be 40.1°"),
        ("fov = 40", "fov = 1.0", "1 is a narrow view: taken as radians, it would be 57.3°"),
        ("look_at = [0, 1, 0]", "look_at = [0, -30, 3.9]", "`up` is nearly parallel to the direction of view"),
    ] {
        let said = warnings(from, to);
        assert!(said.iter().any(|warning| warning.contains(says)), "{to}: {said:?}");
    }
    let flipped = GOOD.replacen("lambertian = { albedo = 0.8 }", glass, 1);
    let flipped =
        flipped.replacen(light, "flip = true\n[[objects]]\nshape = { sphere = { center = [9, 0, 0], radius = 1 } }\nEM", 1);
    let flipped = flipped.replacen("\"white\"", "\"glass\"", 1).replacen("EM", light, 1);
    let said = parse("test.toml", flipped).unwrap_or_else(|error| panic!("{}", error.report())).warnings().to_vec();
    assert!(said.len() == 1 && said[0].contains("`ball` has `flip` on a dielectric"), "{said:?}");
    let bare = "[[objects]]\nshape = { sphere = { center = [9, 0, 0], radius = 1 } }\n";
    for (count, who) in [
        (2, "object 2, object 3 have"),
        (4, "object 2, object 3, object 4 and 1 more object have"),
        (5, "and 2 more objects have"),
    ] {
        let said = warnings("[render]", &format!("{}[render]", bare.repeat(count)));
        assert!(said.len() == 1 && said[0].contains(who), "{said:?}");
    }
    // There is no warning about intentional settings.
    assert_eq!(warnings("eye = [0.0, 1.0, 4.0]", "eye = [0.1, 1.0, 0.2]").len(), 1);
    assert_eq!(warnings(light, &format!("{light}\nflip = true")), Vec::<String>::new());
    assert_eq!(warnings("fov = 40", "fov = 3.5"), Vec::<String>::new());
}

/// A light at a distance below a ceiling of the same shape, with its front up or down.
fn ceiling(shape: &str, above: f64, light: &str) -> Vec<String> {
    let ceiling = shape.replace('Y', &format!("{:?}", 2.0 + above));
    let objects = format!(
        "[[objects]]\nname = \"light\"\nshape = {{ {} }}\nemission = {{ {light}\n\
         [[objects]]\nname = \"ceiling\"\nshape = {{ {ceiling} }}\nmaterial = \"white\"\n[render]",
        shape.replace('Y', "2.0")
    );
    warnings("[render]", &objects)
}

#[test]
fn a_light_against_a_wall_has_a_warning_whatever_its_shape_and_side() {
    let shapes = [
        // The fronts of the lights are below.
        "rectangle = { origin = [0, Y, 0], edge_u = [1, 0, 0], edge_v = [0, 0, 1] }",
        "triangle = { a = [0, Y, 0], b = [1, Y, 0], c = [0, Y, 1] }",
        "disk = { center = [0, Y, 0], normal = [0, -1, 0], radius = 1 }",
    ];
    for shape in shapes {
        let up = ceiling(shape, 1e-3, "radiance = 1 }\nflip = true");
        assert!(up.len() == 1 && up[0].contains("the light `light` faces `ceiling` from almost no distance"), "{shape}: {up:?}");
        assert_eq!(ceiling(shape, 1e-3, "radiance = 1 }"), Vec::<String>::new(), "{shape}: it faces the room");
        assert_eq!(ceiling(shape, 1e-3, "radiance = 1, two_sided = true }"), Vec::<String>::new(), "{shape}");
        assert_eq!(ceiling(shape, 0.1, "radiance = 1 }\nflip = true"), Vec::<String>::new(), "{shape}: an uplight");
        let down = ceiling(shape, -1e-3, "radiance = 1 }");
        assert!(down.len() == 1 && down[0].contains("faces `ceiling`"), "{shape}: {down:?}");
    }
}

#[test]
fn check_and_render_report_a_contradicted_truth() {
    let shell = Shell::new();
    let furnace = fs::read_to_string(scene("furnace")).expect("it is shipped");
    let with_truth = |reference: &str| {
        fs::write(shell.path("a.toml"), furnace.replace("[reference]\nradiance = 2.0", &format!("[reference]\n{reference}")))
            .expect("written");
        let checked = text(&shell.run(&["check", "a.toml"]).stdout);
        let rendered = shell.run(&["render", "a.toml", "-o", "a.png", "--spp", "64", "--size", "32x32"]);
        let told = |text: &str| text.contains("than [reference] says, by ");
        (told(&checked), told(&text(&rendered.stderr)), checked)
    };
    assert!(!with_truth("radiance = 2.0").0);
    // With 64 samples on 48 × 48 pixels the standard error of the mean is 0.1 %.
    for wrong in ["radiance = 2.05", "radiance = 1.95", "radiance = 0.0"] {
        let (checked, rendered, said) = with_truth(wrong);
        assert!(checked && rendered, "{wrong}: {said}");
    }
    let capped = shell.run(&["render", &scene("furnace"), "-o", "a.png", "--spp", "64", "--size", "32x32", "--max-bounces", "2"]);
    let said = text(&capped.stderr);
    assert!(said.contains("less radiance on average than [reference]") && said.contains("(it is biased: cap at 2)"), "{said}");
}

#[test]
fn options_of_other_renderers_are_translated() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    for (option, meant) in [
        ("--samples", "--spp"),
        ("--samples=5", "--spp"),
        ("--max-depth", "--max-bounces"),
        ("--resolution", "--size"),
        ("--integrator", "--estimator"),
    ] {
        let output = shell.run(&["render", &furnace, "-o", "a.png", option, "5"]);
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(&format!("'{meant}'")), "{option}: {said}");
    }
    let said = text(&shell.run(&["study", &furnace, "-o", "study", "--integrator", "mis"]).stderr);
    assert!(said.contains("'--estimators'"), "{said}");
}
