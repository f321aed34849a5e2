//! `noisefall sheet`: renders images with several settings onto one labelled sheet.
use std::{path::PathBuf, process::ExitCode, sync::atomic::Ordering, time::Duration};

use indicatif::{ProgressBar, ProgressStyle};
use noisefall_base::{
    file::{check, replace},
    math::SimdLevel,
    memory::reserve,
};
use noisefall_lab::{
    report::sheet::{self, Cell},
    study::{Bench, Lists, StudyError, differing_labels, study_size},
};
use noisefall_render::render::{film::Film, image_file::Format, threads::Threads, tone::to_srgb};
use noisefall_scene::scene::{Camera, RenderSettings};

use super::{
    lists::{ListOptions, item},
    messages::{Failure, print, tell, wrong_usage},
    options::{self as parse, DisplayOptions},
    scene_file::SceneOptions,
    stop::{INTERRUPTED, stop_signal},
    triangle,
};

const NOTES: &str = "\
Each combination of the lists is one image. A list that is not given takes the scene's value. All images have the same seed.

Example: noisefall sheet scenes/cornell_box.toml -o sheet.png --spp 1,4,16,64 --estimators path,mis

--strategies N is the triangle of bidirectional path tracing (Veach 1997, section 10.3): a row for each number of bounces, and in it an image
for each strategy (s, t), with s vertices from the light and t from the camera. Weighted, all images add up to the image of N bounces.

Example: noisefall sheet scenes/glass_ball_caustic.toml -o strategies.png --strategies 4 --spp 64";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    scene: PathBuf,
    #[command(flatten)]
    options: SceneOptions,
    /// Sheet to write (.png)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Numbers of samples per pixel
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = item(parse::samples), default_value = "16")]
    spp: Vec<u32>,
    #[command(flatten)]
    lists: ListOptions,
    /// Show each strategy (s, t) of bidirectional paths of up to N bounces, in place of the lists
    #[arg(long, value_name = "N", value_parser = triangle::strategy_bounces,
          conflicts_with_all = ListOptions::names().chain(["columns"]))]
    strategies: Option<u32>,
    /// With --strategies: show all light that each strategy finds, without its weight among the others
    #[arg(long, requires = "strategies")]
    unweighted: bool,
    /// Resolution of each image [default: the scene's, scaled down to 256 along the longer side]
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    /// Images per row [default: as many as there are numbers of samples, or four]
    #[arg(long, value_name = "N", value_parser = parse::samples)]
    columns: Option<u32>,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", value_parser = parse::whole)]
    seed: Option<u32>,
    #[command(flatten)]
    display: DisplayOptions,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if Format::of(&arguments.output).ok() != Some(Format::Png) {
        return Ok(wrong_usage(&format!("{}: a sheet is a PNG: the name must end in .png", arguments.output.display())));
    }
    check(&arguments.output).map_err(|error| error.to_string())?;
    let scene = arguments.options.open_for(&arguments.scene, arguments.size)?.scene;
    let camera = Camera { resolution: arguments.size.unwrap_or(study_size(scene.camera.resolution)), ..scene.camera };
    camera.check().map_err(|error| error.to_string())?;
    let base = RenderSettings { seed: arguments.seed.unwrap_or(scene.settings.seed), ..scene.settings };
    let combinations = match arguments.strategies {
        Some(bounces) => triangle::strategies(&scene, base, bounces, !arguments.unweighted)?,
        None => arguments.lists.lists(Lists::default()).combinations(base),
    };
    let mut spp = arguments.spp.clone();
    if arguments.strategies.is_some() && spp.len() > 1 {
        return Ok(wrong_usage("--strategies takes one number of samples: give --spp a single one"));
    }
    spp.sort_unstable();
    spp.dedup();
    let [width, height] = camera.resolution;
    let pictures = (combinations.len() * spp.len()) as u64;
    let columns = arguments.columns.unwrap_or(if spp.len() > 1 { spp.len() as u32 } else { 4 });
    let columns = arguments.strategies.map_or(columns, |bounces| bounces + 2);
    sheet::check(camera.resolution, columns, u32::try_from(pictures).unwrap_or(u32::MAX))?;
    // 10 bytes per pixel: the cells, and the sheet with its margins.
    let _memory =
        reserve(format_args!("{pictures} images of {width} × {height}"), pictures * u64::from(width) * u64::from(height) * 10)
            .and_then(|cells| Film::reserve(camera.resolution).map(|film| (cells, film)))
            .map_err(|error| error.to_string())?;
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let stop = stop_signal("interrupted: no sheet is written")?;
    let stopped = || stop.load(Ordering::Relaxed);
    let bench = Bench { scene: &scene, camera: &camera, threads: &threads, stop: &stopped };
    match cells(arguments, &bench, &combinations, &spp) {
        Ok(cells) => {
            let cells = if arguments.strategies.is_some() { triangle::padded(cells, &combinations) } else { cells };
            let (common, _) = differing_labels(&combinations);
            let title = [scene.title.clone(), common].into_iter().filter(|line| !line.is_empty()).collect::<Vec<_>>();
            let png = threads.install(|| sheet::sheet(camera.resolution, columns, &title, &cells))?;
            replace(&arguments.output, &png).map_err(|error| error.to_string())?;
            print(&format!("{}: {pictures} images of {width} × {height}", arguments.output.display()))?;
            Ok(ExitCode::SUCCESS)
        }
        Err(StudyError::Interrupted) => Ok(ExitCode::from(INTERRUPTED)),
        Err(error) => Err(error.to_string()),
    }
}

