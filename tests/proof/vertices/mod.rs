//! A replayed path is the renderer's own, bit for bit, and so are the terms that its vertices list.
mod tally;

use std::{f32::consts::PI, path::Path};

use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{
    Batch, LightOutcome, Replay, SharedLight, TILE, Vertex, Work, pixel_samples, replay, thresholds, trace,
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, CameraRays, Estimator, RenderSettings, Reuse, Roulette, Scene, load},
};

use self::tally::Tally;
use crate::{path_reuse::ROOM, picture::scene};

/// A resolution of two by two tiles, with partial outer tiles.
const RESOLUTION: [u32; 2] = [48, 40];
const PIXELS: [[u32; 2]; 4] = [[3, 9], [24, 13], [31, 31], [16, 25]];
/// Pixels of a partial tile.
const OUTER_PIXELS: [[u32; 2]; 2] = [[40, 35], [47, 39]];

/// In a ball of tinted glass: a light that a texture varies, a matt ball, and the camera.
const LANTERN: &str = r#"
[camera]
eye = [0.0, 0.0, 2.0]
look_at = [0.0, 0.0, 0.0]
fov = 60.0
resolution = [48, 40]
[textures.flame]
checker = { even = [0.9, 0.5, 0.2], odd = 0.1, scale = 8.0 }
[materials]
tinted = { dielectric = { ior = 1.5, transmittance = [0.9, 0.7, 0.5] } }
white = { lambertian = { albedo = 0.8 } }
[[objects]]
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 3.0 } }
material = "tinted"
[[objects]]
shape = { sphere = { center = [0.0, -0.8, 0.0], radius = 0.8 } }
material = "white"
[[objects]]
name = "light"
shape = { sphere = { center = [0.0, 1.2, 0.0], radius = 0.6 } }
emission = { texture = "flame", scale = 10.0 }
"#;

/// All shipped scenes, one with all features, and one where light samples meet media and textures.
fn scenes() -> Vec<(String, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut files: Vec<_> = std::fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let shipped = files.iter().map(|path| (path.display().to_string(), load(path).expect("a scene")));
    shipped.chain([("room".to_owned(), scene(ROOM)), ("lantern".to_owned(), scene(LANTERN))]).collect()
}

fn rays(scene: &Scene) -> CameraRays {
    scene.rays(&Camera { resolution: RESOLUTION, ..scene.camera })
}

/// Estimators, roulettes and caps in all combinations, with every sampler if paths are not reused. Without roulette there is
/// always a cap, because paths between white walls would not end.
fn all_settings(seed: u32) -> Vec<RenderSettings> {
    let endings = [
        (Roulette::Off, Some(12)),
        (Roulette::fixed(0.7), None),
        (Roulette::by_throughput_from(1), None),
        (Roulette::BY_THROUGHPUT, Some(3)),
    ];
    let mut all = Vec::new();
    // A replay follows one path, and that from the camera alone.
    for estimator in Estimator::ALL.into_iter().filter(|estimator| !estimator.traces_light_paths()) {
        for (roulette, max_bounces) in endings {
            let settings = RenderSettings { estimator, roulette, max_bounces, seed, ..RenderSettings::default() };
            all.extend(Sampler::ALL.into_iter().map(|sampler| RenderSettings { sampler, reuse: Reuse::Off, ..settings }));
            let sampler = Sampler::ALL[all.len() / 7 % Sampler::ALL.len()];
            all.extend([Reuse::Suffixes, Reuse::Outliers, Reuse::Both].map(|reuse| RenderSettings {
                sampler,
                reuse,
                ..settings
            }));
        }
    }
    all
}

