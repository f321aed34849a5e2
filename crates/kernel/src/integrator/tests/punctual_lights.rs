//! Punctual lights in rendered scenes: against formulas, and the estimators against each other.
use crate::integrator::{Batch, TILE, Work, replay, trace};
use noisefall_base::math::{SimdLevel, colour::luminance};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, RenderSettings, Reuse, Scene, parse},
};

const FLOOR: &str =
    "[[objects]]\nshape.rectangle = { origin = [-9, 0, 9], edge_u = [18, 0, 0], edge_v = [0, 0, -18] }\nmaterial = 'grey'\n";
const POINT: &str = "[[lights]]\nname = 'bulb'\npoint = { position = [0, 2, 0], intensity = [8, 4, 2] }\n";

fn scene(head: &str, rest: &str) -> Scene {
    let text = format!("format = 1\n{head}\nmaterials.grey.lambertian.albedo = 0.5\n{rest}");
    parse("inline.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// One pixel that sees the floor at (x, 0, 0).
fn at(x: f64, rest: &str) -> Scene {
    at_with("", x, rest)
}

fn at_with(materials: &str, x: f64, rest: &str) -> Scene {
    let head = format!("{materials}camera = {{ eye = [{x}, 0.5, 3], look_at = [{x}, 0, 0], fov = 0.02, resolution = [1, 1] }}");
    scene(&head, &format!("{FLOOR}{rest}"))
}

/// The radiance of the pixel by direct light.
fn direct(scene: &Scene, estimator: Estimator) -> [f32; 3] {
    let settings = RenderSettings { estimator, max_bounces: Some(1), reuse: Reuse::Off, ..RenderSettings::default() };
    let rays = scene.rays(&scene.camera);
    let work = Work::tile(scene, &rays, &settings, [0, 0], [1, 1], 3);
    let mut batch = Batch::default();
    trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
    let [r, g, b, _] = batch.radiance()[0];
    [r, g, b]
}

/// The estimators whose light all arrives in the tile that is traced.
fn from_camera() -> impl Iterator<Item = Estimator> {
    Estimator::ALL.into_iter().filter(|estimator| !estimator.traces_light_paths())
}

fn is_lit_by(scene: &Scene, irradiance: [f64; 3]) {
    for estimator in from_camera() {
        let found = direct(scene, estimator);
        for (found, irradiance) in found.into_iter().zip(irradiance) {
            let exact = 0.5 / std::f64::consts::PI * irradiance;
            assert!((f64::from(found) - exact).abs() <= 1e-3 * exact, "{estimator:?}: {found} for {exact}");
        }
    }
}

#[test]
fn the_floor_under_a_point_light_has_its_irradiance() {
    is_lit_by(&at(0.0, POINT), [2.0, 1.0, 0.5]);
    // 1.5 m aside: the distance is 2.5 m, and the cosine 0.8.
    is_lit_by(&at(1.5, POINT), [8.0, 4.0, 2.0].map(|x| x * 0.8 / 6.25));
}

#[test]
fn other_lamps_have_theirs() {
    is_lit_by(&at(1.0, "[[lights]]\ndirectional = { direction = [3, -4, 0], irradiance = [5, 2.5, 1] }"), [4.0, 2.0, 0.8]);
    let spot = "[[lights]]\nspot = { position = [0, 2, 0], target = [0, 0, 0], intensity = 8, angle = 30, inner = 20 }";
    is_lit_by(&at(0.0, spot), [2.0; 3]);
    is_lit_by(&at(2.0, spot), [0.0; 3]);
    let projector = "[[lights]]\nprojector = { position = [0, 2, 0], target = [0, 0, 0], up = [0, 0, -1], fov = 50, scale = 8 }";
    is_lit_by(&at(0.0, projector), [2.0; 3]);
    is_lit_by(&at(1.0, projector), [0.0; 3]);
    // The transform is applied: the light goes from 1 m to 2 m over the floor.
    let moved = "[[lights]]\npoint = { position = [0, 1, 0], intensity = 8 }\ntransform = [{ translate = [0, 1, 0] }]";
    is_lit_by(&at(0.0, moved), [2.0; 3]);
}

#[test]
fn a_surface_in_between_hides_a_light_and_one_behind_it_does_not() {
    let disk = |height: f64| {
        format!(
            "[[objects]]\nshape.disk = {{ center = [0, {height}, 0], normal = [0, -1, 0], radius = 0.3 }}\nmaterial = 'grey'\n"
        )
    };
    is_lit_by(&at(0.0, &format!("{}{POINT}", disk(1.0))), [0.0; 3]);
    is_lit_by(&at(0.0, &format!("{}{POINT}", disk(1.999))), [0.0; 3]);
    is_lit_by(&at(0.0, &format!("{}{POINT}", disk(2.001))), [2.0, 1.0, 0.5]);
    let sun = "[[lights]]\ndirectional = { direction = [0, -1, 0], irradiance = 1 }";
    is_lit_by(&at(0.0, &format!("{}{sun}", disk(1e4))), [0.0; 3]);
    is_lit_by(&at(1.0, &format!("{}{sun}", disk(1e4))), [1.0; 3]);
    // Below the floor.
    is_lit_by(&at(0.0, "[[lights]]\npoint = { position = [0, -2, 0], intensity = 8 }"), [0.0; 3]);
}

#[test]
fn surfaces_of_some_opacity_dim_all_lights() {
    // Primitives that do not emit are numbered on where lights begin: each number of a light is that of a screen, too.
    let punctual_lights = [
        "point = { position = [0, 2, 0], intensity = 8 }",
        "directional = { direction = [0, -1, 0], irradiance = 2 }",
        "spot = { position = [0, 2, 0], target = [0, 0, 0], intensity = 8, angle = 30, inner = 20 }",
        "projector = { position = [0, 2, 0], target = [0, 0, 0], up = [0, 0, -1], fov = 50, scale = 8 }",
    ];
    let screen = |height: f64| {
        format!(
            "[[objects]]\nshape.disk = {{ center = [0, {height}, 0], normal = [0, -1, 0], radius = 0.3 }}\nmaterial = 'screen'\n"
        )
    };
    let screens: String = [0.6, 0.9, 1.2, 1.5].map(screen).concat();
    let quarter = "materials.screen = { lambertian.albedo = 0, opacity = 0.75 }\n";
    for (count, punctual_light) in (1..).zip(punctual_lights) {
        is_lit_by(&at_with(quarter, 0.0, &format!("{screens}[[lights]]\n{punctual_light}\n")), [2.0 / 256.0; 3]);
        let punctual_lights: String =
            punctual_lights[..count].iter().map(|punctual_light| format!("[[lights]]\n{punctual_light}\n")).collect();
        let [(found, error), ..] =
            mean(&at_with(quarter, 0.0, &format!("{screens}{punctual_lights}")), Estimator::Light, Reuse::Off, 200);
        let exact = 0.5 / std::f64::consts::PI * 2.0 / 256.0 * count as f64;
        assert!((found - exact).abs() < 1e-3 * exact + 4.0 * error, "{count} lights: {found} ± {error} for {exact}");
    }
}

#[test]
fn all_estimators_agree_where_light_of_lights_and_emitters_passes_through_surfaces() {
    let materials = "\nmaterials.screen = { lambertian.albedo = [0.2, 0.5, 0.7], opacity = 0.5 }
        materials.leaf = { blend = { first = 'screen', second = 'coated', weight = 0.4 } }
        materials.hole = { blend = { first = 'screen', second = 'null', weight = 0.5 } }
        materials.null.null = {}\n";
    let screens = ["screen", "leaf", "hole"].iter().zip([1.6, 1.9, 2.2]).map(|(material, height)| {
        format!(
            "[[objects]]\nshape.rectangle = {{ origin = [-3, {height}, 2], edge_u = [6, 0, 0], edge_v = [0, 0.2, -4] }}\n\
             material = '{material}'\n"
        )
    });
    let screens: String = screens.collect();
    let shell = AREA.replace("emission", "material = 'screen'\nemission");
    for area in ["", AREA, &shell] {
        agree(&scene(&[VIEW, materials].concat(), &[FLOOR, BALLS, &screens, area, ALL_LIGHTS].concat()), 300);
    }
}

#[test]
fn an_emitter_behind_a_light_is_not_taken_for_it() {
    // Light numbers of lights follow those of surfaces, and so do the primitives that do not emit.
    let emitter = "[[objects]]\nshape.sphere = { center = [0, 500, 0], radius = 1 }\nemission.radiance = 1e-6\n";
    let dark = "[[objects]]\nshape.disk = { center = [0, 1, 0], normal = [0, -1, 0], radius = 0.3 }\n";
    let scene = at(0.0, &format!("{emitter}{POINT}"));
    let [r, ..] = mean(&scene, Estimator::Mis, Reuse::Off, 400);
    assert!((r.0 / (0.5 / std::f64::consts::PI * 2.0) - 1.0).abs() < 0.01 + 4.0 * r.1, "{r:?}");
    let hidden = at(0.0, &format!("{dark}{emitter}{POINT}"));
    assert!(mean(&hidden, Estimator::Light, Reuse::Off, 400)[0].0 < 1e-5);
}

/// Mean radiance of the image by channel, with its standard error, over independent samples.
fn mean(scene: &Scene, estimator: Estimator, reuse: Reuse, samples: u32) -> [(f64, f64); 3] {
    let settings = RenderSettings { estimator, reuse, sampler: Sampler::Independent, ..RenderSettings::default() };
    let rays = scene.rays(&scene.camera);
    let size = scene.camera.resolution;
    let mut batch = Batch::default();
    let mut sums = [[0.0; 2]; 3];
    for sample in 0..samples {
        let work = Work::tile(scene, &rays, &settings, [0, 0], size, sample);
        trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (y * TILE + x) as usize));
        let total = pixels.fold([0.0; 3], |sum, at| [0, 1, 2].map(|c| sum[c] + f64::from(batch.radiance()[at][c])));
        for (sums, total) in sums.iter_mut().zip(total) {
            let x = total / f64::from(size[0] * size[1]);
            *sums = [sums[0] + x, sums[1] + x * x];
        }
    }
    let n = f64::from(samples);
    sums.map(|[sum, squares]| (sum / n, ((squares / n - (sum / n).powi(2)).max(0.0) / (n - 1.0)).sqrt()))
}

