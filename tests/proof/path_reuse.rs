//! Reused suffixes and outliers: the image is the same, and the light of a path is distributed without loss.
use std::{ops::Range, path::Path};

use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Batch, TILE, Work, thresholds, trace};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, built_in, load},
};

use crate::{
    picture::{assert_all_within, scene, settings},
    statistics::Moments,
};

/// A room with all kinds of surfaces where paths may or must not be reused: walls of many colours, one of them one-sided, mirror,
/// glass, metal and plastic, a light that reflects, a mesh, a texture, a sky behind an opening.
pub const ROOM: &str = r#"
[camera]
eye = [0.0, 1.0, 3.9]
look_at = [0.0, 0.9, 0.0]
fov = 70.0
resolution = [32, 32]
[environment]
radiance = [0.6, 0.9, 1.4]
[textures.tiles]
checker = { even = [0.9, 0.1, 0.2], odd = 0.8, scale = 6.0 }
[materials]
white = { lambertian = { albedo = 0.8 } }
red = { lambertian = { albedo = [0.9, 0.0, 0.1] }, two_sided = false }
tiled = { lambertian = { albedo = { texture = "tiles" } } }
mirror = { mirror = { reflectance = 0.9 } }
glass = { dielectric = { ior = 1.5 } }
metal = { conductor = { f0 = 0.9, alpha = 0.2 } }
glaze = { plastic = { albedo = [0.2, 0.4, 0.8], ior = 1.5, roughness = 0.3 } }
[[objects]]
shape = { rectangle = { origin = [-2.0, 0.0, 4.0], edge_u = [4.0, 0.0, 0.0], edge_v = [0.0, 0.0, -6.0] } }
material = "tiled"
[[objects]]
shape = { rectangle = { origin = [-2.0, 0.0, -2.0], edge_u = [4.0, 0.0, 0.0], edge_v = [0.0, 2.4, 0.0] } }
material = "white"
[[objects]]
shape = { rectangle = { origin = [-2.0, 0.0, 4.0], edge_u = [0.0, 0.0, -6.0], edge_v = [0.0, 2.4, 0.0] } }
material = "red"
[[objects]]
shape = { rectangle = { origin = [2.0, 0.0, -2.0], edge_u = [0.0, 0.0, 6.0], edge_v = [0.0, 2.4, 0.0] } }
material = "glaze"
[[objects]]
shape = { disk = { center = [0.0, 2.3, 0.5], normal = [0.0, -1.0, 0.0], radius = 0.6 } }
material = "white"
emission = { radiance = [4.0, 3.0, 2.0] }
[[objects]]
shape = { sphere = { center = [-1.0, 0.4, -0.5], radius = 0.4 } }
material = "mirror"
[[objects]]
shape = { sphere = { center = [0.2, 0.4, 0.6], radius = 0.4 } }
material = "glass"
[[objects]]
shape = { sphere = { center = [1.1, 0.35, -0.8], radius = 0.35 } }
material = "metal"
[[objects]]
shape = { cuboid = { min = [-0.3, 0.0, -1.5], max = [0.4, 1.3, -0.9] } }
material = "white"
[[objects]]
shape = { cylinder = { base = [-1.4, 0.0, 1.0], top = [-1.4, 0.8, 1.0], radius = 0.25, capped = false } }
material = "white"
[[objects]]
shape = { mesh = { vertices = [[1.0, 0.0, 1.0], [1.6, 0.0, 1.2], [1.2, 0.0, 1.8], [1.25, 0.9, 1.3]], triangles = [[0, 3, 1], [1, 3, 2], [2, 3, 0]] } }
material = "white"
"#;

/// The radiance of every pixel of one tile for some samples, one after the other. The tile is the middle of an image of this width, or all of
/// it.
fn tiles(scene: &Scene, settings: RenderSettings, width: u32, samples: Range<u32>) -> Vec<Vec<[f32; 4]>> {
    let rays = scene.rays(&Camera { resolution: [width; 2], ..scene.camera });
    let (mut batch, level) = (Batch::default(), SimdLevel::best());
    let (origin, size) = (width / 2 / TILE * TILE, width.min(TILE));
    let first = Work::tile(scene, &rays, &settings, [origin; 2], [size; 2], 0);
    let thresholds = thresholds(level, &first, &mut batch, &|| false).expect("nobody interrupts");
    let tile = |sample| {
        let work = Work { sample, thresholds: thresholds.as_ref(), ..first };
        trace(level, &work, &mut batch, &|| false).expect("nobody interrupts");
        (0..size * size).map(|i| batch.radiance()[(i / size * TILE + i % size) as usize]).collect()
    };
    samples.map(tile).collect()
}

/// The radiance of every pixel of one tile for one sample.
fn tile(scene: &Scene, settings: RenderSettings, size: u32, sample: u32) -> Vec<[f32; 4]> {
    tiles(scene, settings, size, sample..sample + 1).remove(0)
}

/// Every channel of 16 blocks of a tile, by sample. Pixels reuse paths; samples do not.
fn blocks(scene: &Scene, settings: RenderSettings, spp: u32) -> Vec<Vec<f64>> {
    const SIDE: usize = TILE as usize / 4;
    let mut values = vec![Vec::new(); 48];
    for tile in tiles(scene, settings, TILE, 0..spp) {
        let mut sums = [0.0; 48];
        for (i, radiance) in tile.iter().enumerate() {
            let (x, y) = (i % TILE as usize / SIDE, i / TILE as usize / SIDE);
            (0..3).for_each(|c| sums[(4 * y + x) * 3 + c] += f64::from(radiance[c]));
        }
        values.iter_mut().zip(sums).for_each(|(values, sum)| values.push(sum));
    }
    values
}

