//! `render --samples A..B`: a range of samples of every pixel, in exact sums that `merge` joins.
use std::{
    ops::Range,
    path::{Path, PathBuf},
    process::ExitCode,
    sync::{Arc, atomic::Ordering},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressStyle};
use noisefall_base::file;
use noisefall_formats::import::ImportOptions;
use noisefall_render::{
    render::{
        Display, RenderRequest,
        checkpoint::{checkpoint_header, counters, keep_scene},
        image_file,
        pass::Failure as RenderFailure,
        path_reuse::resolved,
        replay_command::replay_command,
        split::{SampleFilm, SampleRanges, SplitError, write},
        threads::{PassJob, Threads},
    },
    render_file::{Header, ImageFacts, Kind, Target},
};
use noisefall_scene::scene::{RenderSettings, Scene, description::SceneDescription};

use crate::kept_scene::choices;

use super::{
    messages::{Failure, tell},
    output::Output,
    sequence::{DROPPED, Shot, UNFINISHED},
    split_image::{SplitImage, is_sample_file, without_samples},
    stop::{INTERRUPTED, stop_signal},
    unused::tell_unused,
};

/// Ends of samples that are rendered at least so far apart: an interruption waits for one.
const STEP: Duration = Duration::from_secs(2);

/// Why targets do not split, and what to do instead.
const ROUNDS: &str = "cannot be combined with --samples, because where it stops depends on the samples or on the machine. Render rounds \
                      of a fixed number of samples, such as 0..64, then 64..128; `noisefall merge` prints the estimated error after each round";

/// The mistake in the options of a range of samples, if there is one. `others` are the options that a range excludes.
pub fn mistake(output: Option<&Output>, has_range: bool, others: &[(&str, bool)]) -> Option<String> {
    let output = output?;
    if !has_range {
        let advice = "a file of samples needs a range of samples: add --samples A..B, such as --samples 0..64";
        return is_sample_file(output).then(|| format!("{output}: {advice}"));
    }
    let (option, _) = others.iter().find(|(_, is_given)| *is_given)?;
    Some(match *option {
        "--time" | "--noise" => format!("{option} {ROUNDS}"),
        option => format!("{option} cannot be combined with --samples, which keeps only sums of the image"),
    })
}

/// The scene, settings and options that all images of a command share.
pub struct SampleJob {
    pub scene: Arc<Scene>,
    pub scene_path: PathBuf,
    /// The description of a scene of another program.
    pub description: Option<Arc<SceneDescription>>,
    pub import: ImportOptions,
    /// The options of the scene as words of a command.
    pub scene_options: String,
    pub settings: RenderSettings,
    pub display: Display,
    pub range: Range<u32>,
    pub threads: Threads,
    pub is_sequence: bool,
    pub json: bool,
}

