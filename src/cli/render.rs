//! `noisefall render`: renders an image without a window, with the worker that also serves the window.
mod begin;
#[cfg(test)]
mod tests;

use std::{
    ops::Range,
    path::{Path, PathBuf},
    process::ExitCode,
    time::{Duration, Instant},
};

use clap::ArgGroup;
use noisefall::{
    math::SimdLevel,
    render::{
        Budget, Display, RenderRequest, image_file::Format, layers::Layer, sharing::resolved, tev::DEFAULT_ADDRESS,
        threads::Threads, truth::Reference,
    },
    render_file::Target,
    sampling::{Directions, Sampler},
    scene::{Estimator, Reuse, Roulette, Scene},
};

use self::begin::Begun;
use super::{
    keeping::KeepOptions,
    layers::{Layers, parse as layers_of},
    live::{self, LiveView},
    messages::{Failure, tell, wrong_usage},
    options::{self as parse, BounceCap, DisplayOptions},
    output::Output,
    progress::{Plan, Rendering},
    render_memory,
    replay::{self, Form, Which},
    samples::{self, SampleJob},
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
    override_usage = "noisefall render [OPTIONS] <SCENE> -o <OUTPUT>\n       noisefall render [OPTIONS] --resume <FILE> -o <OUTPUT>\n       \
                      noisefall render [OPTIONS] <SCENE> --pixel <X,Y>"
)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    #[arg(required_unless_present = "resume")]
    scene: Option<PathBuf>,
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
    /// Render the samples A to B - 1 of every pixel into sums whose bits do not depend on their order. -o FILE.nf keeps them for
    /// `noisefall merge`, which joins any ranges to the bits of one run; -o FILE.exr or .png writes their image
    #[arg(long, value_name = "A..B", value_parser = parse::sample_range, requires = "output", conflicts_with = "spp")]
    samples: Option<Range<u32>>,
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
    #[command(flatten)]
    keep: KeepOptions,
    /// Show the image in the viewer tev while it is rendered: linear radiance, at most once a second
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = DEFAULT_ADDRESS, value_parser = live::address,
          conflicts_with = "pixel")]
    tev: Option<String>,
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
    if let Some(mistake) = arguments.mistake(output.as_ref()) {
        return Ok(wrong_usage(&mistake));
    }
    let start = Instant::now();
    let begun = arguments.begin()?;
    begun.camera.check().map_err(|error| error.to_string())?;
    if let (Some(range), Some(output)) = (&arguments.samples, &output) {
        let shots = arguments.sequence.shots(begun.camera, output)?;
        return arguments.sample_job(begun, range.clone())?.run(&shots);
    }
    let Begun { scene, path, description, remarks, camera, settings, resumed } = begun;
    if let Some(pixel) = arguments.pixel {
        let which = arguments.sample.unwrap_or(Which::One(0));
        return replay::run(&scene, &camera, &settings, pixel, which, arguments.form()).map(|()| ExitCode::SUCCESS);
    }
    let Some(output) = output else { return Err("no output file".to_owned()) };
    let shots = arguments.sequence.shots(camera, &output)?;
    if shots.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    shots.iter().try_for_each(|shot| shot.output.check())?;
    let budget = arguments.budget(&scene, resumed.as_ref().map(|resumed| resumed.header().target))?;
    let layers = arguments.layers(&output);
    let memory =
        render_memory::reserve(&layers.0, arguments.denoise, arguments.keep.is_asked() || resumed.is_some(), camera.resolution);
    let _memory = memory.map_err(|error| error.to_string())?;
    let reference = Reference::of(&scene);
    let mismatch = reference.as_ref().and_then(|truth| truth.mismatch(camera.resolution));
    mismatch.iter().for_each(|mismatch| tell(&format!("note: {mismatch}")));
    let infinite = scene.infinite_variance(&settings);
    let missing = scene.lacks_light_paths(&settings);
    scene.warnings().iter().chain(&infinite).chain(&missing).for_each(|warning| tell(&format!("note: {warning}")));
    let threads = || Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string());
    let of_images = threads()?;
    if settings.estimator == Estimator::Auto {
        of_images.install(|| resolved(&scene, &scene.rays(&camera), &settings));
        scene.estimator_in_force(&settings).iter().for_each(|chosen| tell(&format!("note: estimator `auto` is {chosen}")));
    }
    let request = RenderRequest { scene: scene.clone(), camera, settings };
    let keeping =
        arguments.keep.keeping((&request, description.as_deref(), &path), &arguments.options, &budget, resumed, &of_images)?;
    let job = Job {
        scene_path: &path,
        settings,
        display: arguments.display.display(scene.exposure),
        layers: &layers,
        denoises: arguments.denoise,
        reference,
        threads: of_images,
        mixed: keeping.remarks.clone(),
        build_seconds: start.elapsed().as_secs_f64(),
        is_sequence: arguments.sequence.is_asked(),
        scene_options: arguments.options.words(),
        scene_remarks: remarks,
        json: arguments.json,
        scene,
    };
    let plan = Plan { images: shots.len() as u64, has_bounces: layers.has_bounces(), is_sequence: job.is_sequence };
    let live = LiveView::connect(arguments.tev.as_deref(), name(&job.scene, &path))?;
    let mut rendering = Rendering::new(threads()?, budget, plan, job.json, live)?;
    rendering.keep(keeping);
    for shot in &shots {
        let done = job.render(&mut rendering, shot)?;
        if done != ExitCode::SUCCESS {
            return Ok(done);
        }
    }
    rendering.finish().map(|()| ExitCode::SUCCESS)
}

