//! The estimators agree on every shipped scene. If neither path nor light sampling is good everywhere, MIS is better than
//! either.
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Scene, load},
};

use crate::picture::{LUMINANCE, Mean, Picture, assert_all_within, picture, scene, settings};

const RESOLUTION: [u32; 2] = [64, 32];
const BLOCK: usize = 16;

/// Scenes whose light some estimators hardly find. With these numbers of samples their means are not normally distributed.
const HARD: [&str; 4] = ["caustic_in_mirror", "glass_ball_caustic", "keyhole_room", "water_pool"];

/// Enough samples for normally distributed means of most blocks. Every estimator is tested on every scene, because light behind
/// mirrors and smooth glass counts in all of them.
fn samples_per_pixel(scene: &str, estimator: Estimator) -> u32 {
    match scene {
        // One path in a thousand finds this light, or the sun through this window.
        "tiny_lamp" | "room_window" if estimator == Estimator::Path => 4096,
        // Its samples are expensive.
        "five_hundred_lamps" => 128,
        _ => 512,
    }
}

/// The blocks, and then the whole image.
fn means(picture: &Picture) -> Vec<Mean> {
    picture.blocks(BLOCK).into_iter().chain([picture.whole()]).collect()
}

/// Whether the standard error is at most a tenth of the mean. If hardly any path finds light, means are not normally distributed;
/// such blocks count in the whole image only.
fn are_known(a: Mean, b: Mean) -> bool {
    (a.variance_of_mean + b.variance_of_mean).sqrt() <= 0.1 * a.mean.max(b.mean)
}

#[test]
fn they_agree_on_every_shipped_scene() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("the folder of scenes").map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.retain(|path| !path.file_stem().is_some_and(|name| HARD.contains(&&*name.to_string_lossy())));
    files.sort();
    let mut deviations = Vec::new();
    let mut names = Vec::new();
    let (mut left_out, mut compared) = (0, 0);
    for path in files {
        let name = path.file_stem().expect("a file").to_string_lossy().into_owned();
        let scene = load(&path).expect("a shipped scene compiles");
        let scene = Scene { camera: Camera { resolution: RESOLUTION, ..scene.camera }, ..scene };
        let mut found: Vec<(Estimator, Vec<Mean>)> = Vec::new();
        // Of light from far away, forward tracing finds so little that its means are not normally distributed.
        let is_far = scene.lights.environment.is_some();
        let is_left_out =
            |estimator: &Estimator| *estimator == Estimator::Auto || is_far && *estimator == Estimator::LightTracing;
        for estimator in Estimator::ALL.into_iter().filter(|estimator| !is_left_out(estimator)) {
            let settings =
                RenderSettings { estimator, sampler: Sampler::Independent, seed: settings(estimator).seed, ..scene.settings };
            let spp = samples_per_pixel(&name, estimator);
            found.push((estimator, means(&picture(&scene, settings, LUMINANCE, spp))));
        }
        for (i, (a, of_a)) in found.iter().enumerate() {
            for (b, of_b) in &found[i + 1..] {
                // Hardly any light from far away hits what the camera sees.
                let is_rarely_found = [a, b].contains(&&Estimator::LightTracing);
                for (i, (mean_a, mean_b)) in of_a.iter().zip(of_b).enumerate() {
                    let is_known = are_known(*mean_a, *mean_b);
                    compared += usize::from(!is_rarely_found);
                    left_out += usize::from(!is_known && !is_rarely_found);
                    if !is_known {
                        continue;
                    }
                    names.push(format!("{name}, {} and {}, block {i}", a.name(), b.name()));
                    deviations.push(mean_a.z_from(*mean_b));
                }
                let [whole_a, whole_b] = [of_a, of_b].map(|means| means[means.len() - 1]);
                println!("{name}: {} and {}: {:.2} σ", a.name(), b.name(), whole_a.z_from(whole_b));
                assert!(are_known(whole_a, whole_b) || is_rarely_found, "{name}: too few samples");
            }
        }
    }
    assert!(20 * left_out < compared, "{left_out} of {compared} blocks have too few samples");
    let worst =
        (0..names.len()).max_by(|a, b| deviations[*a].abs().total_cmp(&deviations[*b].abs())).expect("scenes are shipped");
    assert_all_within(&deviations, &format!("estimators on shipped scenes, the worst of all being {}", names[worst]));
}