impl SampleJob {
    /// Renders the samples of each image.
    pub fn run(&self, shots: &[Shot]) -> Result<ExitCode, Failure> {
        self.scene.notes(&self.settings).iter().for_each(|note| tell(&format!("warning: {note}")));
        let written = "interrupted: writing the samples so far (interrupt again to stop at once)";
        let stop = stop_signal(if self.is_sequence { DROPPED } else { written })?;
        for shot in shots {
            let check = |path: &Path| match is_sample_file(&shot.output) {
                true => file::check(path).map_err(|error| error.to_string()),
                false => image_file::check_target(path).map_err(|error| error.to_string()),
            };
            shot.output.file().map_or_else(|| shot.output.check(), check)?;
        }
        for shot in shots {
            let done = self.image(shot, &|| stop.load(Ordering::Relaxed))?;
            if done != ExitCode::SUCCESS {
                return Ok(done);
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    fn image(&self, shot: &Shot, stopped: &(dyn Fn() -> bool + Sync)) -> Result<ExitCode, Failure> {
        let request = RenderRequest { scene: self.scene.clone(), camera: shot.camera, settings: self.settings };
        let header = self.header(&request)?;
        let rays = self.scene.rays(&shot.camera);
        tell_unused(&self.threads, &self.scene, &rays, &self.settings);
        let settings = self.threads.install(|| resolved(&self.scene, &rays, &self.settings));
        let job = PassJob { scene: &self.scene, rays: &rays, settings: &settings };
        let start = Instant::now();
        let film = match self.film(job, stopped) {
            Err(SplitError::Interrupted) => return Ok(ExitCode::from(INTERRUPTED)),
            film => film.map_err(|error| error.to_string())?,
        };
        if let Some(failure) = &film.count().failure {
            return Err(self.failure(failure, shot));
        }
        let samples = film.samples();
        let is_whole = samples.total() == self.range.end - self.range.start;
        // A file of the frame would stand for a frame that is finished.
        if self.is_sequence && !is_whole {
            tell(UNFINISHED);
            return Ok(ExitCode::from(INTERRUPTED));
        }
        let image = ImageFacts {
            title: self.scene.title.clone(),
            exposure: self.scene.exposure,
            shares: self.scene.path_reuse(&rays, &settings).correlates(),
        };
        let header = Header {
            kind: Kind::Samples,
            counters: counters(film.count(), start.elapsed()),
            samples: samples.list().to_vec(),
            image: Some(image),
            ..header
        };
        self.deliver(shot, &header, film, &samples)?;
        if !is_whole {
            let rest = samples.list().last().map_or(self.range.start, |last| last[1])..self.range.end;
            tell(&format!("interrupted: `--samples {}..{}` renders the rest, into another file", rest.start, rest.end));
            return Ok(ExitCode::from(INTERRUPTED));
        }
        Ok(ExitCode::SUCCESS)
    }

    fn header(&self, request: &RenderRequest) -> Result<Header, Failure> {
        let kept = keep_scene(&self.scene, &self.scene_path, choices(&self.scene_path, &self.import));
        let header = checkpoint_header(request, kept, self.description.as_deref(), Target::default(), &self.threads);
        header.map_err(|error| error.report())
    }

    /// The film of the range, or of what was rendered of it until an interruption.
    fn film(&self, job: PassJob, stopped: &(dyn Fn() -> bool + Sync)) -> Result<SampleFilm, SplitError> {
        let Range { start, end } = self.range;
        let bar = bar(&self.range, self.json);
        let mut film = SampleFilm::begin(&self.threads, job, start..end, stopped)?;
        let (mut at, mut step) = (start, 1);
        while at < end && film.count().failure.is_none() && (at == start || !stopped()) {
            let begun = Instant::now();
            let next = end.min(at.saturating_add(step));
            film.advance(&self.threads, job, next, &|| false);
            let seconds = begun.elapsed().as_secs_f64() / f64::from(next - at);
            step = ((STEP.as_secs_f64() / seconds.max(1e-9)) as u32).max(1);
            at = next;
            bar.set_position((at - start).into());
        }
        bar.finish_and_clear();
        Ok(film)
    }

    fn failure(&self, failure: &RenderFailure, shot: &Shot) -> Failure {
        let command = || replay_command(&self.scene_path, &self.scene, shot.camera.resolution, &self.settings, failure.at);
        let replay = if failure.replays { format!("\nreplay: {}{}", command(), self.scene_options) } else { String::new() };
        format!("the renderer failed: {}{replay}", failure.message)
    }

    fn deliver(&self, shot: &Shot, header: &Header, film: SampleFilm, samples: &SampleRanges) -> Result<(), Failure> {
        let output = &shot.output;
        let image = SplitImage { output, header, samples, missing: SampleRanges::default(), json: self.json };
        if let Some(path) = output.file().filter(|_| is_sample_file(output)) {
            write(path, header, film.sums()).map_err(|error| error.to_string())?;
            return image.report(None);
        }
        let mut picture = image.picture()?;
        for sums in film.into_sums() {
            picture.add(&sums).map_err(|error| without_samples(output, &error))?;
        }
        image.deliver(picture, self.display).map(|_| ())
    }
}

fn bar(range: &Range<u32>, quiet: bool) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} spp  {elapsed} elapsed, {eta} left");
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new((range.end - range.start).into()) };
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