/// Renders the images. Those of one combination come from one render, which pauses at each number of samples.
fn cells(arguments: &Arguments, bench: &Bench, combinations: &[RenderSettings], spp: &[u32]) -> Result<Vec<Cell>, StudyError> {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} images  {elapsed} elapsed, {eta} left");
    let bar = ProgressBar::new((combinations.len() * spp.len()) as u64);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let (_, labels) = differing_labels(combinations);
    let labels: Vec<String> =
        combinations.iter().zip(labels).map(|(settings, label)| triangle::label(settings).unwrap_or(label)).collect();
    let mut cells = Vec::new();
    for (settings, label) in combinations.iter().zip(labels) {
        let (mut film, mut elapsed) = (bench.film(), Duration::ZERO);
        for spp in spp {
            let (took, count) = bench.pass(settings, &mut film, *spp)?;
            elapsed += took;
            if count.cut_paths > 0 {
                tell(&format!("warning: {label}: {} paths were cut: the image is biased; use roulette", count.cut_paths));
            }
            let mut pixels = Vec::new();
            to_srgb(&bench.frame(&film).radiance, arguments.display.display(bench.scene.exposure), &mut pixels);
            let figures = format!("{spp} spp, {:.2} s", elapsed.as_secs_f64());
            let lines = [label.clone(), figures].into_iter().filter(|line| !line.is_empty()).collect();
            cells.push(Cell { lines, pixels });
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use noisefall_scene::scene::{Reuse, built_in};

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        arguments: Arguments,
    }

    /// Renders 40 × 40 pixels of the built-in scene.
    fn rendered(settings: &[RenderSettings], spp: &[u32]) -> Vec<Cell> {
        let arguments = Program::parse_from(["sheet", "a.toml", "-o", "a.png"]).arguments;
        let (scene, threads) = (built_in(), Threads::new(1, SimdLevel::best()).expect("a thread"));
        let camera = Camera { resolution: [40, 40], ..scene.camera };
        let bench = Bench { scene: &scene, camera: &camera, threads: &threads, stop: &|| false };
        cells(&arguments, &bench, settings, spp).expect("images")
    }

    fn unshared() -> RenderSettings {
        RenderSettings { reuse: Reuse::Off, ..built_in().settings }
    }

    /// The last sample takes hardly any time.
    #[test]
    fn the_seconds_of_a_picture_are_those_of_all_its_samples() {
        let cells = rendered(&[unshared()], &[64, 65]);
        let seconds: Vec<f64> =
            cells.iter().filter_map(|cell| cell.lines.last()?.split_once(" spp, ")?.1.strip_suffix(" s")?.parse().ok()).collect();
        assert!(seconds.len() == 2 && seconds[1] >= seconds[0], "{seconds:?}");
    }

    #[test]
    fn the_label_stands_above_the_figures() {
        let settings = [Some(1), Some(2)].map(|max_bounces| RenderSettings { max_bounces, ..unshared() });
        for cell in rendered(&settings, &[1]) {
            assert!(
                matches!(&cell.lines[..], [label, figures] if !label.contains(" spp") && figures.starts_with("1 spp, ")),
                "{:?}",
                cell.lines
            );
        }
    }
}
