//! `noisefall render`: a picture without a window, by the same worker that serves the window.
use std::{
    path::{Path, PathBuf},
    sync::{Arc, atomic::Ordering},
    time::{Duration, Instant},
};

use clap::ArgGroup;
use crossbeam_channel::RecvTimeoutError;
use indicatif::{ProgressBar, ProgressStyle};
use noisefall::{
    math::SimdLevel,
    render::{
        Budget, Display, Job, Publish, Published, Renderer, State, Status,
        film::Film,
        image_file::{check_target, save},
        pass::{SampleId, Threads},
        settings_text::{options, settings_text},
        truth::Reference,
    },
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, load},
};

use super::{
    Failure,
    options::{self as parse, BounceCap},
    print, replay,
    stop::stop_signal,
};

/// Samples per pixel when neither the command nor the scene says how many.
const DEFAULT_SPP: u32 = 256;

#[derive(clap::Args)]
#[command(
    group = ArgGroup::new("target"),
    allow_negative_numbers = true,
    override_usage = "noisefall render [OPTIONS] <SCENE> -o <OUTPUT>\n       noisefall render [OPTIONS] <SCENE> --pixel <X,Y>"
)]
pub struct Arguments {
    /// Scene file (.toml)
    scene: PathBuf,
    /// Picture to write: .png (as shown, sRGB) or .exr (linear radiance)
    #[arg(short, long, required_unless_present = "pixel")]
    output: Option<PathBuf>,
    /// Stop after N samples per pixel [default: the scene's, or 256]; of --spp, --time and --noise the last one given counts
    #[arg(long, value_name = "N", value_parser = parse::samples, overrides_with_all = ["time", "noise"])]
    spp: Option<u32>,
    /// Stop after so many seconds of rendering
    #[arg(long, value_name = "SECONDS", value_parser = parse::seconds, overrides_with_all = ["spp", "noise"])]
    time: Option<Duration>,
    /// Stop at this estimated relative noise, the root of relMSE (0.01 is 1 %)
    #[arg(long, value_name = "RELATIVE", value_parser = parse::noise, overrides_with_all = ["spp", "time"])]
    noise: Option<f64>,
    /// How light is found: path, light or mis
    #[arg(long, value_parser = parse::estimator)]
    estimator: Option<Estimator>,
    /// How the next direction is drawn at diffuse surfaces: uniform, cosine or bsdf
    #[arg(long, value_parser = parse::directions)]
    directions: Option<Directions>,
    /// Where samples lie: independent, stratified, sobol or bluenoise
    #[arg(long, value_parser = parse::sampler)]
    sampler: Option<Sampler>,
    /// Highest number of reflections, or none for no cap
    #[arg(long, value_name = "N|none", value_parser = parse::bounce_cap)]
    max_bounces: Option<BounceCap>,
    /// Russian roulette: off, a survival probability, or throughput
    #[arg(long, value_name = "off|P|throughput", value_parser = parse::roulette)]
    roulette: Option<Roulette>,
    /// Whether neighbouring pixels share what their paths find: auto, on or off
    #[arg(long, value_parser = parse::reuse)]
    reuse: Option<Reuse>,
    /// Whether pixels get more samples where a pilot finds more noise: on or off; on, --spp is the average
    #[arg(long, value_parser = parse::on_or_off)]
    adaptive: Option<bool>,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", value_parser = parse::whole)]
    seed: Option<u32>,
    /// Threads; 0 for one a core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
    /// Resolution in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    /// Replay one path through this pixel instead of rendering
    #[arg(long, value_name = "X,Y", value_parser = parse::pixel, allow_hyphen_values = true, conflicts_with = "output")]
    pixel: Option<[u32; 2]>,
    /// Which sample of the pixel to replay
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::whole, requires = "pixel")]
    sample: u32,
    /// Print one line of JSON last
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let scene = Arc::new(load(&arguments.scene).map_err(|error| error.report())?);
    let camera = Camera { resolution: arguments.size.unwrap_or(scene.camera.resolution), ..scene.camera };
    camera.check().map_err(|error| error.to_string())?;
    let settings = arguments.settings(&scene);
    if let Some(pixel) = arguments.pixel {
        return replay::run(&scene, &camera, &settings, pixel, arguments.sample, arguments.json);
    }
    let Some(output) = &arguments.output else { return Err("no output file".to_owned()) };
    check_target(output).map_err(|error| error.to_string())?;
    // The worker asks again: here it is no failure of the renderer.
    drop(Film::reserve(camera.resolution).map_err(|error| error.to_string())?);
    let reference = Reference::of(&scene);
    let mismatch = reference.as_ref().and_then(|truth| truth.mismatch(camera.resolution));
    mismatch.iter().for_each(|mismatch| eprintln!("note: {mismatch}"));
    scene.warnings().iter().for_each(|warning| eprintln!("note: {warning}"));
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let thread_count = threads.count();
    let build_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let budget = arguments.budget(&scene);
    let job = Job { generation: 1, scene: scene.clone(), camera, settings };
    let Published { frame, status } = render(threads, job, budget, arguments.json)?;
    let render_seconds = start.elapsed().as_secs_f64();

    if let State::Failed(failure) = &status.state {
        let replay = failure.replays.then(|| format!("\nreplay: {}", replay_command(arguments, failure.at, &settings, &scene)));
        return Err(format!("the renderer failed: {}{}", failure.message, replay.unwrap_or_default()));
    }
    let text = settings_text(&scene, &camera, &settings, Display::default(), status.spp, &[]);
    save_somewhere(output, |path| save(&frame, Display::default(), &text, path))?;
    let rel_mse = reference.and_then(|truth| truth.compare(&frame)).map(|comparison| comparison.rel_mse);
    let replay = status.first_invalid.map(|at| replay_command(arguments, at, &settings, &scene));
    if let Some(replay) = &replay {
        eprintln!("warning: {} invalid samples were dropped; the first one: {replay}", status.invalid_samples);
    }
    let black = frame.is_black();
    if black {
        eprintln!("note: the picture is entirely black: {}", scene.why_black(&camera, &settings));
    }
    if status.cut_paths > 0 {
        let longest = settings.last_bounce();
        eprintln!(
            "warning: {} paths were cut after {longest} reflections: the picture is biased; use roulette",
            status.cut_paths
        );
    }
    if arguments.json {
        let line = serde_json::json!({
            "scene": arguments.scene, "width": frame.width, "height": frame.height, "spp": status.spp,
            "threads": thread_count, "seed": settings.seed, "build_seconds": build_seconds, "render_seconds": render_seconds,
            "paths": status.samples, "rays": status.rays, "invalid_samples": status.invalid_samples,
            "rel_mse_estimate": status.rel_mse_estimate, "cut_paths": status.cut_paths, "dropped_triangles": scene.shapes.dropped_triangles(), "bias": status.bias(&settings),
            "reuse": status.shares, "adaptive": status.adapts, "rel_mse": rel_mse, "replay": replay,
        });
        print(&line.to_string())
    } else {
        print(&summary(output, &status, &settings, render_seconds, rel_mse, black))
    }
}

