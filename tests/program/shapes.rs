//! Shapes and transforms in scene files.
use noisefall_scene::{
    geometry::Shape,
    scene::{Scene, parse},
};

use crate::scene_files::{GOOD, error, refuses};

const BALL: &str = "sphere = { center = [0.0, 1.0, 0.0], radius = 1.0 }";

fn shape(text: &str, message: &str) {
    refuses(BALL, text, message);
}

fn transform(list: &str, message: &str) {
    refuses("material = \"white\"", &format!("material = \"white\"\ntransform = [ {list} ]"), message);
}

fn with(line: &str) -> Scene {
    let text = GOOD.replacen("material = \"white\"", &format!("material = \"white\"\n{line}"), 1);
    parse("test.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

#[test]
fn degenerate_shapes_are_refused() {
    shape("cuboid = { min = [0.0, 0.0, 0.0], max = [-1.0, 1.0, 1.0] }", "inverted or empty in x: 0 to -1");
    shape("cuboid = { min = [0.0, 0.0, 0.0], max = [1.0, -1.0, 1.0] }", "inverted or empty in y: 0 to -1");
    shape("cuboid = { min = [0.0, 0.0, 0.0], max = [1.0, 1.0, 0.0] }", "inverted or empty in z");
    shape("cuboid = { min = [0.0, 0.0, nan], max = [1.0, 1.0, 1.0] }", "`min` is not a position");
    shape("cylinder = { base = [0.0, 1.0, 0.0], top = [0.0, 1.0, 0.0], radius = 1.0 }", "has no height");
    shape("cylinder = { base = [0.0, 1.0, 0.0], top = [0.0, 2.0, 0.0], radius = -1.0 }", "`radius` is negative: -1");
    shape("disk = { center = [0.0, 1.0, 0.0], normal = [0.0, 0.0, 0.0], radius = 1.0 }", "the normal has no direction");
    shape("disk = { center = [0.0, 1.0, 0.0], radius = 1.0 }", "normal");
    shape("rectangle = { origin = [0.0, 0.0, 0.0], edge_u = [1.0, 2.0, 0.0], edge_v = [2.0, 4.0, 0.0] }", "has no area");
    shape("triangle = { a = [0.0, 0.0, 0.0], b = [1.0, 0.0, 0.0], c = [2.0, 0.0, 0.0] }", "has no area");
    shape("triangle = { a = [0.0, 0.0, 0.0], b = [1.0, 0.0, 0.0], d = [2.0, 0.0, 0.0] }", "`d`");
}

#[test]
fn invalid_transforms_are_refused() {
    transform("{ scale = 0.0 }", "cannot be inverted");
    transform("{ scale = [1.0, 0.0, 1.0] }", "cannot be inverted");
    transform("{ scale = [1.0, 2.0] }", "expected a list of 3, found 2 values");
    transform("{ scale = nan }", "is not finite");
    transform("{ translate = [0.0, inf, 0.0] }", "is not finite");
    transform("{ rotate = { axis = [0.0, 0.0, 0.0], degrees = 3.0 } }", "has no direction");
    transform("{ matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]] }", "not affine");
    transform("{ matrix = [[1, 2, 3, 0], [2, 4, 6, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }", "cannot be inverted");
    transform("{ matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] }", "expected a list of 4, found 3 values");
    transform("{ scale = 1e11 }, { scale = 1e11 }", "after its transforms the sphere has a radius of");
    transform("{ spin = 1.0 }", "spin");
}

#[test]
fn transforms_apply_first_to_last() {
    let scene = with("transform = [ { translate = [1, 0, 0] }, { rotate = { axis = [0, 0, 2], degrees = 90 } }, { scale = 2 } ]");
    let (center, radius) = scene.objects[0].shape.bounding_sphere();
    assert!(center.distance(glam::DVec3::new(-2.0, 2.0, 0.0)) < 1e-12 && (radius - 2.0).abs() < 1e-12, "{center} {radius}");
    assert_eq!(scene.objects[0].shape.name(), "sphere");
    // The sheared axes have the length 1.
    let sheared = |x: f64| format!("matrix = [[1, {x:?}, 0, 0], [0, 0.8, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]");
    for change in ["scale = [1.0, 2.0, 1.0]".to_owned(), sheared(0.6), sheared(-0.6)] {
        let scene = with(&format!("transform = [ {{ {change} }} ]"));
        assert!(matches!(scene.objects[0].shape, Shape::Ellipsoid { .. }), "{change}");
    }
}

#[test]
fn invalid_meshes_are_refused() {
    shape("mesh = { path = \"no.ply\" }", "there is no such file");
    shape("mesh = { smooth = true }", "`mesh` has none of `path`, `vertices`, `knot`, `heightfield`");
    shape("mesh = { knot = { triangles = 100 }, path = \"a.ply\" }", "`path` and `knot` exclude each other");
    shape("mesh = { knot = { triangles = 4 } }", "expected a whole number from 18 to");
    shape("mesh = { heightfield = { quads = 0 } }", "expected a whole number from 1 to");
    shape("sphere_field = { count = 0, bounds = { min = [0, 0, 0], max = [1, 1, 1] } }", "expected a whole number from 1 to");
    shape("sphere_field = { count = 9, bounds = { min = [0, 0, 0], max = [1, -1, 1] } }", "the bounds are inverted");
    let lists = |vertices: &str, triangles: &str| format!("mesh = {{ vertices = [{vertices}], triangles = [{triangles}] }}");
    shape(&lists("[0, 0, 0], [1, 0, 0], [0, 1, 0]", ""), "the mesh is empty");
    shape(&lists("[0, 0, 0], [1, 0, 0], [0, 1, 0]", "[0, 1, 3]"), "there is no vertex 3");
    shape(&lists("[0, 0, nan], [1, 0, 0], [0, 1, 0]", "[0, 1, 2]"), "vertex 0 is not finite");
    shape(&lists("[0, 0, 0], [1, 0, 0], [0, 1, 0]", "[0, -1, 2]"), "-1");
}

#[test]
fn invalid_isosurfaces_are_refused() {
    let iso = |expression: &str, max: &str| {
        format!("isosurface = {{ expression = \"{expression}\", bounds = {{ min = [-1, -1, -1], max = [{max}] }} }}")
    };
    shape(&iso("x^2 + y^2 + w", "1, 1, 1"), "is not known");
    shape(&iso("x^2 + (y^2", "1, 1, 1"), ")");
    shape(&iso("", "1, 1, 1"), "empty");
    shape(&iso("x^2 + y^2 - 1", "1, -2, 1"), "inverted or empty in y");
    let text = GOOD.replacen(BALL, &iso("x^2 + y^2 + w", "1, 1, 1"), 1);
    let before = text.lines().nth(10).and_then(|line| line.find("w\"")).expect("the unknown name is there");
    assert_eq!(error(&text).line_column(), Some((11, before + 1)), "the name itself is pointed at");
    let report = error(&GOOD.replacen(BALL, &iso("x^2 + y^2 + www", "1, 1, 1"), 1)).report();
    let marks = report.lines().find(|line| line.contains('┬')).map(|line| line.chars().filter(|c| "─┬".contains(*c)).count());
    assert_eq!(marks, Some(3), "the whole name and nothing else: {report}");
}

#[test]
fn invalid_motions_are_refused() {
    let motion = |list: &str, message: &str| {
        refuses("material = \"white\"", &format!("material = \"white\"\nmotion = [ {list} ]"), message);
    };
    motion("{ scale = -1.0 }", "the motion cannot be inverted");
    motion("{ scale = 0.0 }", "cannot be inverted");
    motion("{ matrix = [[-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }", "the motion cannot be inverted");
    let steps = "material = \"white\"\nmotion = [\n{ translate = [1, 0, 0] },\n{ scale = -1.0 },\n]";
    let of_steps = error(&GOOD.replacen("material = \"white\"", steps, 1));
    assert_eq!(of_steps.line_column().map(|place| place.0), Some(15), "the last step: {}", of_steps.report());
    refuses("fov = 40", "fov = 40\nshutter = [1.0, 0.0]", "the earlier one first");
    refuses("fov = 40", "fov = 40\nshutter = [0.0, nan]", "two times");
}

#[test]
fn odd_but_legal_scenes_have_warnings() {
    let still = with("motion = [{ translate = [1, 0, 0] }]");
    assert!(still.warnings().iter().any(|warning| warning.contains("shutter")), "{:?}", still.warnings());
    let flat = GOOD.replacen(
        BALL,
        "mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]], triangles = [[0, 1, 2], [0, 1, 3]] }",
        1,
    );
    let scene = parse("test.toml", flat).unwrap_or_else(|error| panic!("{}", error.report()));
    assert_eq!(scene.shapes.dropped_triangles(), 1);
    assert!(scene.warnings().iter().any(|warning| warning.contains("1 triangles without area")), "{:?}", scene.warnings());
}
