//! Path, light and mis agree for every pair of features, because features that work alone may fail together.
use noisefall_base::math::{SimdLevel, colour::luminance};
use noisefall_kernel::integrator::{Batch, TILE, Work, trace};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, RenderSettings, Reuse, Scene},
};
use rayon::prelude::*;

use crate::{
    picture::{assert_all_within, scene, settings},
    statistics::Moments,
};

macro_rules! features {
    ($($name:ident),* $(,)?) => {
        /// Features of a scene besides a floor, a ball and a light.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Feature {
            $($name),*
        }

                /// All features, in this order: a list by hand could miss one.
        const ALL: &[Feature] = &[$($name),*];
    };
}

features! {
    MovingLamp,
    MovingBall,
    MovingCamera,
    MeshLamp,
    ManyLamps,
    TexturedLamp,
    TwoSidedLamp,
    StretchedLamp,
    ImageSky,
    ConstantSky,
    Bump,
    NormalMap,
    NormalsOfMesh,
    Instances,
    Isosurface,
    Metal,
    Plastic,
    RoughGlass,
    TintedGlass,
    Lens,
    PathReuse,
}

use Feature::*;

/// Groups of features that exclude each other.
const EXCLUSIVE: [[Feature; 2]; 2] = [[ImageSky, ConstantSky], [MovingLamp, StretchedLamp]];

/// Sets of at most seven features that contain every pair once.
fn sets() -> Vec<Vec<Feature>> {
    const MOST: usize = 7;
    let fits = |set: &[Feature], feature: Feature| {
        !set.contains(&feature)
            && !EXCLUSIVE.iter().any(|pair| pair.contains(&feature) && set.iter().any(|other| pair.contains(other)))
    };
    let mut missing: Vec<[Feature; 2]> = ALL
        .iter()
        .enumerate()
        .flat_map(|(i, a)| ALL[i + 1..].iter().map(move |b| [*a, *b]))
        .filter(|pair| !EXCLUSIVE.contains(pair))
        .collect();
    let mut sets = Vec::new();
    while let Some(pair) = missing.first() {
        let mut set = pair.to_vec();
        while set.len() < MOST {
            let gain = |feature: &Feature| {
                missing.iter().filter(|[a, b]| (a == feature && set.contains(b)) || (b == feature && set.contains(a))).count()
            };
            let Some(best) = ALL.iter().copied().filter(|feature| fits(&set, *feature)).max_by_key(gain) else { break };
            set.push(best);
        }
        missing.retain(|pair| !pair.iter().all(|feature| set.contains(feature)));
        sets.push(set);
    }
    sets
}

const CUBE: &str = "vertices = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], \
    triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [3, 7, 6], [3, 6, 2], [0, 4, 7], [0, 7, 3], [1, 2, 6], [1, 6, 5]]";