impl Arguments {
    fn settings(&self, scene: &Scene) -> RenderSettings {
        let of_scene = scene.settings;
        RenderSettings {
            sampler: self.sampler.unwrap_or(of_scene.sampler),
            estimator: self.estimator.unwrap_or(of_scene.estimator),
            directions: self.directions.unwrap_or(of_scene.directions),
            roulette: self.roulette.unwrap_or(of_scene.roulette),
            max_bounces: self.max_bounces.map_or(of_scene.max_bounces, |cap| cap.0),
            reuse: self.reuse.unwrap_or(of_scene.reuse),
            adaptive: self.adaptive.unwrap_or(of_scene.adaptive),
            seed: self.seed.unwrap_or(of_scene.seed),
        }
    }

    fn budget(&self, scene: &Scene) -> Budget {
        let by_samples = self.time.is_none() && self.noise.is_none();
        let max_spp = by_samples.then(|| self.spp.or(scene.spp).unwrap_or(DEFAULT_SPP));
        Budget { max_spp, max_time: self.time, noise: self.noise, ..Budget::default() }
    }
}

/// Renders to the end, with a progress bar where there is a terminal to show it.
fn render(threads: Threads, job: Job, budget: Budget, quiet: bool) -> Result<Published, Failure> {
    let (wake, woken) = crossbeam_channel::bounded(1);
    let renderer = Renderer::new(threads, Publish::Sparse, move || {
        let _ = wake.try_send(());
    });
    renderer.set_budget(budget);
    renderer.submit(job);
    let stop = stop_signal("interrupted: saving the picture as it is (once more to give up)")?;
    let bar = if quiet { ProgressBar::hidden() } else { progress_bar(&budget) };
    loop {
        if woken.recv_timeout(Duration::from_millis(200)) == Err(RecvTimeoutError::Disconnected) {
            return Err("the render thread ended unexpectedly".to_owned());
        }
        if stop.load(Ordering::Relaxed) {
            renderer.set_budget(Budget { paused: true, ..budget });
        }
        let published = renderer.latest();
        show_progress(&bar, &budget, &published.status);
        if matches!(published.status.state, State::Paused | State::Converged | State::Failed(_)) {
            bar.finish_and_clear();
            return Ok(published);
        }
    }
}

