//! `noisefall bench`: measures where the time of a render goes.
use std::{
    fmt::Write,
    path::PathBuf,
    process::ExitCode,
    sync::atomic::Ordering,
    time::{Duration, Instant},
};

use noisefall_base::{
    file::{check, replace},
    math::SimdLevel,
};
use noisefall_lab::report::stack::{Bar, stacked};
use noisefall_render::render::{
    profile::{CountedRays, PathStage, Profile, StageCost, settings_of},
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{Camera, Estimator, PathReuse, RenderSettings};
use serde_json::{Value, json};

use super::{
    figures::{self, named},
    messages::{Failure, print, tell, wrong_usage},
    options as parse,
    scene_file::SceneOptions,
    stop::{INTERRUPTED, stop_signal},
};

const NOTES: &str = "\
Times of stages are wall-clock times summed over threads, so waiting on a busy machine counts; more samples even that out. The trial \
that decides what pixels share is not part of them. The table of bounces leaves out camera rays, path reuse and film; its rays per \
sample include shadow rays. Path reuse includes outliers. The choice of lights is part of shading.

The image is discarded, and sampling is uniform even if the scene asks for adaptive sampling. Light paths are not measured: \
if the scene asks for them, `mis` is measured.

Example: noisefall bench scenes/million_triangles.toml -o where.svg";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    scene: PathBuf,
    #[command(flatten)]
    options: SceneOptions,
    /// Plot to write (.svg): time by bounce and stage
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Samples per pixel
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = parse::samples)]
    spp: u32,
    /// Resolution in pixels [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
    /// Print the figures as one line of JSON
    #[arg(long)]
    json: bool,
}

/// A profile with what it was measured on.
struct Measured {
    profile: Profile,
    build: Duration,
    /// Time of the trials that decide the estimator and the path reuse.
    trial: Duration,
    elapsed: Duration,
    threads: usize,
    spp: u32,
    path_reuse: PathReuse,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if let Some(output) = &arguments.output {
        if output.extension().is_none_or(|extension| extension != "svg") {
            return Ok(wrong_usage(&format!("{}: the plot is an SVG: the name must end in .svg", output.display())));
        }
        check(output).map_err(|error| error.to_string())?;
    }
    let start = Instant::now();
    let scene = arguments.options.open_for(&arguments.scene, arguments.size)?.scene;
    let build = start.elapsed();
    let camera = Camera { resolution: arguments.size.unwrap_or(scene.camera.resolution), ..scene.camera };
    camera.check().map_err(|error| error.to_string())?;
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let stop = stop_signal("interrupted: nothing was measured")?;
    let start = Instant::now();
    let (rays, (settings, estimator)) = (scene.rays(&camera), settings_of(&scene, &camera));
    let trial = start.elapsed();
    if settings.estimator != estimator {
        let [measured, asked] = [settings.estimator, estimator].map(Estimator::name);
        tell(&format!("warning: bench cannot measure `{asked}`; measuring `{measured}`"));
    }
    let job = PassJob { scene: &scene, rays: &rays, settings: &settings };
    let start = Instant::now();
    let Ok(profile) = threads.profile(job, arguments.spp, &|| stop.load(Ordering::Relaxed)) else {
        return Ok(ExitCode::from(INTERRUPTED));
    };
    let (elapsed, path_reuse) = (start.elapsed(), scene.path_reuse(&rays, &settings));
    let measured = Measured { profile, build, trial, elapsed, threads: threads.count(), spp: arguments.spp, path_reuse };
    if let Some(output) = &arguments.output {
        replace(output, measured.plot(&scene.title).as_bytes()).map_err(|error| error.to_string())?;
    }
    if arguments.json {
        let mut line = figures::settings(&RenderSettings { reuse: scene.settings.reuse, ..settings });
        line.extend(measured.figures([("scene", json!(arguments.scene)), ("resolution", json!(camera.resolution))]));
        print(&Value::Object(line).to_string())?;
    } else {
        print(measured.tables().trim_end())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The stages in the order of the tables.
const STAGES: [PathStage; 6] =
    [PathStage::Spawn, PathStage::Intersect, PathStage::Surface, PathStage::Shade, PathStage::Shadow, PathStage::Reuse];

fn name(stage: PathStage) -> &'static str {
    match stage {
        PathStage::Spawn => "camera rays",
        PathStage::Intersect => "rays",
        PathStage::Surface => "surfaces",
        PathStage::Shade => "shading",
        PathStage::Shadow => "shadow rays",
        PathStage::Reuse => "path reuse",
    }
}

/// The name of a stage in JSON.
fn key(name: &str) -> String {
    name.replace(' ', "_")
}

/// The name of a bounce; the last row has all further ones.
fn bounce_name(bounce: usize) -> String {
    if bounce + 1 == Profile::MOST { format!("{bounce} +") } else { bounce.to_string() }
}

impl Measured {
    /// The costs of the stages and of the film, with their names.
    fn stages(&self) -> Vec<(&'static str, StageCost)> {
        let stages = STAGES.map(|stage| (name(stage), self.profile.of_stage(stage)));
        stages.into_iter().chain([("film", self.profile.film)]).collect()
    }