/// Four lights of the same power, from tiny to large, mirrored by four balls, from nearly smooth to rough: figure 9.2 of E. Veach,
/// "Robust Monte Carlo Methods for Light Transport Simulation", 1997, made of spheres.
fn lamps_and_glosses() -> Scene {
    const GLOSSES: [f64; 4] = [0.001, 0.02, 0.1, 0.3];
    const LIGHTS: [f64; 4] = [0.02, 0.08, 0.25, 0.7];
    let place = |i: usize| -2.7 + 1.8 * i as f64;
    let mut materials = String::new();
    let mut objects = String::new();
    for (i, alpha) in GLOSSES.into_iter().enumerate() {
        materials += &format!("materials.gloss{i}.conductor = {{ reflectance = 0.9, alpha = {alpha} }}\n");
        let sphere = format!("{{ center = [{:?}, 0.8, 0.0], radius = 0.85 }}", place(i));
        objects += &format!("[[objects]]\nshape.sphere = {sphere}\nmaterial = 'gloss{i}'\n");
    }
    for (i, radius) in LIGHTS.into_iter().enumerate() {
        let sphere = format!("{{ center = [{:?}, 3.0, 1.0], radius = {radius} }}", place(i));
        objects += &format!("[[objects]]\nshape.sphere = {sphere}\nemission.radiance = {:?}\n", 1.0 / (radius * radius));
    }
    let camera = "camera = { eye = [0.0, 2.0, 9.0], look_at = [0.0, 0.9, 0.0], fov = 45.0, resolution = [64, 32] }";
    scene(&format!("{camera}\n{materials}{objects}"))
}

#[test]
fn both_together_are_better_than_either_where_lights_and_glosses_range_from_tiny_to_wide() {
    const SPP: u32 = 512;
    let scene = lamps_and_glosses();
    let pictures = [Estimator::Path, Estimator::Light, Estimator::Mis].map(|estimator| {
        let settings = RenderSettings { max_bounces: Some(1), ..settings(estimator) };
        picture(&scene, settings, LUMINANCE, SPP)
    });
    let variances = pictures.map(|picture| picture.pixels.iter().map(|pixel| pixel.variance_of_mean).sum::<f64>());
    let [path, light, mis] = variances;
    println!("variances: path {path:.3e}, light {light:.3e}, mis {mis:.3e}");
    // If samples rarely find light, the sample variance is too low, and never much too high. The two single strategies are
    // therefore worse than measured here.
    assert!(mis < path && mis < light, "path {path:.3e}, light {light:.3e}, mis {mis:.3e}");
}

/// The estimators besides `path`.
fn beside_path() -> impl Iterator<Item = Estimator> {
    Estimator::ALL.into_iter().filter(|estimator| *estimator != Estimator::Path)
}

#[test]
fn they_agree_on_rough_glass_that_shines() {
    for side in ["radiance = 1.0", "radiance = 1.0, two_sided = true", "radiance = 1.0 }\nflip = true\n#"] {
        let text = format!(
            "camera = {{ eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 30.0, resolution = [16, 16] }}
            environment.radiance = 0.2
            materials.glow.dielectric = {{ ior = 1.5, roughness = 0.5 }}
            [[objects]]
            shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
            material = 'glow'
            emission = {{ {side} }}"
        );
        let scene = scene(&text);
        let of = |estimator: Estimator| picture(&scene, settings(estimator), LUMINANCE, 2048).whole();
        let path = of(Estimator::Path);
        let deviations: Vec<f64> = beside_path().map(|estimator| of(estimator).z_from(path)).collect();
        println!("{side}: {:.5}, {deviations:?}", path.mean);
        assert_all_within(&deviations, side);
    }
}

