//! `noisefall study`: measures run time against error for every combination of settings.
use std::{
    path::PathBuf,
    process::ExitCode,
    sync::atomic::Ordering,
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressStyle};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::Floor;
use noisefall_lab::study::{
    CSV, Findings, Lists, Machine, Plan, Progress, Store, Study, StudyError, StudyScene, html, label, reserve, table, verdict,
};
use noisefall_render::render::threads::Threads;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Roulette},
};

use super::{
    folder,
    lists::ListOptions,
    messages::{Failure, print, tell, wrong_usage},
    options as parse,
    scene_file::SceneOptions,
    stop::{INTERRUPTED, stop_signal},
};

const NOTES: &str = "\
Renders each scene several times with each combination of the lists, and compares it with a reference at every doubling of the samples: the \
scene's [reference], else the image NAME.ref.exr beside NAME.toml, else a converged render, which is made first and kept in DIR.

Default lists: --estimators path,light,mis --directions uniform,cosine,bsdf --samplers \
independent,stratified,sobol --roulette off,0.8,throughput --max-bounces none. Path reuse and adaptive sampling follow the scene.

DIR gets study.csv with a line per measurement, and report.html with error against time and samples, slopes, efficiencies and the best \
settings of each scene. Measurements in DIR are not repeated, so the same command continues an interrupted study.

Example: noisefall study scenes/cornell_box.toml -o study --samplers independent,sobol --roulette off,throughput";

#[derive(clap::Args)]
#[command(allow_negative_numbers = true, after_help = NOTES)]
pub struct Arguments {
    /// Scene files: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply or .stl
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
    /// Folder for study.csv, report.html and references; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    lists: ListOptions,
    /// Largest number of samples per pixel. Errors are measured at powers of two
    #[arg(long, value_name = "N", default_value = "256", value_parser = parse::samples)]
    spp: u32,
    /// Longest rendering time of a run. A doubling of the samples that would end later is not begun
    #[arg(long, value_name = "SECONDS", default_value = "1.5", value_parser = parse::seconds)]
    seconds: Duration,
    /// Runs of each combination, with different seeds
    #[arg(long, value_name = "N", default_value = "2", value_parser = parse::samples)]
    repeats: u32,
    /// Reference image (.exr) in place of the scene's reference; for a single scene only
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Resolution in pixels [default: the reference's, or the scene's scaled down to 256 along the longer side]
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    /// Constant F of relMSE, the mean of (x − r)²/(r² + F) [default: 0.01 of the mean of r²]
    #[arg(long, value_name = "F", value_parser = parse::floor)]
    floor: Option<Floor>,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if arguments.reference.is_some() && arguments.scenes.len() > 1 {
        let mistake = format!("--reference is the image of one scene, but {} scenes are given", arguments.scenes.len());
        return Ok(wrong_usage(&mistake));
    }
    [folder::REPORT, CSV].into_iter().try_for_each(|name| folder::make(&arguments.output, name))?;
    let load = |path: &PathBuf| {
        let scene = arguments.options.open_for(path, arguments.size)?.scene;
        let study_scene = StudyScene::new(path, scene, arguments.size, arguments.reference.as_deref());
        study_scene.map_err(|error| error.to_string())
    };
    let study_scenes = arguments.scenes.iter().map(load).collect::<Result<Vec<_>, Failure>>()?;
    let _memory = reserve(&study_scenes).map_err(|error| error.to_string())?;
    let mut store = Store::open(&arguments.output).map_err(|error| error.to_string())?;
    if store.dropped > 0 {
        tell(&format!("warning: {} lines of {CSV} belong to incomplete runs and are ignored", store.dropped));
    }
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let (plan, machine) = (arguments.plan(), Machine::here(&threads));
    let stop = stop_signal("interrupted: measurements so far are kept (interrupt again to stop at once)")?;
    let stopped = || stop.load(Ordering::Relaxed);
    let study = Study { plan: &plan, folder: &arguments.output, threads: &threads, machine: &machine, stop: &stopped };

