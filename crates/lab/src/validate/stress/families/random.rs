//! Random scenes of all features.
use glam::DVec3;

use super::{Family, drawn, rooms::closed};
use crate::validate::stress::{
    dice::Dice,
    trial_scene::{Expected, Furnace, TrialScene, camera_at, camera_towards, v},
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::Estimator,
};

pub const FAMILIES: [Family; 3] = [
    Family { name: "moving", what: "rooms in which bodies and camera move, seen by a lens", scenes: 60, trial_scene: moving },
    Family { name: "anything", what: "shapes, materials, lights, cameras, settings", scenes: 300, trial_scene: anything },
    Family {
        name: "declared",
        what: "every material and setting anywhere in its range, on shapes of all kinds",
        scenes: 200,
        trial_scene: declared,
    },
];

const TEXTURES: &str = "textures.fine.noise = { scale = 40.0, octaves = 6, low = 0.0, high = 1.0 }\n\
                        textures.squares.checker = { even = 0.9, odd = { texture = 'fine' }, scale = 1e4 }\n";

/// A furnace with moving bodies and a moving camera.
fn moving(dice: &mut Dice) -> TrialScene {
    let mut room = Furnace::new(dice);
    room.wall(&closed(dice, DVec3::ZERO, 10.0));
    for _ in 0..3 {
        let (place, size) = (dice.in_ball(), dice.decade(-2.0, -0.3));
        room.body(&format!("{}\nmotion = [{}, {}]", closed(dice, place, size), motion(dice), motion(dice)));
    }
    // The camera stays outside all positions of the bodies.
    let eye = dice.direction() * 4.9;
    let turn = format!("{{ rotate = {{ axis = {}, degrees = 20.0 }} }}", v(dice.direction()));
    let optics = format!("lens = {{ radius = {:?}, focus = 4.0 }}, filter = 'tent'", dice.decade(-4.0, -1.5));
    let camera = format!("{}, {optics}, shutter = [0.0, 1.0], motion = [{turn}]", camera_towards(dice, eye, DVec3::ZERO));
    room.trial_scene(dice, &camera, 1.0)
}

pub fn anything(dice: &mut Dice) -> TrialScene {
    let mut materials = String::new();
    for i in 0..4 {
        materials += &format!("materials.m{i}.{}\n", material(dice));
        if dice.chance(0.2) {
            materials += &format!("materials.m{i}.bump = {{ texture = 'fine', height = {:?} }}\n", dice.decade(-6.0, 1.0));
        }
    }
    let objects: String = (0..1 + dice.below(10)).map(|_| object(dice, shape, "m", 4)).collect();
    let environment = dice.pick(&[
        "",
        "environment.radiance = 1e-9\n",
        "environment.radiance = [0.0, 1e9, 1.0]\n",
        "environment.radiance = 1.0\n",
    ]);
    let text = format!(
        "camera = {{ {} }}\nrender = {{ {} }}\n{environment}{TEXTURES}{materials}{objects}",
        camera(dice),
        settings(dice)
    );
    TrialScene { spp: 4, ..TrialScene::of(text, Expected::Valid) }
}

/// Materials, shapes and settings as their declarations draw them.
fn declared(dice: &mut Dice) -> TrialScene {
    let materials = drawn::materials(dice, ["kind0", "kind1"]);
    let count = materials.len();
    let materials: String =
        materials.into_iter().enumerate().map(|(place, drawn)| format!("materials.kind{place} = {drawn}\n")).collect();
    let settings = drawn::settings(dice);
    let objects: String = (0..1 + dice.below(8)).map(|_| object(dice, drawn::shape, "kind", count)).collect();
    let text = format!(
        "camera = {{ {} }}\nrender = {settings}\nenvironment.radiance = 1.0\n{TEXTURES}{materials}{objects}",
        camera(dice)
    );
    TrialScene { spp: 4, ..TrialScene::of(text, Expected::Valid) }
}

fn camera(dice: &mut Dice) -> String {
    let eye = dice.in_ball() * 4.0;
    let mut camera = camera_at(dice, eye, 4.0);
    if dice.chance(0.3) {
        camera += &format!(", lens = {{ radius = {:?}, focus = {:?} }}", dice.decade(-6.0, 1.0), dice.decade(-3.0, 3.0));
    }
    if dice.chance(0.3) {
        camera += dice.pick(&[", filter = 'gaussian'", ", filter = 'tent'", ", filter = { gaussian = { sigma = 8.0 } }"]);
    }
    if dice.chance(0.4) {
        camera += ", shutter = [0.0, 1.0]";
    }
    if dice.chance(0.2) {
        camera += &format!(", motion = [{}]", motion(dice));
    }
    camera
}

