//! Bidirectional paths: every strategy alone, and all of them together.
use crate::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_base::math::SimdLevel;
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, Strategy, parse},
};

/// Two panels, a ball and a light that do not touch each other: near an edge, a strategy alone would have no variance.
const PANELS: &str = "
    format = 1
    [camera]
    eye = [0.0, 1.0, 4.0]
    look_at = [0.0, 0.6, 0.0]
    fov = 40
    resolution = [16, 16]
    [textures]
    waves.noise = { scale = 3.0, octaves = 2, low = 0.0, high = 1.0 }
    [materials]
    bumped.conductor = { reflectance = 0.9, roughness = 0.6 }
    bumped.bump = { texture = 'waves', height = 0.3 }
    shadowed.lambertian = { albedo = 0.8 }
    shadowed.bump = { texture = 'waves', height = 0.3 }
    shadowed.normal_shadowing = true
    shadowed.mirrored_normals = true
    bumped_glass.dielectric = { ior = 1.5 }
    bumped_glass.bump = { texture = 'waves', height = 0.1 }
    white.lambertian = { albedo = 0.8 }
    red.lambertian = { albedo = [0.8, 0.3, 0.3] }
    gloss.conductor = { reflectance = 0.9, roughness = 0.6 }
    clear.dielectric = { ior = 1.5 }
    rough.dielectric = { ior = 1.5, roughness = 0.5 }
    tinted.dielectric = { ior = 1.5, transmittance = [0.05, 0.3, 0.7] }
    rough_tinted.dielectric = { ior = 1.5, roughness = 0.5, transmittance = [0.05, 0.3, 0.7] }
    lacquered.plastic = { albedo = 0.5, ior = 1.5 }
    coated.plastic = { albedo = 0.5, ior = 1.5, roughness = 0.5 }
    veiled.lambertian = { albedo = 0.8 }
    veiled.opacity = { texture = 'waves' }
    sheer.diffuse_transmission = { reflectance = 0.4, transmittance = 0.4 }
    sheer.opacity = 0.5
    patchy.blend = { first = 'coated', second = 'veiled', weight = 0.5 }
    [[objects]]
    shape.rectangle = { origin = [-2.0, 0.0, -2.0], edge_u = [0.0, 0.0, 4.0], edge_v = [4.0, 0.0, 0.0] }
    material = 'white'
    [[objects]]
    shape.rectangle = { origin = [-1.2, 0.3, -1.3], edge_u = [2.4, 0.0, 0.0], edge_v = [0.0, 1.5, 0.0] }
    material = 'red'
    [[objects]]
    SHAPE
    material = 'BALL'
    [[objects]]
    shape.rectangle = { origin = [-0.9, 1.6, -0.6], edge_u = [0.6, 0.0, 0.0], edge_v = [0.0, 0.0, 0.6] }
    emission.radiance = [9.0, 8.0, 7.0]
    ";

pub const BALL: &str = "shape.sphere = { center = [0.4, 0.8, 0.2], radius = 0.4 }";
/// A cube whose normals are those of a ball. They differ from those of its sides by up to 55°.
const SMOOTH_CUBE: &str = "shape.mesh = { smooth = true, \
    vertices = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], \
    triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [3, 7, 6], [3, 6, 2], [0, 4, 7], [0, 7, 3], \
    [1, 2, 6], [1, 6, 5]] }
    transform = [{ scale = 0.3 }, { rotate = { axis = [1, 1, 0], degrees = 20 } }, { translate = [0.4, 0.8, 0.2] }]";

pub fn scene(shape: &str, material: &str) -> Scene {
    parsed(&PANELS.replace("SHAPE", shape).replace("BALL", material))
}

fn parsed(text: &str) -> Scene {
    parse("both ends", text.to_owned()).unwrap_or_else(|error| panic!("{}", error.report()))
}

pub const SETTINGS: RenderSettings = RenderSettings {
    merging: false,
    estimator: Estimator::Bidirectional,
    sampler: Sampler::Independent,
    directions: noisefall_scene::sampling::Directions::Bsdf,
    roulette: Roulette::Off,
    max_bounces: None,
    count_crossings: false,
    reuse: Reuse::Off,
    adaptive: false,
    seed: 7,
    fault: None,
    strategy: None,
};