/// Two means are the same at the significance of four standard errors, 6e-5.
fn same(a: (f64, f64), b: (f64, f64), what: &str) {
    assert!((a.0 - b.0).abs() < 4.0 * a.1.hypot(b.1) + 1e-9, "{what}: {a:?} {b:?}");
}

const VIEW: &str = "camera = { eye = [0, 2, 6], look_at = [0, 1, 0], fov = 40, resolution = [32, 32] }
materials.coated.plastic = { albedo = [0.6, 0.3, 0.2], ior = 1.5, roughness = 0.3 }
materials.metal.conductor = { reflectance = 0.8, roughness = 0.4 }
materials.frosted.dielectric = { ior = 1.5, roughness = 0.4 }";

const BALLS: &str = "
[[objects]]
shape.sphere = { center = [-1.2, 0.7, 0], radius = 0.7 }
material = 'coated'
[[objects]]
shape.sphere = { center = [1.2, 0.7, 0], radius = 0.7 }
material = 'metal'
[[objects]]
shape.sphere = { center = [0, 0.5, 1], radius = 0.5 }
material = 'frosted'
[[objects]]
shape.rectangle = { origin = [-4, 0, -2], edge_u = [8, 0, 0], edge_v = [0, 5, 0] }
material = 'grey'
";

