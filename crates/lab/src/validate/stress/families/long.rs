//! Rooms that absorb little or nothing.
use glam::DVec3;

use super::{
    Family,
    rooms::{closed, sphere},
};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Expected, Furnace, TrialScene, camera_at},
};

pub const FAMILIES: [Family; 3] = [
    Family { name: "white-rooms", what: "white rooms, up to 10⁵ bounces", scenes: 32, trial_scene: white_rooms },
    Family { name: "mirror-rooms", what: "rooms of perfect mirrors, up to 10⁵ bounces", scenes: 32, trial_scene: mirror_rooms },
    Family {
        name: "glass-rooms",
        what: "rooms of albedo 1 − 2⁻⁷ with clear balls, 10⁴ bounces",
        scenes: 16,
        trial_scene: glass_rooms,
    },
];

fn room(dice: &mut Dice, material: &'static str) -> TrialScene {
    let cap = dice.pick(&[10, 100, 1000, 10_000, 100_000, 100_000, 100_000, 100_000]);
    let size = dice.decade(-6.0, 9.0);
    let center = dice.in_ball() * size;
    let mut room = Furnace::of(1.0, cap);
    room.material = material;
    room.wall(&closed(dice, center, size));
    let eye = center - dice.in_ball() * size * 0.1;
    let camera = few_pixels(&camera_at(dice, eye, size));
    TrialScene { spp: 1, ..room.trial_scene(dice, &camera, size) }
}

/// A small resolution, because paths are long.
fn few_pixels(camera: &str) -> String {
    camera.replace("[32, 32]", "[8, 8]")
}

fn white_rooms(dice: &mut Dice) -> TrialScene {
    room(dice, "grey")
}

fn mirror_rooms(dice: &mut Dice) -> TrialScene {
    room(dice, "mirror")
}

fn glass_rooms(dice: &mut Dice) -> TrialScene {
    let mut room = Furnace::of(1.0 - 1.0 / 128.0, 10_000);
    room.wall(&closed(dice, DVec3::ZERO, 1.0));
    for i in 0..3 {
        let ior = dice.pick(&[1.000_001, 1.5, 2.4]);
        let place = DVec3::from_array(std::array::from_fn(|axis| if axis == i { 0.3 } else { 0.0 }));
        room.lossless(&format!("glass{i}"), &format!("dielectric = {{ ior = {ior:?} }}"), &sphere(place, 0.15));
    }
    let eye = dice.in_ball() * 0.1;
    let camera = few_pixels(&camera_at(dice, eye, 1.0));
    // The cap is far beyond the last reflection that counts, including the bounces in glass.
    TrialScene { expected: Expected::Everywhere(128.0), spp: 4, ..room.trial_scene(dice, &camera, 1.0) }
}