/// The renderer's samples of some pixels of the tile at `origin`.
fn rendered(
    level: SimdLevel,
    (scene, rays, settings): (&Scene, &CameraRays, &RenderSettings),
    origin: [u32; 2],
    sample: u32,
    batch: &mut Batch,
) -> impl Fn([u32; 2]) -> [u32; 3] {
    let size = [0, 1].map(|axis| TILE.min(RESOLUTION[axis] - origin[axis]));
    let work = Work::tile(scene, rays, settings, origin, size, sample);
    let thresholds = thresholds(level, &work, batch, &|| false).expect("nothing interrupts");
    trace(level, &Work { thresholds: thresholds.as_ref(), ..work }, batch, &|| false).expect("nothing interrupts");
    let radiance = batch.radiance();
    move |[x, y]| {
        let [r, g, b, _] = radiance[((y - origin[1]) * TILE + x - origin[0]) as usize];
        bits([r, g, b])
    }
}

fn bits(colour: [f32; 3]) -> [u32; 3] {
    colour.map(f32::to_bits)
}

fn product(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|c| a[c] * b[c])
}

#[test]
fn replayed_samples_are_those_of_the_renderer_and_their_vertices_add_up_to_them() {
    let levels = SimdLevel::available();
    let mut batch = Batch::default();
    let mut tally = Tally::default();
    for (number, (name, scene)) in scenes().iter().enumerate() {
        let rays = rays(scene);
        for (i, settings) in all_settings(number as u32).iter().enumerate() {
            // With path reuse, each sample needs a whole tile.
            let pixels = if settings.reuse != Reuse::Off { &PIXELS[i % 4..=i % 4] } else { &PIXELS[..] };
            let rendered = rendered(levels[i % levels.len()], (scene, &rays, settings), [0, 0], i as u32, &mut batch);
            for pixel in pixels {
                let replay = replay(scene, &rays, settings, *pixel, i as u32);
                let what = format!("{name}, {settings:?}, pixel {pixel:?}, sample {i}");
                assert_eq!(bits(replay.radiance), rendered(*pixel), "{what}");
                assert_sums(&replay, &what);
                assert_path(&replay, &what);
                for vertex in &replay.vertices {
                    assert_surface(vertex, &what);
                    assert_terms(vertex, settings, &what);
                    tally.count(vertex);
                }
            }
        }
    }
    tally.assert_everything_was_met();
}

/// Checks that the surface is at the end of the segment, with normals on the side of the viewer.
fn assert_surface(vertex: &Vertex, what: &str) {
    assert_eq!(vertex.surface.is_some(), vertex.object.is_some(), "{what}");
    let (Some(surface), Some(distance)) = (&vertex.surface, vertex.distance) else { return };
    let extent = vertex.origin.iter().fold(distance, |extent, x| extent.max(x.abs()));
    for c in 0..3 {
        let end = vertex.origin[c] + vertex.direction[c] * distance;
        assert!((surface.position[c] - end).abs() <= 1e-4 * extent, "{vertex:#?} of {what}");
        assert_eq!(surface.wo[c], -vertex.direction[c]);
    }
    for normal in [vertex.normal, surface.shading_normal].into_iter().flatten() {
        let [x, y, z] = product(normal, surface.wo);
        let [xx, yy, zz] = product(normal, normal);
        assert!(x + y + z > -1e-6 && (xx + yy + zz - 1.0).abs() < 1e-5, "{vertex:#?} of {what}");
    }
}

/// Checks that the contributions, added in order, are the sample.
fn assert_sums(replay: &Replay, what: &str) {
    let mut sum = [0f32; 3];
    for vertex in &replay.vertices {
        let emission = vertex.emission.iter().map(|emission| emission.contribution);
        for contribution in emission.chain(vertex.light.iter().map(|light| light.contribution)) {
            sum = [0, 1, 2].map(|c| sum[c] + contribution[c]);
        }
        assert_eq!(bits(sum), bits(vertex.radiance), "bounce {} of {what}", vertex.bounce);
    }
    assert_eq!(bits(sum), bits(replay.alone.unwrap_or(replay.radiance)), "{what}");
    assert_eq!(replay.alone.is_some(), replay.shared.is_some(), "{what}");
    replay.shared.iter().for_each(|shared| assert_shared(replay, shared, what));
}