/// Mean green of the image, and its variance.
pub fn mean(scene: &Scene, settings: &RenderSettings, spp: u32) -> [f64; 2] {
    let rays = scene.rays(&scene.camera);
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let mut film = Film::new(rays.resolution);
    threads.pass(PassJob { scene, rays: &rays, settings }, &mut film, spp, &|| false);
    let frame = Frame::of_film(&film, 0, rays.resolution, rays.resolution);
    let pixels = frame.radiance.len() as f64;
    let noise = frame.noise.expect("two samples");
    let sum: f64 = frame.radiance.iter().map(|radiance| f64::from(radiance[1])).sum();
    let variance: f64 = noise.variance.iter().map(|variance| f64::from(variance[1])).sum();
    [sum / pixels, variance / (pixels * pixels)]
}

#[test]
fn every_strategy_alone_finds_the_light_of_its_number_of_reflections() {
    let mut worst: f64 = 0.0;
    let balls = ["white", "gloss", "coated", "veiled", "sheer", "patchy"].map(|ball| (BALL, ball));
    let cubes = ["gloss", "white"].map(|cube| (SMOOTH_CUBE, cube));
    for (shape, ball) in balls.into_iter().chain(cubes) {
        let scene = scene(shape, ball);
        for reflections in 1..=3 {
            let alone = |s: u32| {
                let t = reflections + 2 - s;
                mean(
                    &scene,
                    &RenderSettings {
                        strategy: Some(Strategy { s, t, weighted: false }),
                        max_bounces: Some(reflections),
                        seed: 7 + s,
                        ..SETTINGS
                    },
                    2000,
                )
            };
            let [light_samples, variance] = alone(1);
            assert!(light_samples > 0.0 && variance > 0.0);
            // A light path does not leave a smooth surface in directions from which the smooth normal cannot be seen, and where the
            // normal is that of the surface.
            let most = if shape == SMOOTH_CUBE { 2 } else { reflections + 1 };
            for s in (0..=most).filter(|s| *s != 1) {
                let [found, of_found] = alone(s);
                let z = (found - light_samples) / (variance + of_found).sqrt();
                worst = worst.max(z.abs());
                assert!(z.abs() < 4.0, "{ball} ({s}, {}): {found} and {light_samples}, {z} σ", reflections + 2 - s);
                let is_known = of_found.sqrt() < 0.7 * found;
                assert!(is_known, "{ball} ({s}, {}): {found} ± {}", reflections + 2 - s, of_found.sqrt());
            }
        }
    }
    assert!(worst > 0.3, "chance is at work: {worst} σ");
}

#[test]
fn all_strategies_together_find_the_light_of_mis() {
    const SETTINGS: RenderSettings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..self::SETTINGS };
    let glass = ["clear", "tinted", "rough_tinted", "bumped_glass"];
    let others = ["white", "gloss", "lacquered", "shadowed", "veiled", "sheer", "patchy"];
    let balls = glass.into_iter().chain(others).map(|ball| (BALL, ball));
    let cubes = ["white", "gloss", "lacquered", "clear", "rough", "rough_tinted", "bumped", "shadowed", "bumped_glass"]
        .map(|cube| (SMOOTH_CUBE, cube));
    for (shape, ball) in balls.chain(cubes) {
        let scene = scene(shape, ball);
        for cap in [Some(3), None] {
            let with = |estimator, spp| mean(&scene, &RenderSettings { estimator, max_bounces: cap, ..SETTINGS }, spp);
            let [of_mis, variance] = with(Estimator::Mis, 2000);
            for estimator in [Estimator::Caustics, Estimator::LightTracing, Estimator::Bidirectional] {
                let is_allowed = scene.traces_light_paths(&RenderSettings { estimator, ..SETTINGS });
                let has_own_normals = shape == BALL && !ball.starts_with("bumped") && ball != "shadowed";
                assert_eq!(is_allowed, estimator != Estimator::LightTracing || has_own_normals, "{shape} {ball}");
                let [found, of_found] = with(estimator, 1000);
                let z = (found - of_mis) / (variance + of_found).sqrt();
                println!("{ball}, {}, cap {cap:?}: {found} and {of_mis}, {z} σ", estimator.name());
                assert!(z.abs() < 4.0, "{ball}, {}, cap {cap:?}: {found} and {of_mis}, {z} σ", estimator.name());
            }
        }
    }
}