fn progress_bar(budget: &Budget) -> ProgressBar {
    let length = match budget {
        Budget { max_spp: Some(spp), .. } => u64::from(*spp),
        Budget { max_time: Some(time), .. } => time.as_millis() as u64,
        _ => 1000,
    };
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed} elapsed, {eta} left");
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn show_progress(bar: &ProgressBar, budget: &Budget, status: &Status) {
    let position = match (budget.noise, status.relative_noise()) {
        _ if budget.max_spp.is_some() => u64::from(status.spp),
        _ if budget.max_time.is_some() => status.elapsed.as_millis() as u64,
        // Noise falls as the root of time: the square of the ratio is the share of the work that is done.
        (Some(goal), Some(noise)) => (1000.0 * (goal / noise).powi(2)).min(1000.0) as u64,
        _ => 0,
    };
    bar.set_position(position);
    bar.set_message(format!("{} spp, {:.1} M samples/s{}", status.spp, status.samples_per_second() / 1e6, noise_text(status)));
}

fn noise_text(status: &Status) -> String {
    status.relative_noise().map_or_else(String::new, |noise| format!(", noise {:.2} %", 100.0 * noise))
}

fn summary(output: &Path, status: &Status, settings: &RenderSettings, seconds: f64, rel_mse: Option<f64>, black: bool) -> String {
    let bias = status.bias(settings).map_or_else(|| "unbiased".to_owned(), |why| format!("biased: {why}"));
    let error = rel_mse.map_or_else(String::new, |e| format!(", true error {:.2} %", 100.0 * e.sqrt()));
    let rate = status.samples as f64 / seconds / 1e6;
    let noise = if black { ", no light found".to_owned() } else { noise_text(status) };
    format!("{}: {} spp in {seconds:.2} s ({rate:.1} M samples/s){noise}{error}, {bias}", output.display(), status.spp)
}

/// The command that traces one sample again.
fn replay_command(arguments: &Arguments, at: SampleId, settings: &RenderSettings, scene: &Scene) -> String {
    let [x, y] = at.pixel;
    let size = arguments.size.map_or_else(String::new, |[w, h]| format!(" --size {w}x{h}"));
    let options = options(settings, &scene.settings);
    format!("noisefall render {} --pixel {x},{y} --sample {}{size}{options}", arguments.scene.display(), at.sample)
}

/// A rendered picture must not be lost to a full disk: where the target fails, the folder for temporary files is tried.
fn save_somewhere(
    path: &Path,
    save: impl Fn(&Path) -> Result<(), noisefall::render::image_file::ImageError>,
) -> Result<(), Failure> {
    let Err(error) = save(path) else { return Ok(()) };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let candidates = (0..).map(|i| std::env::temp_dir().join(format!("noisefall-{}-{i}-{name}", std::process::id())));
    let Some(rescue) = { candidates }.find(|path| !path.exists()) else { return Err(error.to_string()) };
    match save(&rescue) {
        Ok(()) => Err(format!("{error}\nthe picture was saved as {} instead", rescue.display())),
        Err(_) => Err(error.to_string()),
    }
}