/// Checks that the light of a pixel and of its neighbours adds up to its sample.
fn assert_shared(replay: &Replay, shared: &SharedLight, what: &str) {
    let emissions = replay.vertices.iter().flat_map(|vertex| &vertex.emission).map(|term| (term.shared, term.contribution));
    let lights = replay.vertices.iter().flat_map(|vertex| &vertex.light).map(|term| (term.shared, term.contribution));
    let terms: Vec<(bool, [f32; 3])> = emissions.chain(lights).collect();
    let near = |a: f32, b: f32| (a - b).abs() <= 1e-5 * (a.abs() + b.abs()) + 1e-6;
    for c in 0..3 {
        let sum = |of: bool| terms.iter().filter(|(shared, _)| *shared == of).map(|(_, term)| term[c]).sum::<f32>();
        assert!(near(sum(false), shared.unshared[c]), "{what}: {shared:?} {terms:?}");
        assert!(shared.kept[c] >= 0.0 && shared.kept[c] <= sum(true) * 1.0001 + 1e-6, "{what}: {shared:?} {terms:?}");
        let parts = shared.unshared[c] + shared.kept[c] + shared.from_neighbours[c];
        assert!(near(parts, replay.radiance[c]), "{what}: {shared:?} {:?}", replay.radiance);
    }
}

/// Checks that every vertex starts with the final state of the previous one.
fn assert_path(replay: &Replay, what: &str) {
    for (k, vertex) in replay.vertices.iter().enumerate() {
        assert_eq!(vertex.bounce, k as u32, "{what}");
        let reflection = vertex.reflection.as_ref().filter(|reflection| reflection.goes_on);
        let next = replay.vertices.get(k + 1);
        assert_eq!(reflection.is_some(), next.is_some(), "bounce {k} of {what}");
        let (Some(reflection), Some(next)) = (reflection, next) else { continue };
        assert_eq!(bits(reflection.throughput), bits(next.throughput), "bounce {k} of {what}");
        assert_eq!(bits(reflection.direction), bits(next.direction), "bounce {k} of {what}");
        assert!(reflection.survives, "bounce {k} of {what}");
    }
}