/// Checks that two strategies alone find the same light.
fn assert_alike(scene: &Scene, [a, b]: [[u32; 2]; 2], spp: u32) {
    let [(of_a, a_variance), (of_b, b_variance)]: [(f64, f64); 2] = [(a, 1), (b, 2)].map(|([s, t], seed)| {
        let alone = RenderSettings { seed, ..SETTINGS }.of_strategy(Strategy { s, t, weighted: false });
        mean(scene, &alone, spp).into()
    });
    let error = (a_variance + b_variance).sqrt();
    assert!(error < 0.04 * of_a, "{a:?}, {b:?}: {of_a} ± {error}");
    assert!((of_a - of_b).abs() < 4.0 * error, "{a:?}, {b:?}: {of_a} and {of_b} ± {error}");
}

/// A light whose light a bent mirror brings to the floor. Its smooth normals are up to 30° off those of its faces.
const BENT_MIRROR: &str = "
    format = 1
    [camera]
    eye = [-0.2, 3.0, 0.0]
    look_at = [-0.2, 0.0, 0.0]
    up = [0.0, 0.0, 1.0]
    fov = 15
    resolution = [16, 16]
    [materials]
    white.lambertian = { albedo = 0.8 }
    bent.mirror = { reflectance = 0.9 }
    [[objects]]
    shape.rectangle = { origin = [-0.9, 0.0, -2.0], edge_u = [0.0, 0.0, 4.0], edge_v = [4.0, 0.0, 0.0] }
    material = 'white'
    [[objects]]
    shape.mesh = { smooth = true, triangles = [[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]], vertices = [[-1, 0.2, -1], \
    [-1, 0.2, 1], [-1, 1.2, -1], [-1, 1.2, 1], [-1.7, 1.6, -1], [-1.7, 1.6, 1]] }
    material = 'bent'
    [[objects]]
    shape.sphere = { center = [1.0, 1.4, 0.0], radius = 0.3 }
    emission.radiance = 5
    ";

#[test]
fn smooth_mirrors_bring_the_same_light_from_either_end() {
    assert_alike(&parsed(BENT_MIRROR), [[0, 4], [3, 1]], 8000);
}

/// Rough glass that absorbs, and what is `seen` from this height.
fn glass_and(seen: &str, height: f64) -> String {
    format!(
        "format = 1
        camera = {{ eye = [0.0, {height:?}, 3.0], look_at = [0.0, 0.0, 0.0], fov = 20, resolution = [16, 16] }}
        materials.white.lambertian.albedo = 0.8
        materials.glass.dielectric = {{ ior = 1.3, roughness = 0.7, transmittance = [0.1, 0.1, 0.1] }}
        {seen}
        "
    )
}

/// A white ball in glass, in light from everywhere.
const BALL_IN_GLASS: &str = "
    environment.radiance = 1
    [[objects]]
    shape.sphere = { center = [0, 0, 0], radius = 0.5 }
    material = 'glass'
    [[objects]]
    shape.sphere = { center = [0, 0, 0], radius = 0.25 }
    material = 'white'
    ";

#[test]
fn connections_in_glass_are_attenuated() {
    let scene = parsed(&glass_and(BALL_IN_GLASS, 0.0));
    assert_alike(&scene, [[1, 4], [2, 3]], 8000);
    assert_alike(&scene, [[1, 4], [4, 1]], 8000);
}