fn with(set: &[Feature]) -> Scene {
    let has = |feature: Feature| set.contains(&feature);
    let on = |feature: Feature, text: &str| if has(feature) { text.to_owned() } else { String::new() };
    let sky = if has(ImageSky) {
        format!("environment = {{ image = '{}/scenes/assets/sky.exr', scale = 0.2 }}", env!("CARGO_MANIFEST_DIR"))
    } else {
        on(ConstantSky, "environment.radiance = [0.3, 0.4, 0.6]")
    };
    let emission = format!(
        "emission = {{ {}, two_sided = {} }}",
        if has(TexturedLamp) { "texture = 'light', scale = 16.0" } else { "radiance = [9.0, 8.0, 6.0]" },
        has(TwoSidedLamp)
    );
    let transform = on(StretchedLamp, "{ scale = [1.2, 0.6, 0.8] }, { rotate = { axis = [1, 1, 0], degrees = 40 } }, ");
    let motion = on(MovingLamp, "motion = [{ rotate = { axis = [0, 0, 1], degrees = 20 } }, { translate = [-1.6, 0.3, 0.6] }]");
    let mut objects = String::new();
    let mut object = |text: &str| objects += &format!("[[objects]]\n{text}\n");
    object(&format!(
        "shape.sphere = {{ center = [0, 0, 0], radius = 0.5 }}\ntransform = [{transform}{{ translate = [1.2, 1.8, 0.8] }}]\n{emission}\n{motion}"
    ));
    if has(MeshLamp) {
        object(&format!(
            "shape.mesh = {{ {CUBE} }}\ntransform = [{{ scale = 0.3 }}, {{ translate = [-1.5, 1.2, 0.3] }}]\n{emission}\n{motion}"
        ));
    }
    if has(ManyLamps) {
        for i in 0..70 {
            let part = |step: f64| (f64::from(i) * step).fract();
            let center = [4.0 * part(0.618_034) - 2.0, 2.2 + 0.5 * part(0.414_214), 3.0 * part(0.732_051) - 1.5];
            object(&format!(
                "shape.disk = {{ center = {center:?}, normal = [0.0, -1.0, 0.0], radius = 0.25 }}\nemission.radiance = {}",
                0.5 + part(0.236)
            ));
        }
    }
    let material = [(Metal, "metal"), (Plastic, "plastic"), (RoughGlass, "rough"), (TintedGlass, "tinted")];
    let materials: Vec<&str> =
        material.into_iter().filter(|(feature, _)| has(*feature)).map(|(_, name)| name).chain(["white"]).collect();
    for (i, material) in materials.iter().enumerate() {
        let center = [1.3 * i as f64 - 0.65 * (materials.len() - 1) as f64, -0.2, 0.6 * (i % 2) as f64];
        object(&format!(
            "shape.sphere = {{ center = {center:?}, radius = 0.6 }}\nmaterial = '{material}'\n{}",
            on(MovingBall, "motion = [{ translate = [0.2, 0.4, 0.1] }]")
        ));
    }
    if has(NormalsOfMesh) {
        object(&format!(
            "shape.mesh = {{ {CUBE}, smooth = true }}\ntransform = [{{ scale = 0.4 }}, {{ translate = [0.2, -0.3, 1.4] }}]\nmaterial = '{}'",
            materials[0]
        ));
    }
    if has(Instances) {
        for (degrees, place) in [(90, [0.95, -0.5, 1.8]), (20, [0.6, 0.6, 1.6])] {
            object(&format!(
                "shape.mesh.knot.triangles = 200\ntransform = [{{ scale = 0.3 }}, {{ rotate = {{ axis = [1, 0, 0], degrees = {degrees} }} }}, {{ translate = {place:?} }}]\nmaterial = '{}'",
                materials[0]
            ));
        }
    }
    if has(Isosurface) {
        object(&format!(
            "shape.isosurface = {{ expression = 'x^2 + y^2 + z^2 - 0.09 + 0.01*sin(20*x)', bounds = {{ min = [-0.35, -0.35, -0.35], max = [0.35, 0.35, 0.35] }} }}\ntransform = [{{ translate = [-0.8, -0.45, 1.8] }}]\nmaterial = '{}'",
            materials[0]
        ));
    }
    object("shape.rectangle = { origin = [-3, -0.85, 3], edge_u = [6, 0, 0], edge_v = [0, 0, -6] }\nmaterial = 'floor'");
    scene(&format!(
        "{sky}
        textures.light.checker = {{ even = 0.1, odd = [0.9, 0.8, 0.6], scale = 4.0 }}
        textures.waves.noise = {{ scale = 3.0, octaves = 2, low = 0.0, high = 1.0 }}
        [camera]
        eye = [0.0, 1.0, 4.5]
        look_at = [0.0, 0.1, 0.0]
        fov = 45.0
        resolution = [16, 16]
        shutter = [0.0, 1.0]
        {}
        {}
        [materials]
        white = {{ lambertian.albedo = [0.7, 0.6, 0.8]{} }}
        metal.conductor = {{ f0 = 0.8, alpha = 0.3 }}
        plastic.plastic = {{ albedo = [0.3, 0.5, 0.7], ior = 1.5, alpha = 0.3 }}
        rough.dielectric = {{ ior = 1.5, alpha = 0.4 }}
        tinted.dielectric = {{ ior = 1.5, transmittance = [0.4, 0.7, 0.9] }}
        floor = {{ lambertian.albedo = 0.6{} }}
        {objects}",
        on(Lens, "lens = { radius = 0.1, focus = 4.0 }"),
        on(MovingCamera, "motion = [{ translate = [0.3, 0.1, 0.0] }]"),
        on(NormalMap, &format!(", normal_map = '{}/scenes/assets/bricks_normal.png'", env!("CARGO_MANIFEST_DIR"))),
        on(Bump, ", bump = { texture = 'waves', height = 0.4 }"),
    ))
}

