//! `noisefall render`: renders an image without a window, with the worker that also serves the window.
use std::{
    path::PathBuf,
    process::ExitCode,
    sync::Arc,
    time::{Duration, Instant},
};

use clap::ArgGroup;
use noisefall::{
    import::Opened,
    math::SimdLevel,
    render::{
        Budget, Display,
        film::Film,
        image_file::Format,
        layers::{self, Layer},
        threads::Threads,
        truth::Reference,
    },
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene},
};

use super::{
    layers::{Layers, parse as layers_of},
    messages::{Failure, tell, wrong_usage},
    options::{self as parse, BounceCap, DisplayOptions},
    output::Output,
    progress::Rendering,
    replay::{self, Form, Which},
    scene_file::SceneOptions,
    sequence::SequenceOptions,
    shot::Job,
};

/// Samples per pixel if neither the command nor the scene states a number.
const DEFAULT_SPP: u32 = 256;

#[derive(clap::Args)]
#[command(
    group = ArgGroup::new("target"),
    allow_negative_numbers = true,
    override_usage = "noisefall render [OPTIONS] <SCENE> -o <OUTPUT>\n       noisefall render [OPTIONS] <SCENE> --pixel <X,Y>"
)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    scene: PathBuf,
    /// Image to write: .png (sRGB, as displayed) or .exr (linear radiance); - for standard output
    #[arg(short, long, required_unless_present = "pixel")]
    output: Option<PathBuf>,
    /// Format of an image on standard output: png or exr. Files get the format of their extension
    #[arg(long, value_name = "FORMAT", value_parser = parse::format, requires = "output", conflicts_with = "pixel")]
    format: Option<Format>,
    /// Stop after N samples per pixel [default: the scene's number, or 256]. If several of --spp, --time and --noise are given,
    /// the last one counts
    #[arg(long, value_name = "N", value_parser = parse::samples, overrides_with_all = ["time", "noise"])]
    spp: Option<u32>,
    /// Stop after a rendering time
    #[arg(long, value_name = "SECONDS", value_parser = parse::seconds, overrides_with_all = ["spp", "noise"])]
    time: Option<Duration>,
    /// Stop at an estimated relative noise (0.01 is 1 %): the root of relMSE, the mean of (x − r)²/(r² + 0.01 · mean r²). The
    /// sample count then depends on the samples, which biased the mean by less than a fortieth of the target in the worst case
    /// tested
    #[arg(long, value_name = "RELATIVE", value_parser = parse::noise, overrides_with_all = ["spp", "time"])]
    noise: Option<f64>,
    #[arg(long, help = format!("How direct light is estimated: {}", parse::one_of::<Estimator>()),
          value_parser = parse::word::<Estimator>)]
    estimator: Option<Estimator>,
    #[arg(long, help = format!("How directions are sampled at diffuse surfaces: {}", parse::one_of::<Directions>()),
          value_parser = parse::word::<Directions>)]
    directions: Option<Directions>,
    #[arg(long, help = format!("Sampler: {}", parse::one_of::<Sampler>()),
          value_parser = parse::word::<Sampler>)]
    sampler: Option<Sampler>,
    /// Highest number of bounces (reflections and refractions), or none for no cap
    #[arg(long, value_name = "N|none", value_parser = parse::bounce_cap)]
    max_bounces: Option<BounceCap>,
    #[arg(long, help = format!("Russian roulette: {}", parse::either(&Roulette::options())), value_parser = parse::roulette)]
    roulette: Option<Roulette>,
    #[arg(long, help = format!("Whether neighbouring pixels reuse each other's paths: {}", parse::one_of::<Reuse>()),
          value_parser = parse::word::<Reuse>)]
    reuse: Option<Reuse>,
    /// Adaptive sampling, with more samples where there is more noise: on or off; --spp is then the average
    #[arg(long, value_parser = parse::on_or_off)]
    adaptive: Option<bool>,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", value_parser = parse::whole)]
    seed: Option<u32>,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    threads: u16,
    /// Resolution in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,
    #[command(flatten)]
    options: SceneOptions,
    #[command(flatten)]
    display: DisplayOptions,
    #[arg(long, value_name = "LIST", help = format!("Layers of an EXR: all, or a list of {}", parse::one_of::<Layer>()),
          value_parser = layers_of, requires = "output")]
    layers: Option<Layers>,
    /// Denoise the image, which biases it: non-local means over two halves of the samples. The file says so
    #[arg(long, requires = "output")]
    denoise: bool,
    #[command(flatten)]
    sequence: SequenceOptions,
    /// Replay one path through this pixel instead of rendering
    #[arg(long, value_name = "X,Y", value_parser = parse::pixel, allow_hyphen_values = true, conflicts_with = "output")]
    pixel: Option<[u32; 2]>,
    /// Sample to replay: a number, `lit` for the first that finds light, or with --csv a range such as 0-9999 [default: 0]
    #[arg(long, value_name = "N", value_parser = parse::which, requires = "pixel", conflicts_with = "output")]
    sample: Option<Which>,
    /// Print the path as LaTeX: the nested sum with its numbers
    #[arg(long, requires = "pixel", conflicts_with_all = ["json", "csv"])]
    latex: bool,
    /// Table of samples of the pixel to write, with running mean and variance; - for standard output
    #[arg(long, value_name = "FILE", requires = "pixel", conflicts_with = "json")]
    csv: Option<PathBuf>,
    /// Print one line of JSON at the end; on standard error if the image goes to standard output
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let output = match arguments.output.as_deref().map(|path| Output::of(path, arguments.format)).transpose() {
        Ok(output) => output,
        Err(mistake) => return Ok(wrong_usage(&mistake)),
    };
    if let Some(mistake) = arguments.sequence.mistake(output.as_ref()) {
        return Ok(wrong_usage(&mistake));
    }
    let start = Instant::now();
    let Opened { scene, remarks, .. } = arguments.options.open(&arguments.scene)?;
    let scene = Arc::new(scene);
    let camera = Camera { resolution: arguments.size.unwrap_or(scene.camera.resolution), ..scene.camera };
    camera.check().map_err(|error| error.to_string())?;
    let settings = arguments.settings(&scene);
    if let Some(pixel) = arguments.pixel {
        let which = arguments.sample.unwrap_or(Which::One(0));
        return replay::run(&scene, &camera, &settings, pixel, which, arguments.form()).map(|()| ExitCode::SUCCESS);
    }
    let Some(output) = output else { return Err("no output file".to_owned()) };
    let shots = arguments.sequence.shots(camera, &output)?;
    let Some(first) = shots.first() else { return Ok(ExitCode::SUCCESS) };
    first.output.check()?;
    let layers = arguments.layers(&output);
    // The worker asks again: here it is no failure of the renderer.
    drop(Film::reserve(camera.resolution).map_err(|error| error.to_string())?);
    let _layers = layers::reserve(&layers.0, camera.resolution).map_err(|error| error.to_string())?;
    let reference = Reference::of(&scene);
    let mismatch = reference.as_ref().and_then(|truth| truth.mismatch(camera.resolution));
    mismatch.iter().for_each(|mismatch| tell(&format!("note: {mismatch}")));
    let infinite = scene.infinite_variance(&settings);
    scene.warnings().iter().chain(&infinite).for_each(|warning| tell(&format!("note: {warning}")));
    let threads = Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?;
    let job = Job {
        scene_path: &arguments.scene,
        settings,
        display: arguments.display.display(),
        layers: &layers,
        denoises: arguments.denoise,
        reference,
        threads: threads.count(),
        build_seconds: start.elapsed().as_secs_f64(),
        is_sequence: arguments.sequence.is_asked(),
        scene_options: arguments.options.words(),
        scene_remarks: remarks,
        json: arguments.json,
        scene,
    };
    let mut rendering = Rendering::new(threads, arguments.budget(&job.scene), shots.len() as u64, job.json)?;
    for shot in &shots {
        let done = job.render(&mut rendering, shot)?;
        if done != ExitCode::SUCCESS {
            return Ok(done);
        }
    }
    Ok(ExitCode::SUCCESS)
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

    /// The layers of the image, which only an EXR can have. Tells which options have no effect.
    fn layers(&self, output: &Output) -> Layers {
        let layers = self.layers.clone().unwrap_or_default();
        if output.format() != Some(Format::Exr) {
            if !layers.0.is_empty() {
                tell("note: --layers affects an EXR only");
            }
            return Layers::default();
        }
        if self.display.display() != Display::default() {
            tell("note: an EXR stores the radiance unchanged; --exposure, --white-balance and --tone affect a PNG only");
        }
        layers
    }

    fn form(&self) -> Form<'_> {
        match &self.csv {
            Some(path) => Form::Csv(path),
            None if self.latex => Form::Latex,
            None if self.json => Form::Json,
            None => Form::Text,
        }
    }

    fn budget(&self, scene: &Scene) -> Budget {
        let by_samples = self.time.is_none() && self.noise.is_none();
        let max_spp = by_samples.then(|| self.spp.or(scene.spp).unwrap_or(DEFAULT_SPP));
        Budget { max_spp, max_time: self.time, noise: self.noise, halves: self.denoise, ..Budget::default() }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use noisefall::scene::built_in;

    use super::*;

    /// The program's arguments behind `render a.toml -o a.png`.
    fn arguments(options: &str) -> Arguments {
        #[derive(Parser)]
        struct Program {
            #[command(flatten)]
            arguments: Arguments,
        }
        let words = format!("render a.toml -o a.png {options}");
        Program::try_parse_from(words.split_whitespace()).expect("they are right").arguments
    }

    #[test]
    fn every_option_takes_the_place_of_the_scenes_setting_and_of_no_other() {
        let scene = built_in();
        let of_scene = scene.settings;
        assert_eq!(arguments("").settings(&scene), of_scene);
        for (option, expected) in [
            ("--estimator path", RenderSettings { estimator: Estimator::Path, ..of_scene }),
            ("--directions uniform", RenderSettings { directions: Directions::Uniform, ..of_scene }),
            ("--sampler stratified", RenderSettings { sampler: Sampler::Stratified, ..of_scene }),
            ("--max-bounces 3", RenderSettings { max_bounces: Some(3), ..of_scene }),
            ("--roulette 0.5", RenderSettings { roulette: Roulette::fixed(0.5), ..of_scene }),
            ("--reuse on", RenderSettings { reuse: Reuse::On, ..of_scene }),
            ("--adaptive on", RenderSettings { adaptive: true, ..of_scene }),
            ("--seed 7", RenderSettings { seed: 7, ..of_scene }),
        ] {
            assert_ne!(expected, of_scene, "{option} changes nothing");
            assert_eq!(arguments(option).settings(&scene), expected, "{option}");
        }
        let mut capped = built_in();
        capped.settings.max_bounces = Some(2);
        assert_eq!(arguments("--max-bounces none").settings(&capped).max_bounces, None);
        assert_eq!(arguments("").settings(&capped).max_bounces, Some(2));
    }

    #[test]
    fn the_last_target_counts_then_the_scenes_and_then_the_default() {
        let mut scene = built_in();
        scene.spp = Some(33);
        let budget = |max_spp, max_time, noise| Budget { max_spp, max_time, noise, ..Budget::default() };
        let second = Some(Duration::from_secs(1));
        for (options, expected) in [
            ("", budget(Some(33), None, None)),
            ("--spp 5", budget(Some(5), None, None)),
            ("--time 1", budget(None, second, None)),
            ("--noise 0.1", budget(None, None, Some(0.1))),
            ("--spp 5 --noise 0.1 --time 1", budget(None, second, None)),
            ("--time 1 --spp 5 --noise 0.1", budget(None, None, Some(0.1))),
            ("--noise 0.1 --time 1 --spp 5", budget(Some(5), None, None)),
        ] {
            assert_eq!(arguments(options).budget(&scene), expected, "{options}");
        }
        scene.spp = None;
        assert_eq!(arguments("").budget(&scene), budget(Some(256), None, None));
    }
}