    /// The fraction of all time.
    fn share(&self, cost: StageCost) -> f64 {
        cost.time.as_secs_f64() / self.profile.whole().time.as_secs_f64().max(1e-12)
    }

    fn tables(&self) -> String {
        let Measured { profile, .. } = self;
        let (whole, samples) = (profile.whole(), profile.samples as f64);
        let nanoseconds = |time: Duration, count: f64| if count > 0.0 { time.as_secs_f64() * 1e9 / count } else { 0.0 };
        let mut text = format!(
            "{} samples ({} per pixel, {}) in {:.2} s; threads: {}; scene ready after {:.2} s, trial {:.2} s\n\n\
             stage            time  ns per sample   rays per sample   ns per ray\n",
            profile.samples,
            self.spp,
            self.path_reuse.words(),
            self.elapsed.as_secs_f64(),
            self.threads,
            self.build.as_secs_f64(),
            self.trial.as_secs_f64(),
        );
        let mut row = |name: &str, cost: StageCost| {
            let per_ray = if cost.rays > 0 { format!("{:.1}", nanoseconds(cost.time, cost.rays as f64)) } else { String::new() };
            let rays = if cost.rays > 0 { format!("{:.3}", cost.rays as f64 / samples) } else { String::new() };
            let (share, per_sample) = (100.0 * self.share(cost), nanoseconds(cost.time, samples));
            let _ = writeln!(text, "{name:12} {share:6.1} % {per_sample:14.1} {rays:>17} {per_ray:>12}");
        };
        self.stages().into_iter().for_each(|(name, cost)| row(name, cost));
        row("all", whole);
        if let Some([nodes, leaves]) = self.visits() {
            let _ = writeln!(
                text,
                "\na ray of a path visits {nodes:.2} nodes and {leaves:.2} leaves of trees, of eight boxes or triangles each"
            );
        }
        text += "\nbounce         rays   surfaces    shading  shadow rays   rays per sample\n";
        for (bounce, costs) in profile.bounces.iter().enumerate() {
            let [rays, surfaces, shading, shadows] = costs.map(|cost| 100.0 * self.share(cost));
            let traced = costs.iter().map(|cost| cost.rays).sum::<u64>() as f64 / samples;
            let name = bounce_name(bounce);
            let _ = writeln!(text, "{name:8} {rays:8.1} % {surfaces:8.1} % {shading:8.1} % {shadows:10.1} % {traced:17.3}");
        }
        text
    }

    /// Nodes and leaves of trees that a ray of a path visits; `None` without trees.
    fn visits(&self) -> Option<[f64; 2]> {
        let CountedRays { rays, visits } = self.profile.counted;
        (visits.nodes > 0).then(|| [visits.nodes, visits.leaves].map(|visits| visits as f64 / rays as f64))
    }

    /// The figures of the JSON line.
    fn figures<const N: usize>(&self, others: [(&str, Value); N]) -> figures::Figures {
        let cost = |cost: StageCost| json!({ "seconds": cost.time.as_secs_f64(), "rays": cost.rays });
        let bounce = |(bounce, costs): (usize, &[StageCost; 4])| {
            let stages = Profile::STAGES.map(name).into_iter().zip(costs.map(cost));
            json!({ "bounce": bounce, "stages": stages.map(|(name, cost)| (key(name), cost)).collect::<figures::Figures>() })
        };
        let stages: figures::Figures = self.stages().into_iter().map(|(name, of)| (key(name), cost(of))).collect();
        let mut all = named(others);
        all.extend(named([
            ("version", json!(env!("CARGO_PKG_VERSION"))),
            ("simd", json!(SimdLevel::best().name())),
            ("threads", json!(self.threads)),
            ("spp", json!(self.spp)),
            ("path_reuse", json!(self.path_reuse.name())),
            ("samples", json!(self.profile.samples)),
            ("build_seconds", json!(self.build.as_secs_f64())),
            ("trial_seconds", json!(self.trial.as_secs_f64())),
            ("seconds", json!(self.elapsed.as_secs_f64())),
            ("nodes_per_ray", json!(self.visits().map(|[nodes, _]| nodes))),
            ("leaves_per_ray", json!(self.visits().map(|[_, leaves]| leaves))),
            ("stages", Value::Object(stages)),
            ("bounces", Value::Array(self.profile.bounces.iter().enumerate().map(bounce).collect())),
        ]));
        all
    }

    /// Stacked bars: one for each bounce, and one for what belongs to none.
    fn plot(&self, title: &str) -> String {
        let percent = |cost: StageCost| 100.0 * self.share(cost);
        let mut bars: Vec<Bar> = vec![Bar {
            name: "once".to_owned(),
            parts: vec![percent(self.profile.spawn), 0.0, 0.0, 0.0, 0.0, percent(self.profile.reuse), percent(self.profile.film)],
        }];
        bars.extend(self.profile.bounces.iter().enumerate().map(|(bounce, costs)| {
            let parts = std::iter::once(0.0).chain(costs.map(percent)).collect();
            Bar { name: bounce_name(bounce), parts }
        }));
        let names: Vec<&str> = self.stages().iter().map(|(name, _)| *name).collect();
        stacked(&format!("{title}: time by bounce, %"), &names, &bars)
    }
}
