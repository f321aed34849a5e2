//! Materials at the limits of their parameters, and all estimators.
use glam::DVec3;

use super::{Family, rooms::sphere};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Expected, Furnace, TrialScene, camera_at, camera_towards},
};
use noisefall_kernel::measure::exact::furnace;
use noisefall_scene::{sampling::Directions, scene::Estimator};

pub const FAMILIES: [Family; 4] = [
    Family { name: "glass", what: "clear balls within balls, indices from 1 + 10⁻⁶ to 2.4", scenes: 60, trial_scene: glass },
    Family { name: "rough", what: "lossless rough balls, α from 10⁻⁴ to 1", scenes: 84, trial_scene: rough },
    Family { name: "estimators", what: "estimators, samplers, directions, roulettes", scenes: 90, trial_scene: estimators },
    Family { name: "bright", what: "lights of 10⁻⁹ and 10⁹ seen by all estimators", scenes: 60, trial_scene: bright },
];

const INDICES: [f64; 6] = [1.0, 1.000_001, 1.0003, 1.333, 1.5, 2.4];

/// A spherical room, and a camera in it that looks at a point near its centre.
fn room(dice: &mut Dice) -> (Furnace, String) {
    let mut room = Furnace::of(0.5, 60);
    room.wall(&sphere(DVec3::ZERO, 1.0));
    let eye = dice.direction() * dice.within(0.6, 0.9);
    let middle = dice.in_ball() * 0.2;
    let camera = camera_towards(dice, eye, middle);
    (room, camera)
}

fn glass(dice: &mut Dice) -> TrialScene {
    let (mut room, camera) = room(dice);
    // From the outermost to the innermost ball; each states the index on both sides.
    let (mut outside, mut radius) = (1.0, 0.5);
    for i in 0..1 + dice.below(3) {
        let ior = dice.pick(&INDICES);
        room.lossless(
            &format!("glass{i}"),
            &format!("dielectric = {{ ior = {ior:?}, ior_outside = {outside:?} }}"),
            &sphere(DVec3::ZERO, radius),
        );
        (outside, radius) = (ior, radius * dice.within(0.3, 0.9999));
    }
    // Bounces in glass count towards the cap, so the sum is known only without a cap.
    uncapped(&room.trial_scene(dice, &camera, 1.0), furnace(1.0, 0.5))
}

/// Removes the cap from a scene, and sets its exact value.
fn uncapped(trial_scene: &TrialScene, exact: f64) -> TrialScene {
    let text = trial_scene.text.replace("max_bounces = 60, ", "");
    TrialScene { size: trial_scene.size, ..TrialScene::of(text, Expected::Everywhere(exact)) }
}

fn rough(dice: &mut Dice) -> TrialScene {
    let (mut room, camera) = room(dice);
    let (alpha, ior) = (dice.pick(&[1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 1.0]), dice.pick(&INDICES));
    let material = match dice.below(4) {
        0 => format!("conductor = {{ f0 = 1.0, alpha = {alpha:?} }}"),
        1 => format!("conductor = {{ reflectance = 1.0, alpha = {alpha:?} }}"),
        2 => format!("plastic = {{ albedo = 1.0, ior = {ior:?}, alpha = {alpha:?} }}"),
        _ => format!("dielectric = {{ ior = {ior:?}, alpha = {alpha:?} }}"),
    };
    room.lossless("rough", &material, &sphere(DVec3::ZERO, 0.5));
    let trial_scene = uncapped(&room.trial_scene(dice, &camera, 1.0), furnace(1.0, 0.5));
    TrialScene { expected: Expected::Mean(furnace(1.0, 0.5)), spp: 64, ..trial_scene }
}

/// A furnace with a grey ball and random unbiased settings.
fn estimators(dice: &mut Dice) -> TrialScene {
    let (mut room, camera) = room(dice);
    room.body(&sphere(DVec3::ZERO, 0.4));
    let trial_scene = uncapped(&room.trial_scene(dice, &camera, 1.0), furnace(1.0, 0.5));
    let text = trial_scene
        .text
        .replace("'path'", &format!("'{}'", dice.pick(&Estimator::ALL).name()))
        .replace("'cosine'", &format!("'{}'", dice.pick(&Directions::ALL).name()))
        .replace(
            "'off'",
            dice.pick(&["'off'", "'throughput'", "{ fixed = 0.5 }", "{ fixed = 0.95 }", "{ throughput = { start = 1 } }"]),
        );
    TrialScene { text, expected: Expected::Mean(furnace(1.0, 0.5)), spp: 64, ..trial_scene }
}

/// One reflection off a grey ball under lights of extreme radiance, high or low.
fn bright(dice: &mut Dice) -> TrialScene {
    let light = |dice: &mut Dice| {
        let (place, radius) = (dice.direction() * dice.within(2.0, 9.0), dice.decade(-4.0, -0.5));
        let radiance = dice.pick(&[1e-9, 1.0, 1e9]);
        format!("[[objects]]\n{}\nemission.radiance = {radiance:?}\n", sphere(place, radius))
    };
    let lights: String = (0..1 + dice.below(5)).map(|_| light(dice)).collect();
    let eye = dice.direction() * 3.0;
    let camera = camera_at(dice, eye, 3.0);
    let estimator = dice.pick(&Estimator::ALL).name();
    let text = format!(
        "camera = {{ {camera} }}\nrender.estimator = '{estimator}'\nenvironment.radiance = {:?}\n\
         materials.grey.lambertian.albedo = 0.9\nmaterials.gold.conductor = {{ f0 = [1.0, 0.8, 0.3], alpha = {:?} }}\n\
         [[objects]]\n{}\nmaterial = '{}'\n{lights}",
        dice.pick(&[0.0, 1e-9, 1e9]),
        dice.decade(-4.0, 0.0),
        sphere(DVec3::ZERO, 1.0),
        dice.pick(&["grey", "gold"]),
    );
    TrialScene::of(text, Expected::Valid)
}