const ALL_LIGHTS: &str = "
[[lights]]
point = { position = [0.5, 2.5, 1], intensity = [3, 2, 1] }
[[lights]]
spot = { position = [-2, 3, 2], target = [-1, 0, 0], intensity = 9, angle = 30, inner = 10, falloff = 'linear' }
[[lights]]
directional = { direction = [-1, -2, -1], irradiance = [0.2, 0.3, 0.5] }
[[lights]]
projector = { position = [3, 2, 3], target = [0, 1, -2], fov = 40, scale = 8 }
";

const AREA: &str = "
[[objects]]
shape.sphere = { center = [-0.5, 3.5, 1], radius = 0.4 }
emission.radiance = [6, 7, 8]
";

fn agree(scene: &Scene, samples: u32) {
    let [path, light, mis] = [Estimator::Path, Estimator::Light, Estimator::Mis].map(|e| mean(scene, e, Reuse::Off, samples));
    for ((path, light), mis) in path.into_iter().zip(light).zip(mis) {
        assert!(mis.0 > 0.02, "it is not dark: {mis:?}");
        same(path, light, "path and light");
        same(light, mis, "light and MIS");
    }
}

#[test]
fn all_estimators_agree_under_lights_and_emitters() {
    let scene = scene(VIEW, &[FLOOR, BALLS, AREA, ALL_LIGHTS].concat());
    agree(&scene, 300);
}

