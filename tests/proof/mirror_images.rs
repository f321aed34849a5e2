//! A mirrored scene gives the mirror image, whatever it is made of.
//!
//! Shapes, materials and their parameters, and projections are those of the declarations, so that a new kind is tried without an edit here. A
//! parameter that has a handedness, such as the rotation of a tangent, must turn the other way in the mirror.
use noisefall::description::{
    DVec3, EnvironmentDescription, Projection, SceneDescription,
    materials::Material,
    shapes::{ShapeKind, Transform},
};
use noisefall_base::declare::{Dice, OneOf};
use noisefall_edit::edit::new_text;
use noisefall_scene::scene::{Estimator, Scene, describe, parse};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use crate::picture::{LUMINANCE, Mean, assert_all_within, picture, settings};

/// Draws of each material.
const DRAWS: usize = 3;
const RESOLUTION: [usize; 2] = [24, 16];
/// Pixels along the sides of the blocks that are compared.
const BLOCK: usize = 4;

/// A ball or something else in front of a sky that looks the same from no two sides, beside a light and a checkered wall.
fn base() -> SceneDescription {
    let assets = format!("{}/scenes/assets", env!("CARGO_MANIFEST_DIR"));
    let text = format!(
        "format = 1
        camera = {{ eye = [0.7, 0.9, 3.6], look_at = [0.1, 0, 0], up = [0.2, 1, 0.1], fov = 40, resolution = [{}, {}], shift = [0.05, 0.1] }}
        environment = {{ image = '{assets}/sky.exr', scale = 0.5, rotate = 50 }}
        textures.dents.checker = {{ even = 0.2, odd = 0.6, scale = 5 }}
        materials.wall.lambertian.albedo = {{ texture = 'squares' }}
        textures.squares.checker = {{ even = 0.9, odd = 0.2, scale = 3 }}
        materials.m.lambertian.albedo = 0.8
        [[objects]]
        shape.sphere = {{ center = [0, 0, 0], radius = 1 }}
        material = 'm'
        [[objects]]
        shape.rectangle = {{ origin = [-2, -1.2, -1.5], edge_u = [3, 0, 1], edge_v = [0, 3, 0] }}
        material = 'wall'
        [[lights]]
        directional = {{ direction = [-1, -0.6, -0.8], irradiance = [2, 1.5, 1] }}",
        RESOLUTION[0], RESOLUTION[1]
    );
    describe("base.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// The scene and its image in the mirror x = 0.
fn pair(description: &SceneDescription) -> Option<[Scene; 2]> {
    const MIRROR: DVec3 = DVec3::new(-1.0, 1.0, 1.0);
    let mut mirrored = description.clone();
    let camera = &mut mirrored.camera;
    (camera.eye, camera.look_at) = (camera.eye * MIRROR, camera.look_at * MIRROR);
    camera.up = camera.up.map(|up| up * MIRROR);
    camera.shift[0] = -camera.shift[0];
    mirrored.objects.iter_mut().for_each(|object| object.transform.push(Transform::Scale(MIRROR)));
    mirrored.punctual_lights.iter_mut().for_each(|punctual_light| punctual_light.transform.push(Transform::Scale(MIRROR)));
    if let Some(EnvironmentDescription::Image(image)) = &mut mirrored.environment {
        image.transform.push(Transform::Scale(MIRROR));
    }
    let [plain, mirrored] = [description, &mirrored].map(|described| parse("pair.toml", new_text(described)).ok());
    Some([plain?, mirrored?])
}

fn block(pixels: &[Mean], x: usize, y: usize) -> Mean {
    let [wide, _] = RESOLUTION;
    Mean::of((0..BLOCK * BLOCK).map(|at| pixels[(y * BLOCK + at / BLOCK) * wide + x * BLOCK + at % BLOCK]))
}

/// Deviations between the blocks of the image and those of the mirrored one.
fn deviations([plain, mirrored]: &[Scene; 2]) -> Vec<f64> {
    const SPP: u32 = 64;
    let first = picture(plain, settings(Estimator::Mis), LUMINANCE, SPP);
    let other = noisefall_scene::scene::RenderSettings { seed: 99, ..settings(Estimator::Mis) };
    let second = picture(mirrored, other, LUMINANCE, SPP);
    let [across, down] = RESOLUTION.map(|side| side / BLOCK);
    let of_block = |at: usize| {
        let (x, y) = (at % across, at / across);
        block(&first.pixels, x, y).z_from(block(&second.pixels, across - 1 - x, y))
    };
    (0..across * down).map(of_block).collect()
}

/// Compares scenes with what `change` makes of the one above; those that it makes invalid do not count.
fn assert_mirrored(what: &str, changes: usize, least: usize, mut change: impl FnMut(usize, &mut SceneDescription)) {
    let (mut all, mut compared) = (Vec::new(), 0);
    for number in 0..changes {
        let mut description = base();
        change(number, &mut description);
        let Some(scenes) = pair(&description) else { continue };
        compared += 1;
        all.extend(deviations(&scenes));
    }
    println!("{what}: {compared} of {changes} scenes");
    assert!(compared >= least, "{what}: only {compared} scenes are valid");
    assert_all_within(&all, what);
}

fn turned(random: &mut SmallRng) -> Vec<Transform> {
    let mut factor = || if random.random() { -0.9 } else { 0.8 };
    vec![Transform::Scale(DVec3::new(factor(), 1.0, factor()))]
}

#[test]
fn materials_are_mirrored_with_all_their_parameters() {
    let mut random = SmallRng::seed_from_u64(7);
    let kinds = Material::alternatives();
    let count = kinds.len() * DRAWS;
    assert_mirrored("materials", count, count / 2, |number, description| {
        let mut kind = kinds[number / DRAWS].clone();
        kind.chosen(&mut Dice::new(&mut random));
        let material = description.materials.get_mut("m").expect("it is there");
        material.kind = kind;
        if random.random() {
            material.normal_map = Some(format!("{}/scenes/assets/bricks_normal.png", env!("CARGO_MANIFEST_DIR")));
            material.two_sided_relief = Some(random.random());
        }
        let object = &mut description.objects[0];
        object.transform = turned(&mut random);
        object.flip = random.random();
    });
}

#[test]
fn shapes_are_mirrored_with_their_tangents() {
    let mut random = SmallRng::seed_from_u64(8);
    let kinds = ShapeKind::alternatives();
    let count = 2 * kinds.len();
    assert_mirrored("shapes", count, count / 2, |number, description| {
        let brushed = "conductor = { reflectance = 0.9, roughness = 0.4, anisotropy = 0.9, tangent_rotation = 30 }";
        let text = format!(
            "format = 1\ncamera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }}\nenvironment.radiance = 1\n[materials.m]\n{brushed}"
        );
        let brushed = describe("brushed.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        description.materials.insert("m".to_owned(), brushed.materials["m"].clone());
        let object = &mut description.objects[0];
        object.shape = kinds[number / 2].clone();
        object.transform = turned(&mut random);
    });
}

#[test]
fn projections_are_mirrored() {
    let kinds = Projection::alternatives();
    assert_mirrored("projections", kinds.len(), kinds.len() - 1, |number, description| {
        let mut projection = kinds[number];
        projection.chosen(&mut Dice::new(&mut SmallRng::seed_from_u64(9)));
        description.camera.projection = projection;
        description.camera.fov = description.camera.fov.filter(|_| projection.has_angle());
    });
}