/// Means of the four quarters of the image, by sample. Pixels may reuse paths; samples do not.
fn quarters(scene: &Scene, settings: &RenderSettings, spp: u32) -> Vec<Moments> {
    let rays = scene.rays(&scene.camera);
    let [width, height] = scene.camera.resolution;
    let sums = |batch: &mut Batch, sample: u32| -> [f64; 4] {
        let work = Work::tile(scene, &rays, settings, [0, 0], [width, height], sample);
        trace(SimdLevel::best(), &work, batch, &|| false).expect("nothing interrupts");
        let mut sums = [0.0; 4];
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let [r, g, b, _] = batch.radiance()[(y * TILE + x) as usize];
            sums[(2 * y / height * 2 + 2 * x / width) as usize] += f64::from(luminance([r, g, b]));
        }
        // Splats of light paths add up over the paths of all pixels.
        for splat in &batch.splats {
            if let Some(([x, y], light)) = splat.land(rays.filter, [width, height]) {
                let light = luminance(light.map(|channel| channel as f32));
                sums[(2 * y / height * 2 + 2 * x / width) as usize] += f64::from(light) / f64::from(width * height);
            }
        }
        sums
    };
    let samples: Vec<[f64; 4]> = (0..spp).into_par_iter().map_init(Batch::default, sums).collect();
    (0..4).map(|quarter| Moments::of(samples.iter().map(|sums| sums[quarter]))).collect()
}

#[test]
fn path_light_and_mis_agree_wherever_two_features_meet() {
    let mut deviations = Vec::new();
    let mut names = Vec::new();
    for set in sets() {
        let scene = with(&set);
        let reuse = if set.contains(&PathReuse) { Reuse::Suffixes } else { Reuse::Off };
        let of = |estimator: Estimator| {
            let settings = RenderSettings { reuse, sampler: Sampler::Independent, max_bounces: Some(6), ..settings(estimator) };
            quarters(&scene, &settings, if estimator == Estimator::Path { 2048 } else { 768 })
        };
        let mis = of(Estimator::Mis);
        // Of light from far away, forward tracing finds so little that its means are not normally distributed.
        let is_far = set.contains(&ImageSky) || set.contains(&ConstantSky);
        let is_left_out = |estimator: &Estimator| *estimator == Estimator::Mis || is_far && *estimator == Estimator::LightTracing;
        for estimator in Estimator::ALL.into_iter().filter(|estimator| !is_left_out(estimator)) {
            for (quarter, (a, b)) in of(estimator).iter().zip(&mis).enumerate() {
                deviations.push((a.mean - b.mean) / (a.variance / a.count + b.variance / b.count).sqrt());
                names.push(format!("{set:?}, {} and mis, quarter {quarter}", estimator.name()));
            }
        }
    }
    let worst = (0..names.len()).max_by(|a, b| deviations[*a].abs().total_cmp(&deviations[*b].abs())).expect("there are some");
    assert_all_within(&deviations, &format!("estimators where features meet, the worst of all being {}", names[worst]));
}
