//! Surfaces that stop a camera, and surfaces that do not.
use std::path::Path;

use super::*;
use noisefall_scene::scene::{built_in, load, parse};

fn shipped(name: &str) -> Scene {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(format!("{name}.toml"))).expect("it is shipped")
}

/// A scene of these objects, whose size is 4 m: the distance that the camera looks over.
fn scene(objects: &[String]) -> Scene {
    let text = format!(
        "format = 1\n[camera]\neye = [0.0, 0.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 40.0\nresolution = [8, 8]\n\
         [materials.white]\nlambertian = {{ albedo = 0.8 }}\n[materials.glass]\ndielectric = {{ ior = 1.5 }}\n{}",
        objects.join("\n")
    );
    parse("scene.toml", text).expect("it is a scene")
}

fn object(shape: &str, rest: &str) -> String {
    format!("[[objects]]\nshape = {{ {shape} }}\n{rest}")
}

/// A sky is the inside of a sphere of 100 m that emits.
fn sky() -> String {
    object("sphere = { center = [0.0, 0.0, 0.0], radius = 100.0 }", "flip = true\nemission = { radiance = 1.0 }")
}

const WHITE: &str = "material = \"white\"";
const BALL: &str = "sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 }";
/// At x = ±1, as high and wide as the sky.
const WALL: &str = "cuboid = { min = [1.0, -50.0, -50.0], max = [1.2, 50.0, 50.0] }";

/// Distance in metres that a camera moves from one position towards another.
fn way(scene: &Scene, from: [f64; 3], to: [f64; 3]) -> f64 {
    let [from, to] = [from, to].map(DVec3::from);
    clear_fraction(scene, from, to) * from.distance(to)
}

#[test]
fn a_camera_stops_just_before_every_wall_of_the_built_in_scene() {
    let scene = built_in();
    let margin = 1e-3 * scene.size;
    // Walls are spheres of 1000 m: at 3.7 m from their middle they are 3.7² / 2000 m farther away.
    let bulge = 1000.0 - (1000.0f64.powi(2) - 3.7f64.powi(2)).sqrt();
    for (to, wall) in [([-3.0, 1.0, 3.7], 1.0 + bulge), ([3.0, 1.0, 3.7], 1.0 + bulge), ([0.0, -9.0, 3.7], 1.0 + bulge)] {
        let stop = way(&scene, [0.0, 1.0, 3.7], to);
        assert!((stop - (wall - margin)).abs() < 1e-5, "{to:?}: {stop}");
    }
    // The way into the room and to its back wall, between the balls and below the light.
    assert!((way(&scene, [0.0, 1.0, 3.7], [0.0, 1.0, -5.0]) - (4.7 - margin)).abs() < 1e-5);
    assert_eq!(way(&scene, [0.0, 1.0, 3.7], [0.0, 1.0, -0.99]), 4.69, "up to there nothing is in the way");
    let near = way(&scene, [0.0, 1.0, 3.7], [0.0, 1.0, -0.998]);
    assert!(near < 4.697, "a move that would end nearer than the margin is stopped too: {near}");
    assert_eq!(way(&scene, [0.0, 1.0, -0.998], [0.0, 1.0, -1.5]), 0.0, "and one that begins there");
    assert_eq!(way(&scene, [0.0, 1.0, -0.998], [0.0, 1.0, 2.0]), 2.998, "but not away from the wall");
}

#[test]
fn light_from_any_one_direction_is_seen_and_none_where_there_is_none() {
    // A black box, one face of which emits inwards.
    let cube = "cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }";
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut center = [0.0; 3];
            center[axis] = 0.99 * side;
            let normal = center.map(|x| -x);
            let light = format!("disk = {{ center = {center:?}, normal = {normal:?}, radius = 0.3 }}");
            let scene = scene(&[object(cube, ""), object(&light, "emission = { radiance = 1.0 }")]);
            assert!(!is_blind(&scene, DVec3::ZERO), "{center:?}");
            assert!(is_blind(&scene, DVec3::splat(2.0)), "outside");
        }
    }
    assert!(is_blind(&shipped("inside_lit_outside"), DVec3::ZERO));
    for lit in ["tiny_lamp", "lamp_behind_glass", "room_window", "nested_glass", "inside_lit_inside", "truncation"] {
        let scene = shipped(lit);
        assert!(!is_blind(&scene, scene.camera.eye), "{lit}");
    }
}