#[test]
fn all_estimators_agree_under_lights_alone() {
    let scene = scene(VIEW, &[FLOOR, BALLS, ALL_LIGHTS].concat());
    agree(&scene, 200);
}

#[test]
fn lights_and_emitters_together_are_the_sum_of_both_alone() {
    let [both, punctual_lights, emitters] = [[AREA, ALL_LIGHTS].concat(), ALL_LIGHTS.to_owned(), AREA.to_owned()]
        .map(|lights| mean(&scene(VIEW, &[FLOOR, BALLS, &lights].concat()), Estimator::Mis, Reuse::Off, 300));
    for c in 0..3 {
        let sum = (punctual_lights[c].0 + emitters[c].0, punctual_lights[c].1.hypot(emitters[c].1));
        same(both[c], sum, "both and the sum");
    }
}

#[test]
fn reused_paths_find_lights_without_bias() {
    let room = [FLOOR, BALLS, AREA, ALL_LIGHTS].concat();
    let room = room.replace("material = 'frosted'", "material = 'grey'");
    let scene = scene(VIEW, &room);
    for estimator in from_camera() {
        let [alone, shared] = [Reuse::Off, Reuse::Suffixes].map(|reuse| mean(&scene, estimator, reuse, 300));
        (0..3).for_each(|c| same(alone[c], shared[c], estimator.name()));
    }
}

#[test]
fn a_replay_names_its_light_and_adds_up_to_the_sample() {
    let scene = scene(VIEW, &[FLOOR, BALLS, POINT].concat());
    let rays = scene.rays(&scene.camera);
    let (mut named, mut seen) = (0, 0);
    for estimator in Estimator::ALL {
        let settings = RenderSettings { estimator, reuse: Reuse::Off, ..RenderSettings::default() };
        for pixel in (0..64).map(|i| [i % 8 * 4, i / 8 * 4]) {
            let replay = replay(&scene, &rays, &settings, pixel, 0);
            let terms = replay.vertices.iter().flat_map(|vertex| {
                let emission = vertex.emission.as_ref().map(|emission| emission.contribution);
                [emission, vertex.light.as_ref().map(|light| light.contribution)]
            });
            let sum = terms.flatten().fold(0.0, |sum, term| sum + luminance(term));
            let found = luminance(replay.alone.unwrap_or(replay.radiance));
            assert!((sum - found).abs() < 1e-4 * (1.0 + sum), "{sum} {found}");
            for light in replay.vertices.iter().filter_map(|vertex| vertex.light.as_ref()) {
                named += u32::from(light.punctual_light.as_deref() == Some("bulb") && light.object.is_none());
                seen += u32::from(light.contribution != [0.0; 3]);
                assert!(light.weight == 1.0 || light.pdf == 0.0);
            }
        }
    }
    assert!(named > 100 && seen > 100, "{named} {seen}");
}

#[test]
fn a_scene_lit_by_lights_alone_is_not_black() {
    let scene = scene(VIEW, &[FLOOR, POINT].concat());
    assert!(!scene.lights.is_empty() && !scene.lights.can_be_hit());
    assert!(!scene.warnings().iter().any(|warning| warning.contains("emits light")), "{:?}", scene.warnings());
    let off = self::scene(VIEW, &[FLOOR, "[[lights]]\npoint = { position = [0, 1, 0], intensity = 0 }"].concat());
    assert!(off.lights.is_empty(), "a light without intensity is off");
}
