//! `noisefall render`: renders an image without a window, with the worker that also serves the window.
mod arguments;
mod begin;
#[cfg(test)]
mod tests;

use std::{
    ops::Range,
    path::Path,
    process::ExitCode,
    time::{Duration, Instant},
};

use noisefall_base::math::SimdLevel;
use noisefall_render::{
    render::{Budget, RenderRequest, image_file::Format, path_reuse::resolved, reference::Reference, threads::Threads},
    render_file::Target,
};
use noisefall_scene::scene::{Estimator, RenderSettings, Scene};

pub use self::arguments::Arguments;
use self::begin::Begun;
use super::{
    checkpointing::{Checkpointing, KeptImage},
    frame_checkpoints::FrameCheckpoints,
    layers::Layers,
    live::LiveView,
    messages::{Failure, tell, wrong_usage},
    output::Output,
    progress::{Plan, Rendering},
    render_memory,
    replay::{self, Form, Which},
    samples::{self, SampleJob},
    sequence::Shot,
    shot::Job,
    unused::tell_unused,
};

/// Samples per pixel if neither the command nor the scene states a number.
const DEFAULT_SPP: u32 = 256;

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
    output.iter().filter_map(|output| arguments.display.unused(output.format())).for_each(tell);
    if let (Some(range), Some(output)) = (&arguments.samples, &output) {
        let shots = arguments.sequence.shots(begun.camera, output, None)?;
        return arguments.sample_job(begun, range.clone())?.run(&shots);
    }
    let Begun { scene, path, description, remarks, camera, settings, resumed } = begun;
    if let Some(pixel) = arguments.pixel {
        arguments.unused_by_replay().into_iter().for_each(|note| tell(&note));
        let which = arguments.sample.unwrap_or(Which::One(0));
        return replay::run(&scene, &camera, &settings, pixel, which, arguments.form()).map(|()| ExitCode::SUCCESS);
    }
    let Some(output) = output else { return Err("no output file".to_owned()) };
    let shots = arguments.sequence.shots(camera, &output, arguments.keep.checkpoint())?;
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
    print_notes(&scene, &settings, reference.as_ref(), camera.resolution);
    let rays = scene.rays(&camera);
    let threads = || Threads::new(arguments.threads.into(), SimdLevel::best()).map_err(|error| error.to_string());
    let of_images = threads()?;
    tell_unused(&of_images, &scene, &rays, &settings);
    if settings.estimator == Estimator::Auto {
        of_images.install(|| resolved(&scene, &rays, &settings));
        scene.estimator_in_force(&settings).iter().for_each(|chosen| tell(&format!("warning: estimator `auto` is {chosen}")));
    }
    let request = RenderRequest { scene: scene.clone(), camera, settings };
    let image = KeptImage { request: &request, description: description.as_deref(), path: &path, size: arguments.size };
    let frames = arguments.frame_checkpoints(image, &budget, &shots, &of_images)?;
    let mut keeping = match frames {
        Some(_) => Checkpointing::default(),
        None => arguments.keep.keeping(image, &arguments.options, &budget, resumed, &of_images)?,
    };
    let job = Job {
        scene_path: &path,
        settings,
        display: arguments.display.display(scene.exposure),
        layers: &layers,
        denoises: arguments.denoise,
        reference,
        threads: of_images,
        build_seconds: start.elapsed().as_secs_f64(),
        is_sequence: arguments.sequence.is_asked(),
        scene_options: arguments.options.words(),
        scene_remarks: remarks,
        json: arguments.json,
        scene,
    };
    let images = shots.len() as u64;
    let plan = Plan {
        images,
        has_bounces: layers.has_bounces(),
        is_sequence: job.is_sequence,
        is_kept: keeping.plan.is_some() || frames.is_some(),
    };
    let live = LiveView::connect(arguments.tev.as_deref(), name(&job.scene, &path))?;
    let mut rendering = Rendering::new(threads()?, budget, plan, job.json, live)?;
    let mut done = ExitCode::SUCCESS;
    for shot in &shots {
        if let (Some(frames), Some(checkpoint)) = (&frames, &shot.checkpoint) {
            keeping = frames.keeping(&job.request(shot), checkpoint, &job.threads)?;
        }
        rendering.keep(std::mem::take(&mut keeping));
        done = job.render(&mut rendering, shot)?;
        if done != ExitCode::SUCCESS {
            break;
        }
        if frames.is_some() {
            rendering.discard_checkpoint()?;
        }
    }
    rendering.finish().map(|()| done)
}

/// Prints what is legal but probably not meant.
fn print_notes(scene: &Scene, settings: &RenderSettings, reference: Option<&Reference>, resolution: [u32; 2]) {
    let mismatch = reference.and_then(|truth| truth.mismatch(resolution));
    let notes = mismatch.into_iter().chain(scene.notes(settings));
    notes.for_each(|note| tell(&format!("warning: {note}")));
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
        of_sequence
            .or_else(|| count.map(str::to_owned))
            .or_else(|| self.keep.mistake(resumed, self.sequence.is_asked()))
            .or_else(of_samples)
    }

    /// The layers of the image, which only an EXR can have. Tells which options have no effect.
    fn layers(&self, output: &Output) -> Layers {
        let layers = self.layers.clone().unwrap_or_default();
        if output.format() != Some(Format::Exr) {
            if !layers.0.is_empty() {
                tell("warning: --layers affects an EXR only");
            }
            return Layers::default();
        }
        layers
    }

    /// Says which options have no effect on the replay of a sample. A command that the program prints has all settings of the render.
    fn unused_by_replay(&self) -> Option<String> {
        let given = [
            ("--spp", self.spp.is_some()),
            ("--time", self.time.is_some()),
            ("--noise", self.noise.is_some()),
            ("--threads", self.threads > 0),
            ("--exposure, --white-balance and --tone", self.display.unused(None).is_some()),
        ];
        let given: Vec<&str> = given.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name).collect();
        (!given.is_empty()).then(|| format!("warning: --pixel replays single samples; it does not use {}", given.join(", ")))
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
            import: self.options.import_options(self.size),
            scene_options: self.options.words(),
            settings,
            display: self.display.display(scene.exposure),
            range,
            threads: Threads::new(self.threads.into(), SimdLevel::best()).map_err(|error| error.to_string())?,
            is_sequence: self.sequence.is_asked(),
            json: self.json,
            scene,
        })
    }

    /// How the frames of a sequence are kept, if they are.
    fn frame_checkpoints(
        &self,
        image: KeptImage<'_>,
        budget: &Budget,
        shots: &[Shot],
        threads: &Threads,
    ) -> Result<Option<FrameCheckpoints>, Failure> {
        if !(self.sequence.is_asked() && self.keep.is_asked()) {
            return Ok(None);
        }
        let header = image.header(&self.options, budget, threads)?;
        let frames = FrameCheckpoints { header, every: self.keep.every(), continues: self.sequence.is_continued() };
        for Shot { camera, checkpoint, .. } in shots {
            let frame = RenderRequest { camera: *camera, ..image.request.clone() };
            checkpoint.as_ref().map_or(Ok(()), |path| frames.check(&frame, path, threads))?;
        }
        Ok(Some(frames))
    }

    fn form(&self) -> Form<'_> {
        match &self.csv {
            Some(path) => Form::Csv(path),
            None if self.latex => Form::Latex,
            None if self.json => Form::Json,
            None => Form::Text,
        }
    }

    /// The target of a render: that of the options, or that of the render that is continued. Fails if it is not enough for denoising.
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
