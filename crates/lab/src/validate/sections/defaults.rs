//! The default settings.
use super::{
    direct_light::{self, lit},
    rooms::wall_of_sphere,
    spheres::{lit_ball, shipped},
};
use crate::validate::{
    Effort, Section, Statement, Validation,
    check::{of_a_point, scene},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::exact::horizon_sphere_irradiance;
use noisefall_render::render::{
    film::Film,
    path_reuse::resolved,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene},
};

/// A scene with the exact means of the pixels where they are known.
struct KnownScene {
    name: &'static str,
    scene: Scene,
    exact: Vec<Option<f64>>,
}

/// A change of settings.
type Change = fn(RenderSettings) -> RenderSettings;

/// Plain settings with one of the defaults each.
const ALONE: [(&str, Change); 8] = [
    ("plain: path, independent, cosine, q = 0.9", |plain| plain),
    ("plain but MIS", |plain| RenderSettings { estimator: Estimator::Mis, ..plain }),
    ("plain but Sobol", |plain| RenderSettings { sampler: Sampler::Sobol, ..plain }),
    ("plain but bsdf directions", |plain| RenderSettings { directions: RenderSettings::default().directions, ..plain }),
    ("plain but roulette by throughput", |plain| RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..plain }),
    ("plain but reused suffixes", |plain| RenderSettings { reuse: Reuse::Suffixes, ..plain }),
    ("plain but outliers", |plain| RenderSettings { reuse: Reuse::Outliers, ..plain }),
    ("plain but adaptive", |plain| RenderSettings { adaptive: true, ..plain }),
];

/// All defaults, with each decision that the program may take.
const TOGETHER: [(&str, Change); 5] = [
    ("all defaults", |defaults| defaults),
    ("all defaults, reused suffixes", |defaults| RenderSettings { reuse: Reuse::Suffixes, ..defaults }),
    ("all defaults, reused suffixes and outliers", |defaults| RenderSettings { reuse: Reuse::Both, ..defaults }),
    ("all defaults, adaptive, nothing shared", |defaults| RenderSettings { adaptive: true, reuse: Reuse::Off, ..defaults }),
    ("all defaults, blue noise", |defaults| RenderSettings { sampler: Sampler::BlueNoise, ..defaults }),
];

