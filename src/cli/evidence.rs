//! `noisefall evidence`: writes a chapter of figures and tables about a scene.
use std::{path::PathBuf, process::ExitCode, sync::atomic::Ordering, time::Duration};

use indicatif::{ProgressBar, ProgressStyle};
use noisefall_base::{file::replace, math::SimdLevel};
use noisefall_lab::study::{CSV, EvidencePlan, Machine, Store, StudyError, StudyScene, collect, reserve_chapter};
use noisefall_render::render::threads::Threads;

use super::{
    folder,
    messages::{Failure, print, tell},
    options::{self as parse, DisplayOptions},
    scene_file::SceneOptions,
    stop::{INTERRUPTED, stop_signal},
};

const NOTES: &str = "\
DIR gets report.html, every plot as SVG and PNG, every sheet of images as PNG, every table as CSV and LaTeX, and study.csv with all \
measurements. Measurements in DIR are not repeated.

Example: noisefall evidence my_scene.toml -o evidence --time 180";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    scene: PathBuf,
    #[command(flatten)]
    options: SceneOptions,
    /// Folder for the report and its files; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Approximate duration
    #[arg(long, value_name = "SECONDS", default_value = "180", value_parser = parse::seconds)]
    time: Duration,
    /// Reference image (.exr), in place of the scene's own
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Resolution in pixels [default: the reference's, or the scene's scaled down to 256 along the longer side]
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    #[command(flatten)]
    display: DisplayOptions,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let folder = &arguments.output;
    [folder::REPORT, CSV].into_iter().try_for_each(|name| folder::make(folder, name))?;
    let scene = arguments.options.open_for(&arguments.scene, arguments.size)?.scene;
    let study_scene = StudyScene::new(&arguments.scene, scene, arguments.size, arguments.reference.as_deref());
    let study_scene = study_scene.map_err(|error| error.to_string())?;
    let _memory = reserve_chapter(&study_scene).map_err(|error| error.to_string())?;
    let mut store = Store::open(folder).map_err(|error| error.to_string())?;
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let machine = Machine::here(&threads);
    let stop = stop_signal("interrupted: measurements so far are kept (interrupt again to stop at once)")?;
    let stopped = || stop.load(Ordering::Relaxed);
    let plan = EvidencePlan { time: arguments.time, display: arguments.display.display(0.0) };
    let bar = progress_bar();
    let mut told = String::new();
    let mut observe = |what: &str, share: f64| {
        bar.set_position((1000.0 * share) as u64);
        bar.set_message(what.to_owned());
        if bar.is_hidden() && told != what {
            what.clone_into(&mut told);
            tell(&format!("{:.0} %: {what}", 100.0 * share));
        }
    };
    let chapter = collect(&plan, study_scene, (folder, &mut store), (&threads, &machine), &stopped, &mut observe);
    bar.finish_and_clear();
    let chapter = match chapter {
        Err(StudyError::Interrupted) => return Ok(ExitCode::from(INTERRUPTED)),
        chapter => chapter.map_err(|error| error.to_string())?,
    };
    chapter.failures.iter().for_each(|failure| tell(&format!("warning: {failure}")));
    for (name, bytes) in &chapter.files {
        replace(&folder.join(name), bytes).map_err(|error| error.to_string())?;
    }
    print(&format!("{}: {} files of figures and tables", folder.display(), chapter.files.len()))?;
    folder::write_report(folder, &chapter.html)?;
    Ok(ExitCode::SUCCESS)
}

fn progress_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed} elapsed, {eta} left");
    ProgressBar::new(1000).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