#[test]
fn a_closed_room_is_entered_if_it_is_lit_and_left_if_there_is_light_outside() {
    let furnace = shipped("furnace");
    let [inside, outside] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    assert_eq!(way(&furnace, outside, inside), 3.0);
    let stop = way(&furnace, inside, outside);
    assert!((stop - (1.0 - 1e-3 * furnace.size)).abs() < 1e-5, "outside is nothing: {stop}");
    // A sheet between two lit halves of the world is no obstacle; a black ball is one.
    let sheet = "rectangle = { origin = [1.0, -50.0, -50.0], edge_u = [0.0, 100.0, 0.0], edge_v = [0.0, 0.0, 100.0] }";
    assert_eq!(way(&scene(&[sky(), object(sheet, WHITE)]), inside, outside), 3.0);
    let stop = way(&scene(&[sky(), object(BALL, "")]), outside, [-3.0, 0.0, 0.0]);
    assert!((stop - 2.496).abs() < 1e-5, "there is light behind it, but not within: {stop}");
}

#[test]
fn a_pane_and_a_door_are_passed_and_the_wall_beside_them_is_not() {
    let [left, right] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let pane = object(WALL, "material = \"glass\"");
    assert_eq!(way(&scene(&[sky(), pane.clone()]), left, right), 3.0);
    let solid = scene(&[sky(), object(WALL, WHITE)]);
    assert!((way(&solid, left, right) - 0.996).abs() < 1e-5);
    // A surface behind a pane stops too, and so does a wall thinner than the margin.
    let behind = object("cuboid = { min = [2.0, -50.0, -50.0], max = [2.001, 50.0, 50.0] }", WHITE);
    assert!((way(&scene(&[sky(), pane, behind]), left, right) - 1.996).abs() < 1e-5);
    let door =
        |from: &str, to: &str| object(&format!("cuboid = {{ min = [1.0, {from}, -50.0], max = [1.2, {to}, 50.0] }}"), WHITE);
    let door = scene(&[sky(), door("-50.0", "-0.1"), door("0.1", "50.0")]);
    assert_eq!(way(&door, left, right), 3.0);
    assert!(way(&door, [0.0, 0.2, 0.0], [3.0, 0.2, 0.0]) < 1.0);
}

#[test]
fn a_camera_in_the_dark_gets_out_and_one_in_the_open_goes_round() {
    let scene = scene(&[sky(), object(BALL, WHITE)]);
    assert_eq!(way(&scene, [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]), 2.0);
    assert_eq!(way(&scene, [0.0, 0.0, 0.0], [0.0, 0.0, 0.2]), 0.2);
    // Out of one dark place into another: both are as good.
    let nested = self::scene(&[sky(), object(BALL, WHITE), object(&BALL.replace("0.5", "0.25"), WHITE)]);
    assert_eq!(way(&nested, [0.0, 0.0, 0.375], [0.0, 0.0, 0.0]), 0.375);
    assert_eq!(way(&scene, [0.51, 0.0, 2.0], [0.51, 0.0, -2.0]), 4.0, "past the ball");
    assert_eq!(way(&scene, [0.0, 0.0, 2.0], [0.0, 0.0, 2.0]), 0.0, "no way at all");
    assert_eq!(clear_fraction(&scene, DVec3::Z, DVec3::Z), 1.0);
}

#[test]
fn a_ball_is_left_aslant_no_farther_than_its_wall() {
    let furnace = shipped("furnace");
    // At a height of 0.6 the wall of the unit sphere is 0.8 away.
    let stop = way(&furnace, [0.0, 0.6, 0.0], [3.0, 0.6, 0.0]);
    assert!((stop - (0.8 - 1e-3 * furnace.size)).abs() < 1e-5, "{stop}");
}
