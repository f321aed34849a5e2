//! `render --checkpoint` and `render --resume`: renders that are kept, and continued.
use std::{
    path::{Path, PathBuf},
    time::Duration,
};

use crossbeam_channel::{Receiver, unbounded};
use noisefall_base::{
    file::{self, numbered},
    progress::Progress,
    quote,
};
use noisefall_formats::import::Opened;
use noisefall_render::{
    render::{
        Budget, RenderRequest,
        checkpoint::{
            Checkpoint, CheckpointEvent, CheckpointFile, CheckpointPlan, EXTENSION, checkpoint_header, file_differences,
            is_checkpoint_file, keep_scene, probe_difference,
        },
        threads::Threads,
    },
    render_file::{Header, Target},
};
use noisefall_scene::scene::description::SceneDescription;

use crate::kept_scene::{choices, reopen};

use super::{
    headings,
    loading::with_bar,
    messages::{Failure, tell},
    options as parse,
    scene_file::SceneOptions,
};

/// Time between two checkpoints.
const EVERY: Duration = Duration::from_secs(60);

#[derive(clap::Args)]
pub struct KeepOptions {
    /// Keep the render in a file (.nf) from which --resume continues it to the same bits. Of a sequence: keep the frame in progress in
    /// a file such as frame-####.nf, which is removed when the frame is finished
    #[arg(help_heading = headings::KEEP, long, value_name = "FILE", conflicts_with = "pixel", requires = "output")]
    checkpoint: Option<PathBuf>,
    /// Time between two checkpoints [default: 60]. Slow checkpoints are written less often, so that they take at most 1 % of the
    /// time
    #[arg(help_heading = headings::KEEP, long, value_name = "SECONDS", value_parser = parse::seconds)]
    every: Option<Duration>,
    /// Continue a render even if its scene or the program has changed. The result mixes both versions and is labelled
    /// biased
    #[arg(help_heading = headings::KEEP, long, requires = "resume")]
    anyway: bool,
}

/// A render that is continued.
pub struct Resumed {
    path: PathBuf,
    file: CheckpointFile,
    /// Files that are not what they were.
    differences: Vec<String>,
}

/// An image that is kept, the description of its scene if that is of another program, and the file of its scene.
#[derive(Clone, Copy)]
pub struct KeptImage<'a> {
    pub request: &'a RenderRequest,
    pub description: Option<&'a SceneDescription>,
    pub path: &'a Path,
    /// The size that the user asked for.
    pub size: Option<[u32; 2]>,
}

impl KeptImage<'_> {
    /// Returns the header of the checkpoint. Reads the files that the scene names.
    pub fn header(&self, options: &SceneOptions, budget: &Budget, threads: &Threads) -> Result<Header, Failure> {
        let choices = choices(self.path, &options.import_options(self.size));
        let scene = keep_scene(&self.request.scene, self.path, choices);
        let header = checkpoint_header(self.request, scene, self.description, target(budget), threads);
        header.map_err(|error| error.report())
    }
}

/// The plan of the checkpoints, and the one that the render continues from.
#[derive(Default)]
pub struct Checkpointing {
    pub plan: Option<CheckpointPlan>,
    pub events: Option<Receiver<CheckpointEvent>>,
    pub kept: Option<Checkpoint>,
    /// How the image differs from one that was rendered in one go.
    pub remarks: Vec<String>,
}

impl KeepOptions {
    /// Whether a render is to be kept.
    pub fn is_asked(&self) -> bool {
        self.checkpoint.is_some()
    }

    pub fn checkpoint(&self) -> Option<&Path> {
        self.checkpoint.as_deref()
    }

    /// Time between two checkpoints.
    pub fn every(&self) -> Duration {
        self.every.unwrap_or(EVERY)
    }

    /// The mistake in the options, if there is one.
    pub fn mistake(&self, resumed: Option<&Path>, is_sequence: bool) -> Option<String> {
        if let Some(path) = self.checkpoint.as_ref().filter(|path| is_sequence && numbered(path, 1).is_none()) {
            let path = path.display();
            return Some(format!(
                "{path}: the frames of a sequence need checkpoints with a number, such as --checkpoint frame-####.nf"
            ));
        }
        let is_other = |path: &PathBuf| !is_checkpoint_file(path);
        if let Some(other) = self.checkpoint.as_ref().filter(|path| is_other(path)) {
            return Some(format!("{}: the name of a checkpoint must end in .{EXTENSION}", other.display()));
        }
        if self.every.is_some() && self.checkpoint.is_none() && resumed.is_none() {
            return Some("--every is the time between checkpoints: it needs --checkpoint FILE or --resume FILE".to_owned());
        }
        (self.anyway && resumed.is_none()).then(|| "--anyway needs the file of a render, as in --resume image.nf".to_owned())
    }

    /// Opens the file of a render. Fails if files of its scene have changed.
    pub fn resume(&self, path: &Path) -> Result<Resumed, Failure> {
        let file = CheckpointFile::open(path).map_err(|error| error.to_string())?;
        let differences = file_differences(file.header(), path);
        let resumed = Resumed { path: path.to_owned(), file, differences };
        match resumed.differences.is_empty() || self.anyway {
            true => Ok(resumed),
            false => Err(resumed.refusal(&resumed.differences)),
        }
    }