fn motion(dice: &mut Dice) -> String {
    let axis = v(dice.direction());
    match dice.below(3) {
        0 => format!("{{ translate = {} }}", v(dice.in_ball())),
        1 => format!("{{ rotate = {{ axis = {axis}, degrees = {:?} }} }}", dice.within(-90.0, 90.0)),
        _ => format!("{{ scale = {:?} }}", dice.decade(-0.5, 0.5)),
    }
}

fn settings(dice: &mut Dice) -> String {
    let estimator = dice.pick(&Estimator::ALL).name();
    let sampler = dice.pick(&Sampler::ALL).name();
    let directions = dice.pick(&Directions::ALL).name();
    let roulette = dice.pick(&["'throughput'", "{ fixed = 0.01 }", "{ fixed = 0.9 }", "{ throughput = { start = 1 } }"]);
    let seed = dice.below(1 << 20);
    let reuse = dice.pick(&["suffixes", "off"]);
    format!(
        "estimator = '{estimator}', sampler = '{sampler}', directions = '{directions}', roulette = {roulette}, reuse = '{reuse}', seed = {seed}"
    )
}

fn material(dice: &mut Dice) -> String {
    let alpha = dice.pick(&[0.0, 1e-4, 1e-3, 0.03, 0.3, 1.0]);
    let ior = dice.pick(&[0.05, 0.7, 1.0, 1.000_001, 1.5, 2.4, 20.0]);
    let colour = dice.pick(&["1.0", "0.0", "1e-9", "[1.0, 0.5, 0.0]", "{ texture = 'squares' }", "{ texture = 'fine' }"]);
    match dice.below(8) {
        0 => format!("lambertian = {{ albedo = {colour} }}"),
        1 => format!("mirror = {{ reflectance = {colour} }}"),
        2 => format!("dielectric = {{ ior = {ior:?}, transmittance = [1.0, 0.5, {:?}] }}", dice.pick(&[0.0, 1e-30, 1.0])),
        3 => format!("dielectric = {{ ior = {ior:?}, alpha = {alpha:?}, ior_outside = {:?} }}", dice.pick(&[1.0, 1.5])),
        4 => format!("conductor = {{ f0 = {colour}, alpha = {alpha:?} }}"),
        5 => format!("conductor = {{ eta = [0.0, 0.2, 1e3], k = [1e-3, 3.0, 1e3], alpha = {alpha:?} }}"),
        6 => "conductor = { reflectance = 1.0, roughness = { texture = 'fine' } }".to_owned(),
        _ => format!("plastic = {{ albedo = {colour}, ior = {:?}, alpha = {alpha:?} }}", f64::max(ior, 1.0)),
    }
}

fn object(dice: &mut Dice, shape: fn(&mut Dice, DVec3, f64) -> String, material: &str, count: usize) -> String {
    let size = dice.decade(-4.0, 1.0);
    let center = dice.in_ball() * 3.0;
    let mut text = format!("[[objects]]\n{}\n", shape(dice, center, size));
    if dice.chance(0.9) {
        text += &format!("material = '{material}{}'\n", dice.below(count));
    }
    if dice.chance(0.3) {
        let radiance = dice.pick(&["1.0", "1e-9", "1e9", "[0.0, 1.0, 1e9]"]);
        text += &format!("emission = {{ radiance = {radiance}, two_sided = {} }}\n", dice.chance(0.5));
    }
    if dice.chance(0.2) {
        text += "flip = true\n";
    }
    if dice.chance(0.2) {
        text += &format!("motion = [{}]\n", motion(dice));
    }
    text
}

fn shape(dice: &mut Dice, center: DVec3, size: f64) -> String {
    let place = format!("transform = [{{ scale = {size:?} }}, {{ translate = {} }}]", v(center));
    match dice.below(10) {
        0 => format!("shape.disk = {{ center = {}, normal = {}, radius = {size:?} }}", v(center), v(dice.direction())),
        1 => format!(
            "shape.rectangle = {{ origin = {}, edge_u = {}, edge_v = {} }}",
            v(center),
            v(dice.direction() * size),
            v(dice.direction() * size * dice.decade(-4.0, 0.0))
        ),
        2 => format!("shape.mesh.knot.triangles = {}\n{place}", 18 + dice.below(300)),
        3 => format!("shape.mesh.heightfield = {{ quads = {}, seed = {} }}\n{place}", 1 + dice.below(12), dice.below(100)),
        4 => {
            let [base, top] = [center, center + dice.direction() * size].map(v);
            format!(
                "shape.cylinder = {{ base = {base}, top = {top}, radius = {:?}, capped = false }}",
                size * dice.decade(-3.0, 0.0)
            )
        }
        _ => closed(dice, center, size),
    }
}