    let mut display = Display::new();
    let found = study.run(&study_scenes, &mut store, &mut |progress| display.show(&progress));
    display.bar.finish_and_clear();
    match found {
        Ok(findings) => finish(arguments, &findings, &plan, &machine).map(|()| ExitCode::SUCCESS),
        Err(StudyError::Interrupted) => {
            let folder = arguments.output.display();
            tell(&format!("stopped: {folder} has {} runs; repeat the command to continue", store.len()));
            Ok(ExitCode::from(INTERRUPTED))
        }
        Err(error) => Err(error.to_string()),
    }
}

impl Arguments {
    fn plan(&self) -> Plan {
        let any = RenderSettings::default();
        let estimators = [Estimator::Path, Estimator::Light, Estimator::Mis].map(|estimator| RenderSettings { estimator, ..any });
        let directions = Directions::ALL.map(|directions| RenderSettings { directions, ..any });
        let samplers =
            [Sampler::Independent, Sampler::Stratified, Sampler::Sobol].map(|sampler| RenderSettings { sampler, ..any });
        let roulettes = [Roulette::Off, Roulette::fixed(0.8), Roulette::BY_THROUGHPUT];
        let usual = Lists::default()
            .with(RenderSettings::ESTIMATOR, estimators)
            .with(RenderSettings::DIRECTIONS, directions)
            .with(RenderSettings::SAMPLER, samplers)
            .with(RenderSettings::ROULETTE, roulettes.map(|roulette| RenderSettings { roulette, ..any }))
            .with(RenderSettings::MAX_BOUNCES, [any]);
        let lists = self.lists.lists(usual);
        Plan { lists, spp: self.spp, time: self.seconds, repeats: self.repeats, floor: self.floor.unwrap_or(Floor::DEFAULT) }
    }
}

fn finish(arguments: &Arguments, findings: &[Findings], plan: &Plan, machine: &Machine) -> Result<(), Failure> {
    for scene in findings {
        print(&format!("\n{}\n{}\n{}", scene.title, table(scene), verdict(scene)))?;
        if scene.reference_is_taken_for_exact {
            print(&format!("The error of {} itself is unknown and assumed to be 0.", scene.reference))?;
        }
    }
    print("")?;
    folder::write_report(&arguments.output, &html(findings, plan, machine))
}

/// Fraction of the reference after which a line is printed if there is no terminal.
const REFERENCE_STEP: f64 = 0.25;

/// Progress as a bar, or as a line per combination if there is no terminal.
struct Display {
    bar: ProgressBar,
    /// When the current reference was begun, and the fraction that was printed last.
    reference: Option<(Instant, f64)>,
}

impl Display {
    fn new() -> Display {
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} runs  {msg}  {elapsed} elapsed, {eta} left");
        let bar = ProgressBar::new(0).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Display { bar, reference: None }
    }

    fn show(&mut self, progress: &Progress) {
        match progress {
            Progress::Planned { runs, found } => {
                self.bar.set_length((runs - found) as u64);
                if *found > 0 {
                    tell(&format!("{found} of {runs} runs are already measured"));
                }
            }
            Progress::Reference { title, share } => {
                let (begun, told) = self.reference.get_or_insert((Instant::now(), 0.0));
                let left = begun.elapsed().as_secs_f64() * (1.0 - share) / share.max(1e-3);
                self.bar.set_message(format!("{title}: reference, {:.0} %, {left:.0} s left", 100.0 * share));
                self.bar.tick();
                if self.bar.is_hidden() && (share - *told >= REFERENCE_STEP || *share == 1.0) {
                    *told = *share;
                    tell(&format!("{title}: {:.0} % of the reference, {left:.0} s left", 100.0 * share));
                }
                if *share == 1.0 {
                    self.reference = None;
                }
            }
            Progress::Begun { title, settings } => {
                self.bar.set_message(format!("{title}: {}", label(settings)));
                self.bar.tick();
            }
            Progress::Done => self.bar.inc(1),
            Progress::Combination { title, outcome } if self.bar.is_hidden() => tell(&format!("{title}: {outcome}")),
            Progress::Combination { .. } => {}
        }
    }
}
