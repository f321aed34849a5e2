//! Rooms of all sizes, and rooms far from the origin.
use glam::DVec3;

use super::{
    Family,
    rooms::{closed, sphere},
};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Furnace, TrialScene, camera_at, camera_towards},
};

pub const FAMILIES: [Family; 5] = [
    Family { name: "spheres", what: "spherical rooms of radius 10⁻⁶ to 10⁹ m", scenes: 120, trial_scene: spheres },
    Family { name: "rooms", what: "rooms of seven shapes, 10⁻⁶ to 10⁹ m", scenes: 140, trial_scene: rooms },
    Family { name: "far", what: "rooms of 10⁵ to 10⁷ m, 10⁷ m from the origin", scenes: 80, trial_scene: far },
    Family {
        name: "sphere-walls",
        what: "rooms between six spheres of radius 10² to 10⁹ m",
        scenes: 40,
        trial_scene: sphere_walls,
    },
    Family { name: "balls", what: "balls of radius 10⁻⁶ to 10⁻² m in a room of a metre", scenes: 60, trial_scene: balls },
];

fn spheres(dice: &mut Dice) -> TrialScene {
    let radius = dice.decade(-6.0, 9.0);
    // The origin is at the centre or on the wall.
    let center = if dice.chance(0.5) { DVec3::ZERO } else { dice.direction() * radius };
    let mut room = Furnace::new(dice);
    room.wall(&sphere(center, radius));
    let eye = center + dice.in_ball() * radius * dice.pick(&[0.5, 0.99, 0.9999]);
    let camera = camera_at(dice, eye, radius);
    room.trial_scene(dice, &camera, radius)
}

fn rooms(dice: &mut Dice) -> TrialScene {
    let size = dice.decade(-6.0, 9.0);
    let center = dice.in_ball() * size * dice.pick(&[0.0, 1.0, 3.0]);
    room_at(dice, center, size)
}

fn far(dice: &mut Dice) -> TrialScene {
    let size = dice.decade(5.0, 7.0);
    let center = dice.direction() * 1e7;
    room_at(dice, center, size)
}

/// A room with a ball in it.
fn room_at(dice: &mut Dice, center: DVec3, size: f64) -> TrialScene {
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, center, size));
    room.body(&sphere(center + dice.direction() * size * 0.25, size * 0.1));
    let eye = center - dice.in_ball() * size * 0.1;
    let camera = camera_at(dice, eye, size);
    room.trial_scene(dice, &camera, size)
}

fn sphere_walls(dice: &mut Dice) -> TrialScene {
    let radius = dice.decade(2.0, 9.0);
    let mut room = Furnace::new(dice);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        room.body(&sphere(axis * (radius + 1.0), radius));
        room.body(&sphere(-axis * (radius + 1.0), radius));
    }
    let camera = camera_at_middle(dice);
    room.trial_scene(dice, &camera, radius)
}

fn camera_at_middle(dice: &mut Dice) -> String {
    let eye = dice.in_ball() * 0.8;
    camera_at(dice, eye, 1.0)
}

fn balls(dice: &mut Dice) -> TrialScene {
    let radius = dice.decade(-6.0, -2.0);
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, DVec3::ZERO, 1.0));
    let middle = dice.in_ball() * 0.2;
    // A loose heap.
    for i in 0..27 {
        let place = DVec3::from_array([i % 3, i / 3 % 3, i / 9].map(|n| f64::from(n) - 1.0)) * 3.0;
        room.body(&sphere(middle + place * radius, radius * dice.within(0.1, 1.0)));
    }
    let eye = middle + dice.direction() * radius * dice.within(8.0, 20.0);
    let camera = camera_towards(dice, eye, middle);
    room.trial_scene(dice, &camera, radius)
}