/// Enough lights for a light tree: of all shapes and sides, around balls and below a floor, in a shell that emits
/// inwards.
fn hundreds_of_punctual() -> Scene {
    let mut objects = String::new();
    let mut object = |text: &str| objects += &format!("[[objects]]\n{text}\n");
    object("shape.sphere = { center = [0.0, 0.0, 0.0], radius = 50.0 }\nemission.radiance = 0.05\nflip = true");
    object(
        "shape.rectangle = { origin = [-4.0, 0.0, 4.0], edge_u = [8.0, 0.0, 0.0], edge_v = [0.0, 0.0, -8.0] }\nmaterial = 'white'",
    );
    object("shape.sphere = { center = [-1.0, 0.8, 0.0], radius = 0.7 }\nmaterial = 'rough'");
    object("shape.sphere = { center = [1.0, 0.8, 0.0], radius = 0.7 }\nmaterial = 'gloss'");
    for i in 0..400 {
        let part = |step: f64| (f64::from(i) * step).fract();
        let [x, y, z] = [8.0 * part(0.618_034) - 4.0, 3.0 * part(0.414_214) - 0.5, 8.0 * part(0.732_051) - 4.0];
        let [a, b, c] = [part(0.236_068) - 0.5, part(0.645_751) - 0.5, part(0.316_625) - 0.5];
        let shape = match i % 4 {
            0 => format!("sphere = {{ center = [{x}, {y}, {z}], radius = 0.1 }}"),
            1 => format!("disk = {{ center = [{x}, {y}, {z}], normal = [{a}, {b}, {c}], radius = 0.2 }}"),
            2 => format!("triangle = {{ a = [{x}, {y}, {z}], b = [{}, {y}, {}], c = [{x}, {}, {z}] }}", x + a, z + c, y + b),
            _ => format!("cylinder = {{ base = [{x}, {y}, {z}], top = [{}, {}, {}], radius = 0.05 }}", x + a, y + b, z + c),
        };
        let [power, two_sided] = [0.3 + 3.0 * part(0.141_593), f64::from(i % 3)];
        object(&format!("shape.{shape}\nemission = {{ radiance = {power}, two_sided = {} }}", two_sided == 0.0));
    }
    scene(&format!(
        "camera = {{ eye = [0.0, 2.5, 7.0], look_at = [0.0, 0.6, 0.0], fov = 45.0, resolution = [48, 32] }}
        environment.radiance = 0.1
        materials.white.lambertian.albedo = 0.7
        materials.rough.dielectric = {{ ior = 1.5, roughness = 0.5 }}
        materials.gloss.plastic = {{ albedo = 0.4, ior = 1.5, roughness = 0.3 }}
        {objects}"
    ))
}

#[test]
fn they_agree_among_hundreds_of_lights() {
    let scene = hundreds_of_punctual();
    let of = |estimator: Estimator| {
        let settings = RenderSettings { max_bounces: Some(3), ..settings(estimator) };
        means(&picture(&scene, settings, LUMINANCE, if estimator == Estimator::Path { 1024 } else { 256 }))
    };
    let path = of(Estimator::Path);
    let mut deviations = Vec::new();
    // Nearly all paths of `light_tracing` start at the shell and pass the scene by: its means are not normally distributed.
    for estimator in beside_path().filter(|estimator| *estimator != Estimator::LightTracing) {
        deviations.extend(path.iter().zip(of(estimator)).map(|(a, b)| b.z_from(*a)));
        let whole = deviations[deviations.len() - 1];
        println!("whole image: {:.5}, {} deviates by {whole:.2} σ", path[path.len() - 1].mean, estimator.name());
    }
    assert_all_within(&deviations, "estimators among hundreds of lights");
}
