//! Rooms that let no light in: along edges and in corners, where walls meet, rounding must open no gap.
//!
//! Walls that are objects of their own are no closed shape: between two of them a ray may find a crack as wide as rounding.
use noisefall_scene::scene::{Estimator, RenderSettings};

use crate::picture::{RED, picture, scene, settings};

/// The room from (−1, −1, −1) to (1, 1, 1) as a mesh and as a cuboid.
fn rooms() -> [(&'static str, String); 2] {
    let object = |shape: String| format!("[[objects]]\nshape.{shape}\nmaterial = 'wall'\n{TURN}\n");
    let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| 2.0 * bit as f64 - 1.0);
    // By corners whose bits are coordinates, in order around each wall.
    let walls = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[usize; 3]> = walls.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
    [
        ("mesh", object(format!("mesh = {{ vertices = {vertices:?}, triangles = {triangles:?}, smooth = false }}"))),
        ("cuboid", object("cuboid = { min = [-1, -1, -1], max = [1, 1, 1] }".to_owned())),
    ]
}

const TURN: &str = "transform = [{ rotate = { axis = [1, 2, 3], degrees = 33 } }, { translate = [0.1, 10.3, -7.7] }]";

/// Where [`TURN`] takes a point.
fn turned(p: [f64; 3]) -> [f64; 3] {
    let axis = [1.0, 2.0, 3.0].map(|x: f64| x / 14f64.sqrt());
    let (sin, cos) = 33f64.to_radians().sin_cos();
    let along = (0..3).map(|i| axis[i] * p[i]).sum::<f64>() * (1.0 - cos);
    let cross = |i: usize| axis[(i + 1) % 3] * p[(i + 2) % 3] - axis[(i + 2) % 3] * p[(i + 1) % 3];
    [0.1, 10.3, -7.7]
        .iter()
        .enumerate()
        .map(|(i, by)| p[i] * cos + cross(i) * sin + axis[i] * along + by)
        .collect::<Vec<_>>()
        .try_into()
        .expect("three")
}

/// The camera sees so little around the corner or the edge that one sample in some hundred is within rounding of a wall.
#[test]
fn no_light_enters_a_closed_room_at_its_edges() {
    for (name, room) in rooms() {
        for (what, target) in [("corner", [1.0; 3]), ("edge", [1.0, 1.0, 0.2])] {
            let scene = scene(&format!(
                "camera = {{ eye = {:?}, look_at = {:?}, fov = 0.01, resolution = [32, 32] }}\nenvironment.radiance = 1e6\n\
                 materials.wall.lambertian.albedo = 0.8\n{room}",
                turned([-0.3, -0.2, 0.1]),
                turned(target)
            ));
            for estimator in [Estimator::Path, Estimator::Mis] {
                let settings = RenderSettings { max_bounces: Some(4), ..settings(estimator) };
                let found = picture(&scene, settings, RED, 64).whole().mean;
                assert!(found == 0.0, "{name}, {what}, {}: {found} of a sky of a million", estimator.name());
            }
        }
    }
}