    /// How a render is kept. `options` are those of its scene.
    pub fn keeping(
        &self,
        image: KeptImage<'_>,
        options: &SceneOptions,
        budget: &Budget,
        resumed: Option<Resumed>,
        threads: &Threads,
    ) -> Result<Checkpointing, Failure> {
        let Some(resumed) = resumed else {
            let Some(checkpoint) = &self.checkpoint else { return Ok(Checkpointing::default()) };
            check_new(checkpoint, &continuation(checkpoint))?;
            return Ok(Checkpointing::new(checkpoint, self.every(), image.header(options, budget, threads)?, None));
        };
        let KeptImage { request, description, .. } = image;
        let target = target(budget);
        let before = resumed.file.header().clone();
        let other_samples = probe_difference(&before, request, threads);
        let differences: Vec<String> = resumed.differences.iter().cloned().chain(other_samples).collect();
        let header = match differences.is_empty() {
            true => Header { target, program: Header::PROGRAM.to_owned(), ..before },
            false if !self.anyway => return Err(resumed.refusal(&differences)),
            false => {
                let now = checkpoint_header(request, before.scene, description, target, threads);
                let remarks = [before.remarks, vec![differences.join("; ")]].concat();
                Header { remarks, ..now.map_err(|error| error.report())? }
            }
        };
        if let Some(last) = header.remarks.last() {
            tell(&format!("warning: the first samples of this image are of another scene or program: {last}"));
        }
        let checkpoint = self.checkpoint.as_ref().unwrap_or(&resumed.path);
        if *checkpoint != resumed.path {
            check_new(checkpoint, &continuation(checkpoint))?;
        }
        file::check(checkpoint).map_err(|error| error.to_string())?;
        let kept = resumed.file.read().map_err(|error| error.to_string())?;
        let kept = if header.remarks.is_empty() { kept } else { kept.mixed() };
        Ok(Checkpointing::new(checkpoint, self.every(), header, Some(kept)))
    }
}

impl Checkpointing {
    /// Keeps a render in a file with this header.
    pub fn new(checkpoint: &Path, every: Duration, header: Header, kept: Option<Checkpoint>) -> Checkpointing {
        let (events, received) = unbounded();
        let remarks = header.remarks.clone();
        let plan = CheckpointPlan { path: checkpoint.to_owned(), header, every: Some(every), events };
        Checkpointing { plan: Some(plan), events: Some(received), kept, remarks }
    }
}

impl Resumed {
    pub fn header(&self) -> &Header {
        self.file.header()
    }

    /// Opens the scene of the file, which may read files outside of its folder if the user says so again.
    pub fn open(&self, allow_outside: bool) -> Result<Opened, Failure> {
        let progress = Progress::default();
        with_bar(&progress, || reopen(&self.header().scene, &self.path, allow_outside, &progress)).map_err(|error| error.report())
    }

    /// The error for an option that would change the image. `was` are the options of the image so far.
    pub fn changes_image(&self, option: &str, was: &str) -> Failure {
        let (option, was, path) = (option.trim(), was.trim(), quote::path(&self.path));
        format!("{path}: `{option}` would change the image, which was started with `{was}`. Leave it out, or start a new render")
    }

    /// The error for options of the scene, which is in the file.
    pub fn has_scene(&self, options: &str) -> Failure {
        format!("{}: leave out `{}`: the file has its scene with its options", quote::path(&self.path), options.trim())
    }

    fn refusal(&self, differences: &[String]) -> Failure {
        let lines: String = differences.iter().map(|line| format!("\n  {line}")).collect();
        let path = quote::path(&self.path);
        format!(
            "{path}: continuing would mix two images:{lines}\nundo these changes, start a new render, or add --anyway, which the image records"
        )
    }
}

fn continuation(checkpoint: &Path) -> String {
    format!("`render --resume {}` continues it", quote::path(checkpoint))
}

/// Checks that a new checkpoint can be written, and replaces no other render. `remedy` says how that is continued.
pub fn check_new(path: &Path, remedy: &str) -> Result<(), Failure> {
    if path.exists() {
        return Err(format!("{}: there is a render already. {remedy}; remove the file to start again", quote::path(path)));
    }
    file::check(path).map_err(|error| error.to_string())
}

fn target(budget: &Budget) -> Target {
    Target { spp: budget.max_spp, seconds: budget.max_time.map(|time| time.as_secs_f64()), noise: budget.noise }
}

/// The text about what became of a checkpoint; `None` if there is nothing to say.
pub fn message(event: &CheckpointEvent) -> Option<String> {
    match event {
        CheckpointEvent::Kept => None,
        CheckpointEvent::Slower { took, every } => {
            let (took, every) = (took.as_secs_f64(), every.as_secs_f64());
            let often = format!("a checkpoint takes {took:.2} s, so they are at least {every:.0} s apart");
            Some(format!("warning: {often}: together they take 1 % of the time at most"))
        }
        CheckpointEvent::Failed(error) => Some(format!("warning: no checkpoint was written: {error}; the render continues")),
    }
}
