//! Details near the limit of single precision.
use glam::DVec3;

use super::{
    Family,
    contact::along_a_floor,
    rooms::{closed, ellipsoid, sphere},
};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Expected, Furnace, TrialScene, camera_at, camera_towards},
};

pub const FAMILIES: [Family; 4] = [
    Family { name: "heaps", what: "overlapping balls of 10⁻⁶ to 10⁻² m", scenes: 60, trial_scene: heaps },
    Family { name: "small-far", what: "rooms of 30 to 10⁵ m, 10⁷ m from the origin", scenes: 60, trial_scene: small_far },
    Family { name: "creases", what: "views along a floor under slanting walls", scenes: 60, trial_scene: creases },
    Family {
        name: "flakes", what: "ellipsoids 3 · 10⁻⁶ to 10⁻² times as thick as long", scenes: 60, trial_scene: flakes
    },
];

/// Allows a loss of ten times the last digit of the coordinates over the size of the detail.
fn lossy(trial_scene: TrialScene, coordinates: f64, detail: f64) -> TrialScene {
    let Expected::Everywhere(radiance) = trial_scene.expected else { return trial_scene };
    let digit = f64::from(f32::EPSILON) * coordinates / detail;
    TrialScene { expected: Expected::Within { radiance, loss: 10.0 * digit }, size: digit, ..trial_scene }
}

fn heaps(dice: &mut Dice) -> TrialScene {
    let radius = dice.decade(-6.0, -2.0);
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, DVec3::ZERO, 1.0));
    let middle = dice.in_ball() * 0.2;
    for _ in 0..12 {
        let size = radius * dice.within(0.3, 1.0);
        room.body(&sphere(middle + dice.direction() * radius * dice.within(0.0, 3.0), size));
    }
    let eye = middle + dice.direction() * radius * dice.within(5.0, 20.0);
    let camera = camera_towards(dice, eye, middle);
    lossy(room.trial_scene(dice, &camera, radius), 0.3, 0.3 * radius)
}

fn small_far(dice: &mut Dice) -> TrialScene {
    let size = dice.decade(1.5, 5.0);
    let center = dice.direction() * 1e7;
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, center, size));
    let eye = center + dice.in_ball() * size * 0.3;
    let camera = camera_at(dice, eye, size);
    lossy(room.trial_scene(dice, &camera, size), 1e7, size)
}

fn creases(dice: &mut Dice) -> TrialScene {
    let walls = closed(dice, DVec3::ZERO, 10.0);
    let (trial_scene, height) = along_a_floor(dice, &walls);
    lossy(trial_scene, 20.0, height)
}

fn flakes(dice: &mut Dice) -> TrialScene {
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, DVec3::ZERO, 1.0));
    let thickness = dice.decade(-5.5, -2.0) * 0.25;
    for _ in 0..6 {
        let place = dice.in_ball() * 0.1;
        room.body(&ellipsoid(dice, place, DVec3::new(thickness, 0.25, 0.17)));
    }
    let eye = dice.direction() * 0.49;
    let camera = camera_towards(dice, eye, DVec3::ZERO);
    lossy(room.trial_scene(dice, &camera, thickness), 1.0, thickness)
}