pub fn section(validation: &Validation) -> Section {
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let repeats = if validation.effort == Effort::Full { 16 } else { 8 };
    let mut statements = Vec::new();
    for subject in subjects() {
        let mut row = |name: &str, settings: &dyn Fn() -> RenderSettings| {
            let means: Option<Vec<f64>> =
                (0..repeats).map(|_| subject.mean(&threads, settings(), validation.spp(48).max(16))).collect();
            if let Some(means) = means {
                statements.push(Statement::repeated(format!("{}, {name}", subject.name), &means, subject.mean_exact()));
            }
        };
        for (name, change) in ALONE {
            let plain = || RenderSettings { roulette: Roulette::fixed(0.9), ..validation.settings(Estimator::Path) };
            row(name, &|| change(plain()));
        }
        for (name, change) in TOGETHER {
            row(name, &|| change(defaults(validation)));
        }
        for estimator in Estimator::ALL.into_iter().filter(|estimator| subject.suits(*estimator)) {
            row(&format!("all defaults but {}", estimator.name()), &|| RenderSettings { estimator, ..defaults(validation) });
        }
    }
    Section {
        title: "Default settings",
        claim: "The default settings, all together and one by one, give the exact means.",
        derivation: &[
            "The defaults are MIS, Sobol points, BSDF directions, roulette by throughput from the fourth bounce on, and path reuse or reused outliers if a trial shows a gain; adaptive sampling is optional. These rows render like the program itself, in passes over a film and after the same decisions. The estimators with light paths have rows, too. Path reuse and adaptive sampling have rows where the program applies them: paths are not reused at glass, for example, and uniform noise leaves nothing to adapt to.",
            "The radiance of a wall of the textured integrating sphere is L_e + ρ H, with H from the section on that room. The ground under a light that is partly below the horizon has (ρ/π) E. The wall of the closed sphere has 0.5, and a clear ball of glass in a uniform field of 1 has 1. On Lambert’s ball the lit pixels are summed.",
            "These samples are not independent of each other, so their variance does not give the standard error. The image is rendered with several seeds. The means are independent, and their spread gives the standard error (Student’s t).",
        ],
        source: "P. Bekaert, M. Sbert and J. Halton, “Accelerating Path Tracing by Re-Using Paths”, 2002, for path reuse; D. Lin et al., “Generalized Resampled Importance Sampling”, 2022, for the random replay of outliers.",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}

fn defaults(validation: &Validation) -> RenderSettings {
    let measured = validation.settings(Estimator::Mis);
    RenderSettings { seed: measured.seed, fault: measured.fault, ..RenderSettings::default() }
}

impl KnownScene {
    fn constant(name: &'static str, scene: Scene, exact: f64) -> KnownScene {
        let [width, height] = scene.camera.resolution;
        KnownScene { name, exact: vec![Some(exact); (width * height) as usize], scene }
    }

    /// Whether an estimator traces light paths, and finds light in the view.
    fn suits(&self, estimator: Estimator) -> bool {
        let sees_a_point = self.scene.camera.fov < 0.1;
        estimator.traces_light_paths() && (!sees_a_point || of_a_point().any(|suited| suited == estimator))
    }

    fn mean_exact(&self) -> f64 {
        let known: Vec<f64> = self.exact.iter().copied().flatten().collect();
        known.iter().sum::<f64>() / known.len() as f64
    }

    /// The mean red of the known pixels of one image; `None` if the program decides against what the settings ask for.
    fn mean(&self, threads: &Threads, settings: RenderSettings, spp: u32) -> Option<f64> {
        let [width, height] = self.scene.camera.resolution;
        let rays = self.scene.rays(&self.scene.camera);
        let asked = settings;
        let settings = threads.install(|| resolved(&self.scene, &rays, &settings));
        let mut film = Film::new([width, height]);
        let job = PassJob { scene: &self.scene, rays: &rays, settings: &settings };
        // A pass ends when the number of samples has doubled.
        while film.spp() < spp && threads.pass(job, &mut film, spp, &|| false).failure.is_none() {}
        let path_reuse = self.scene.path_reuse(&rays, &settings);
        let does_not_share = asked.reuse != Reuse::Auto && path_reuse.reuse() != asked.reuse;
        let starts_no_paths = self.scene.lacks_light_paths(&asked).is_some();
        if does_not_share || starts_no_paths || (asked.adaptive && !film.is_adaptive()) {
            return None;
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for tile in &film.tiles {
            for row in 0..tile.size[1] {
                for (column, estimate) in (0..).zip(tile.estimates(row as usize)) {
                    let place = (tile.origin[1] + row) * width + tile.origin[0] + column;
                    if self.exact[place as usize].is_some() {
                        sum += estimate.mean[0];
                        count += 1.0;
                    }
                }
            }
        }
        Some(sum / count)
    }
}

fn subjects() -> Vec<KnownScene> {
    let (sin, cos) = 75f64.to_radians().sin_cos();
    let light = lit(&format!("shape.sphere = {{ center = [{sin:?}, {cos:?}, 0.0], radius = 0.3 }}"));
    let irradiance = horizon_sphere_irradiance(1.0, 0.3, 1.0, cos);
    let inside = shipped("inside_lit_inside");
    let inside = Scene { camera: Camera { resolution: [64; 2], ..inside.camera }, ..inside };
    let glass = scene(
        "camera = { eye = [0.0, 0.5, 4.0], look_at = [0.0, 0.0, 0.0], fov = 30.0, resolution = [64, 64] }
        environment.radiance = 1.0
        materials.glass.dielectric = { ior = 1.5 }
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }
        material = 'glass'",
    );
    let (ball, exact) = lit_ball();
    let (sphere, wall) = wall_of_sphere();
    vec![
        KnownScene::constant("textured integrating sphere", sphere, wall),
        KnownScene::constant("ground under a light", light, direct_light::ALBEDO / std::f64::consts::PI * irradiance),
        KnownScene::constant("closed sphere", inside, 0.5),
        KnownScene::constant("clear ball", glass, 1.0),
        KnownScene { name: "Lambert’s ball", scene: ball, exact },
    ]
}