/// The title of a scene, or else the name of its file.
fn name(scene: &Scene, path: &Path) -> String {
    let of_file = || path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if scene.title.is_empty() { of_file() } else { scene.title.clone() }
}

impl Arguments {
    /// The mistake in options that clap does not find, if there is one.
    fn mistake(&self, output: Option<&Output>) -> Option<String> {
        let resumed = self.sequence.resumed();
        let scenes = [self.scene.as_deref(), self.sequence.scene(), resumed].into_iter().flatten().count();
        let count = match scenes {
            0 => Some("the scene is missing"),
            1 => None,
            _ => Some("give either a scene or --resume FILE: the file has its scene"),
        };
        let of_sequence = self.sequence.mistake(output);
        let of_samples = || samples::mistake(output, self.samples.is_some(), &self.excluded_by_samples());
        of_sequence.or_else(|| count.map(str::to_owned)).or_else(|| self.keep.mistake(resumed)).or_else(of_samples)
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
        if self.display.display(0.0) != Display::default() {
            tell("note: an EXR stores the radiance unchanged; --exposure, --white-balance and --tone affect a PNG only");
        }
        layers
    }

    /// The options that a range of samples excludes, and whether they are given.
    fn excluded_by_samples(&self) -> [(&'static str, bool); 7] {
        [
            ("--time", self.time.is_some()),
            ("--noise", self.noise.is_some()),
            ("--layers", self.layers.is_some()),
            ("--denoise", self.denoise),
            ("--tev", self.tev.is_some()),
            ("--checkpoint", self.keep.is_asked()),
            ("--resume FILE", self.sequence.resumed().is_some()),
        ]
    }

    fn sample_job(&self, begun: Begun, range: Range<u32>) -> Result<SampleJob, Failure> {
        let Begun { scene, path, description, settings, .. } = begun;
        Ok(SampleJob {
            scene_path: path,
            description,
            import: self.options.import_options(),
            scene_options: self.options.words(),
            settings,
            display: self.display.display(scene.exposure),
            range,
            threads: Threads::new(self.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?,
            json: self.json,
            scene,
        })
    }

    fn form(&self) -> Form<'_> {
        match &self.csv {
            Some(path) => Form::Csv(path),
            None if self.latex => Form::Latex,
            None if self.json => Form::Json,
            None => Form::Text,
        }
    }

    /// How far to render an image of a scene: as far as is said, or as far as the render was to go that is continued. Fails if that
    /// is not enough for denoising.
    fn budget(&self, scene: &Scene, before: Option<Target>) -> Result<Budget, Failure> {
        let is_said = self.spp.is_some() || self.time.is_some() || self.noise.is_some();
        let budget = match before.filter(|_| !is_said) {
            Some(Target { spp, seconds, noise }) => {
                let max_time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
                Budget { max_spp: spp, max_time, noise, ..Budget::default() }
            }
            None => {
                let by_samples = self.time.is_none() && self.noise.is_none();
                let max_spp = by_samples.then(|| self.spp.or(scene.spp).unwrap_or(DEFAULT_SPP));
                Budget { max_spp, max_time: self.time, noise: self.noise, ..Budget::default() }
            }
        };
        if self.denoise && budget.max_spp == Some(1) {
            return Err("--denoise needs two samples per pixel or more: render with --spp 2 or more".to_owned());
        }
        Ok(Budget { halves: self.denoise, ..budget })
    }
}
