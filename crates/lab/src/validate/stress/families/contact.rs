//! Touching surfaces, thin shapes, grazing rays.
use glam::DVec3;

use super::{
    Family,
    rooms::{closed, cuboid, ellipsoid, sphere},
};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Furnace, TrialScene, camera_at, camera_towards, v},
};

pub const FAMILIES: [Family; 3] = [
    Family { name: "coincident", what: "boxes and balls that touch or nearly do", scenes: 120, trial_scene: coincident },
    Family {
        name: "slivers",
        what: "needles, thin boxes and slivers, 10⁻⁷ to 10⁻² as thick as long",
        scenes: 120,
        trial_scene: slivers,
    },
    Family { name: "grazing", what: "views along floors from 10⁻⁶ m above", scenes: 80, trial_scene: grazing },
];

/// A pile of boxes on a floor with a ball on top. The gaps between them are 0, as small as rounding, or small, and may be
/// negative.
fn coincident(dice: &mut Dice) -> TrialScene {
    let size = dice.decade(-2.0, 3.0);
    let mut room = Furnace::new(dice);
    room.wall(&format!("shape.cuboid = {{ min = {}, max = {} }}", v(DVec3::splat(-size)), v(DVec3::splat(size))));
    let mut height = -size;
    let gap = |dice: &mut Dice| size * dice.pick(&[0.0, 0.0, 1.0, -1.0]) * dice.decade(-12.0, -3.0);
    for _ in 0..4 {
        let bottom = height + gap(dice);
        height = bottom + size * dice.within(0.05, 0.25);
        let half = size * dice.within(0.1, 0.6);
        // Some boxes end exactly at the walls.
        let west = if dice.chance(0.3) { -size } else { -half };
        let (min, max) = (DVec3::new(west, bottom, -half), DVec3::new(half, height, half));
        room.body(&format!("shape.cuboid = {{ min = {}, max = {} }}", v(min), v(max)));
    }
    // Two identical surfaces, seen from both sides.
    let sheet = format!(
        "shape.rectangle = {{ origin = {}, edge_u = {}, edge_v = {} }}",
        v(DVec3::new(0.7, -0.5, -0.5) * size),
        v(DVec3::new(0.0, size, 0.0)),
        v(DVec3::new(0.0, 0.0, size))
    );
    room.sheet(&sheet);
    room.sheet(&sheet);
    let radius = size * 0.1;
    room.body(&sphere(DVec3::new(0.0, height + radius + gap(dice), 0.0), radius));
    let eye = DVec3::new(dice.within(-0.9, 0.6), 0.8, dice.within(-0.9, 0.9)) * size;
    let camera = camera_at(dice, eye, size);
    room.trial_scene(dice, &camera, size)
}

fn slivers(dice: &mut Dice) -> TrialScene {
    let size = dice.decade(-2.0, 3.0);
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, DVec3::ZERO, size));
    for _ in 0..6 {
        sliver(dice, &mut room, size);
    }
    let eye = dice.direction() * size * 0.49;
    let middle = dice.in_ball() * size * 0.1;
    let camera = camera_towards(dice, eye, middle);
    room.trial_scene(dice, &camera, size)
}

/// Adds a thin shape within 0.4 of the centre.
fn sliver(dice: &mut Dice, room: &mut Furnace, size: f64) {
    let (length, middle) = (0.25 * size, dice.in_ball() * 0.1 * size);
    let thickness = length * dice.decade(-7.0, -2.0);
    let (along, across) = {
        let along = dice.direction();
        (along, along.any_orthonormal_vector())
    };
    match dice.below(6) {
        0 => {
            let (a, b) = (middle - along * length, middle + along * length);
            let c = middle + along * length * dice.within(-1.0, 1.0) + across * thickness;
            room.sheet(&format!("shape.triangle = {{ a = {}, b = {}, c = {} }}", v(a), v(b), v(c)));
        }
        1 => room.body(&cuboid(dice, middle, DVec3::new(thickness, length, length * 0.7))),
        2 => room.body(&ellipsoid(dice, middle, DVec3::new(thickness, thickness, length))),
        3 => {
            let (base, top) = (middle - along * length, middle + along * length);
            let capped = "capped = true";
            room.body(&format!("shape.cylinder = {{ base = {}, top = {}, radius = {thickness:?}, {capped} }}", v(base), v(top)));
        }
        4 => {
            let edges = [v(along * 2.0 * length), v(across * thickness)];
            let origin = v(middle - along * length);
            room.sheet(&format!("shape.rectangle = {{ origin = {origin}, edge_u = {}, edge_v = {} }}", edges[0], edges[1]));
        }
        _ => {
            let corners =
                [middle - along * length, middle + along * length, middle + across * thickness, middle - across * thickness];
            let [a, b, c, d] = corners.map(v);
            room.sheet(&format!("shape.mesh = {{ vertices = [{a}, {b}, {c}, {d}], triangles = [[0, 1, 2], [1, 0, 3]] }}"));
        }
    }
}

/// A grazing view of a floor that is flat or part of a large ball, with balls half sunk into it.
fn grazing(dice: &mut Dice) -> TrialScene {
    // The walls are perpendicular to the floor. Another family tests acute angles.
    along_a_floor(dice, "shape.cuboid = { min = [-10.0, -10.0, -10.0], max = [10.0, 10.0, 10.0] }").0
}

/// A grazing view of a floor between walls, and the height of the camera.
pub fn along_a_floor(dice: &mut Dice, walls: &str) -> (TrialScene, f64) {
    let mut room = Furnace::new(dice);
    room.wall(walls);
    let radius = dice.decade(4.0, 9.0);
    match dice.below(3) {
        0 => room.body("shape.cuboid = { min = [-20.0, -1.0, -20.0], max = [20.0, 0.0, 20.0] }"),
        1 => room.body(&sphere(DVec3::new(0.0, -radius, 0.0), radius)),
        _ => {
            room.sheet(
                "shape.rectangle = { origin = [-20.0, 0.0, -20.0], edge_u = [0.0, 0.0, 40.0], edge_v = [40.0, 0.0, 0.0] }",
            );
        }
    }
    for _ in 0..5 {
        let place = DVec3::new(dice.within(0.2, 2.0), 0.0, dice.within(-0.3, 0.3));
        room.body(&sphere(place, dice.decade(-4.0, -1.0)));
    }
    let height = dice.decade(-6.0, -1.0);
    let down = height * dice.within(-1.0, 2.0);
    let camera = format!(
        "eye = [0.0, {height:?}, 0.0], look_at = [1.0, {:?}, 0.0], fov = {:?}, resolution = [32, 32]",
        height - down,
        dice.pick(&[0.01, 1.0, 30.0, 120.0])
    );
    (room.trial_scene(dice, &camera, height), height)
}