#[track_caller]
fn assert_same_picture(scene: &Scene, settings: RenderSettings, shared: Reuse, spp: u32, what: &str) {
    let of = |reuse, seed| blocks(scene, RenderSettings { reuse, seed, ..settings }, spp);
    let deviation = |(a, b): (Vec<f64>, Vec<f64>)| {
        let (a, b) = (Moments::of(a), Moments::of(b));
        (a.mean - b.mean) / ((a.variance + b.variance) / f64::from(spp)).sqrt().max(1e-9)
    };
    let deviations: Vec<f64> = of(Reuse::Off, 1).into_iter().zip(of(shared, 2)).map(deviation).collect();
    assert_all_within(&deviations, what);
}

#[test]
fn shared_paths_give_the_same_picture() {
    for estimator in Estimator::ALL {
        assert_same_picture(&scene(ROOM), settings(estimator), Reuse::Suffixes, 800, estimator.name());
        let box_of_walls = RenderSettings { max_bounces: Some(3), roulette: Roulette::fixed(0.7), ..settings(estimator) };
        assert_same_picture(&built_in(), box_of_walls, Reuse::Suffixes, 400, "the built-in scene, with a cap");
    }
}

/// Caustics, with and without shared suffixes; lens, motion, media and opacity, in which suffixes are not shared.
#[test]
fn reused_outliers_give_the_same_picture() {
    for estimator in [Estimator::Path, Estimator::Light, Estimator::Mis] {
        for shared in [Reuse::Outliers, Reuse::Both] {
            assert_same_picture(&scene(ROOM), settings(estimator), shared, 800, estimator.name());
        }
    }
    let capped = RenderSettings { max_bounces: Some(4), roulette: Roulette::fixed(0.7), ..settings(Estimator::Mis) };
    for name in ["sky_lit", "depth_of_field", "motion_blur", "tinted_glass", "leaves", "lights"] {
        let scene = load(Path::new(&format!("scenes/{name}.toml"))).expect("it is shipped");
        assert_same_picture(&scene, settings(Estimator::Mis), Reuse::Outliers, 600, name);
        assert_same_picture(&scene, capped, Reuse::Outliers, 300, name);
    }
}

/// That is what they are shared for.
#[test]
fn reused_outliers_have_less_noise_where_there_are_caustics() {
    let scene = load(Path::new("scenes/sky_lit.toml")).expect("it is shipped");
    let noise = |reuse| {
        let mut pixels = vec![Vec::new(); (TILE * TILE) as usize];
        for tile in tiles(&scene, RenderSettings { reuse, ..settings(Estimator::Mis) }, 8 * TILE, 0..400) {
            pixels.iter_mut().zip(tile).for_each(|(pixel, radiance)| pixel.push(f64::from(radiance[1])));
        }
        pixels.into_iter().map(Moments::of).map(|pixel| pixel.variance / (pixel.mean * pixel.mean)).sum::<f64>()
    };
    let gain = noise(Reuse::Off) / noise(Reuse::Outliers);
    assert!(gain > 1.5, "{gain}");
}

/// If all surfaces have the same albedo, the light of a path is distributed among the pixels without loss or gain.
#[test]
fn the_light_of_a_path_is_divided_without_loss() {
    const GREY: &str = r#"
[camera]
eye = [0.0, 0.3, 0.9]
look_at = [0.0, 0.0, 0.0]
fov = 60.0
resolution = [32, 32]
[materials.grey]
lambertian = { albedo = 0.6 }
[[objects]]
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 2.0 } }
material = "grey"
flip = true
emission = { radiance = 0.25 }
[[objects]]
shape = { sphere = { center = [0.2, 0.0, 0.1], radius = 0.4 } }
material = "grey"
[[objects]]
shape = { cuboid = { min = [-1.0, -1.5, -0.9], max = [-0.3, 0.3, -0.3] } }
material = "grey"
"#;
    let scene = scene(GREY);
    // Roulette makes no random decision here, so both trace the same paths.
    let settings = RenderSettings { roulette: Roulette::Off, max_bounces: Some(5), ..settings(Estimator::Path) };
    for (size, sample) in [(TILE, 0), (TILE, 1), (TILE, 7), (19, 3), (3, 2), (1, 4)] {
        let sum = |reuse| -> f64 {
            let pixels = tile(&scene, RenderSettings { reuse, ..settings }, size, sample);
            pixels.iter().map(|radiance| f64::from(radiance[0])).sum()
        };
        let (alone, shared) = (sum(Reuse::Off), sum(Reuse::Suffixes));
        assert!((shared / alone - 1.0).abs() < 2e-6, "{size} {sample}: {shared} {alone}");
    }
}

#[test]
fn paths_are_not_shared_where_they_must_not_be() {
    let uniform = RenderSettings { directions: Directions::Uniform, sampler: Sampler::Sobol, ..settings(Estimator::Mis) };
    let tinted = ROOM.replace("ior = 1.5 }", "ior = 1.5, transmittance = 0.5 }");
    for (text, settings) in [(ROOM, uniform), (tinted.as_str(), settings(Estimator::Mis))] {
        let scene = scene(text);
        let of = |reuse| tile(&scene, RenderSettings { reuse, ..settings }, TILE, 0);
        assert!(of(Reuse::Off) == of(Reuse::Suffixes));
    }
}