/// A floor below a ball of glass.
const FLOOR_AND_GLASS: &str = "
    [[objects]]
    shape.rectangle = { origin = [-0.6, -0.6, 0.6], edge_u = [1.2, 0.0, 0.0], edge_v = [0.0, 0.0, -1.2] }
    material = 'white'
    [[objects]]
    shape.sphere = { center = [0, 2, 0], radius = 0.6 }
    material = 'glass'
    ";

#[test]
fn light_that_starts_in_glass_is_attenuated() {
    let light = "[[objects]]\nshape.sphere = { center = [0, 2, 0], radius = 0.25 }\nemission.radiance = 4";
    let scene = parsed(&(glass_and(FLOOR_AND_GLASS, 2.0) + light));
    assert_alike(&scene, [[0, 4], [3, 1]], 8000);
    assert_alike(&scene, [[1, 3], [2, 2]], 8000);
}

/// Rough glass that emits samples only punctual lights, and light paths start there, too. Paths start neither where light passes
/// through the light, nor where no point is sampled, nor where the medium may change.
#[test]
fn lights_of_every_kind_shine_as_with_mis() {
    let shape = "{ expression = 'x^2 + y^2 + z^2 - 0.16', bounds = { min = [-0.5, -0.5, -0.5], max = [0.5, 0.5, 0.5] } }";
    let isosurface = format!(
        "[[objects]]\nshape.isosurface = {shape}\ntransform = [{{ translate = [0.5, 1.0, -0.5] }}]\nemission.radiance = 2\n"
    );
    let sheet =
        "[[objects]]\nshape.sphere = { center = [-0.6, 0.8, 0], radius = 0.2 }\nemission.radiance = 3\nmaterial = 'sheer'\n";
    let half_within = "[[objects]]\nshape.sphere = { center = [0, 1.4, 0], radius = 0.3 }\nemission.radiance = 3\n";
    let outside = "[[objects]]\nshape.sphere = { center = [0.8, 1, 0.3], radius = 0.1 }\nemission.radiance = 5\n";
    let tinted = glass_and(FLOOR_AND_GLASS, 2.0);
    let clear = tinted.replace(", transmittance = [0.1, 0.1, 0.1]", "");
    let sheer = "materials.sheer = { lambertian.albedo = 0.5, opacity = 0.4 }";
    let cases = [
        (clear.clone() + "emission.radiance = 4\n" + outside, true),
        (clear.replacen("[[objects]]", &format!("{sheer}\n[[objects]]"), 1) + &isosurface + sheet + outside, false),
        (tinted + half_within + outside, false),
    ];
    for (number, (text, forward)) in cases.iter().enumerate() {
        let scene = parsed(text);
        let settings = |estimator| RenderSettings { estimator, max_bounces: Some(4), ..SETTINGS };
        let with = |estimator| mean(&scene, &settings(estimator), 2000);
        let [of_mis, variance] = with(Estimator::Mis);
        for estimator in [Estimator::Caustics, Estimator::LightTracing, Estimator::Bidirectional] {
            let is_allowed = scene.traces_light_paths(&settings(estimator));
            assert_eq!(is_allowed, estimator != Estimator::LightTracing || *forward, "{number}");
            let [found, of_found] = with(estimator);
            let z = (found - of_mis) / (variance + of_found).sqrt();
            assert!(z.abs() < 4.0, "{number}, {}: {found} and {of_mis}, {z} σ", estimator.name());
        }
    }
}

/// A sheet of opacity ½ close above a floor, nearer than a thousandth of the way to the vertex that is connected.
#[test]
fn connections_pass_a_sheet_that_lies_on_their_end() {
    let sheet = "[[objects]]
    shape.rectangle = { origin = [-2.0, 0.0004, -2.0], edge_u = [0.0, 0.0, 4.0], edge_v = [4.0, 0.0, 0.0] }
    material = 'half'";
    let half = "[materials]\nhalf.lambertian = { albedo = 0.2 }\nhalf.opacity = 0.5";
    let scene = parsed(&(PANELS.replace("SHAPE", BALL).replace("BALL", "white").replace("[materials]", half) + sheet));
    assert_alike(&scene, [[1, 3], [2, 2]], 4000);
}