/// Checks the relations between the terms of a vertex.
fn assert_terms(vertex: &Vertex, settings: &RenderSettings, what: &str) {
    let near = |a: [f32; 3], b: [f32; 3], tolerance: f32| {
        let close = |c: usize| (a[c] - b[c]).abs() <= tolerance * a[c].abs().max(b[c].abs()).max(1e-30);
        assert!((0..3).all(close), "{a:?} and {b:?} at {vertex:#?} of {what}");
    };
    let arriving = product(vertex.throughput, vertex.transmittance);
    if let Some(emission) = &vertex.emission {
        near(emission.contribution, product(arriving, emission.radiance.map(|x| x * emission.weight)), 1e-6);
        match settings.estimator {
            Estimator::Path => assert_eq!(emission.weight, 1.0),
            Estimator::Light => assert!([0.0, 1.0].contains(&emission.weight)),
            _ => assert!((0.0..=1.0).contains(&emission.weight)),
        }
    }
    if let Some(light) = &vertex.light {
        assert!(settings.estimator != Estimator::Path || light.object.is_none());
        assert!((0.0..=1.0).contains(&light.weight));
        let seen = light.outcome == LightOutcome::Seen;
        assert!(seen || light.contribution == [0.0; 3]);
        // The shadow ray ends at the light or at an occluder. Environments have no position.
        let ends = if seen { light.object.is_some() } else { light.outcome == LightOutcome::Hidden };
        let has_end = light.distance.is_some_and(|distance| distance > 0.0);
        // A punctual light may be infinitely far away.
        assert!(has_end == ends || (seen && light.punctual_light.is_some()), "{what}");
        if seen {
            let scale = light.weight / light.pdf;
            let incident = product(light.radiance.map(|x| x * scale), light.passed);
            near(light.contribution, product(product(arriving, light.f_cos), incident), 1e-5);
        }
    }
    if let Some(reflection) = &vertex.reflection {
        assert!((0.0..=1.0001).contains(&reflection.cos), "{} of {what}", reflection.cos);
        let weighted = product(arriving, reflection.weight.map(|x| x / reflection.survival));
        if reflection.goes_on {
            near(reflection.throughput, weighted, 1e-5);
        }
        if let (Some(f), Some(pdf), true) = (reflection.f, reflection.pdf, reflection.goes_on) {
            near(reflection.weight, f.map(|f| f * reflection.cos / pdf), 1e-5);
            if vertex.surface.as_ref().and_then(|surface| surface.material) == Some("lambertian") {
                near([pdf; 3], [reflection.cos / PI; 3], 1e-5);
            }
        }
        match settings.roulette {
            Roulette::Off => assert_eq!(reflection.survival, 1.0),
            Roulette::Fixed(fixed) => assert_eq!(reflection.survival, fixed.survival),
            Roulette::Throughput(throughput) if vertex.bounce + 1 < throughput.start => assert_eq!(reflection.survival, 1.0),
            Roulette::Throughput(_) => {
                let material = vertex.surface.as_ref().and_then(|surface| surface.material);
                let throughput = product(arriving, reflection.weight).into_iter().fold(0.0, f32::max);
                // Radiance inside glass is scaled to its value outside. With path reuse the first surface does not count.
                if material != Some("dielectric") && settings.reuse == Reuse::Off {
                    let expected = throughput.sqrt().clamp(Roulette::LEAST, Roulette::MOST);
                    assert!((reflection.survival - expected).abs() <= 1e-5 * expected, "{expected} at {vertex:#?} of {what}");
                }
                assert!((Roulette::LEAST..=Roulette::MOST).contains(&reflection.survival));
            }
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            _ => assert!((Roulette::LEAST..=1.0).contains(&reflection.survival)),
        }
    }
}

#[test]
fn the_samples_of_a_pixel_are_those_of_the_renderer() {
    let level = SimdLevel::best();
    let mut batch = Batch::default();
    for (name, scene) in scenes() {
        let rays = rays(&scene);
        for reuse in [Reuse::Off, Reuse::Suffixes, Reuse::Outliers, Reuse::Both] {
            let estimator = if scene.traces_light_paths(&scene.settings) { Estimator::Mis } else { scene.settings.estimator };
            let settings = RenderSettings { reuse, estimator, ..scene.settings };
            // The range neither starts nor ends at a multiple of the batch.
            let numbers = 5..27;
            let of = |pixel: [u32; 2]| pixel_samples(&scene, &rays, &settings, pixel, numbers.clone(), &|| false);
            let pixels = [PIXELS[1], PIXELS[2], OUTER_PIXELS[0], OUTER_PIXELS[1]];
            let samples = pixels.map(|pixel| of(pixel).expect("nothing interrupts"));
            for (place, sample) in numbers.clone().enumerate() {
                for (pixel, samples) in pixels.iter().zip(&samples) {
                    let origin = pixel.map(|x| x / TILE * TILE);
                    let rendered = rendered(level, (&scene, &rays, &settings), origin, sample, &mut batch);
                    assert_eq!(bits(samples[place]), rendered(*pixel), "{name}, {reuse:?}, pixel {pixel:?}, sample {sample}");
                }
            }
            assert!(samples.iter().all(|samples| samples.len() == numbers.len()));
        }
    }
}

#[test]
fn taking_the_samples_of_a_pixel_can_be_interrupted() {
    let scene = noisefall_scene::scene::built_in();
    let taken = pixel_samples(&scene, &rays(&scene), &scene.settings, PIXELS[0], 0..100, &|| true);
    assert_eq!(taken, None);
}
