//! `noisefall merge`: joins files of samples, in any order and grouping, to the bits of one run.
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    process::ExitCode,
    sync::atomic::{AtomicBool, Ordering},
    thread::sleep,
    time::{Duration, Instant},
};

use noisefall::{
    file, quote,
    render::{
        checkpoint::EXTENSION,
        image_file::{self, Format},
        split::{Join, SampleFile, SampleFileError, SampleRanges, write},
    },
};

use super::{
    messages::{Failure, tell, wrong_usage},
    options::{self as parse, DisplayOptions},
    output::Output,
    split_image::{SplitImage, is_sample_file, without_samples},
    stop::{INTERRUPTED, stop_signal},
};

const NOTES: &str = "\
The files come from `render --samples A..B -o NAME.nf`, or from `merge` itself. However the samples are split, the image has the bits of \
`render --samples 0..N`. Files of other scenes, cameras, settings or programs are refused, and so are duplicate and missing samples.

Example: noisefall merge part-*.nf -o image.exr";

/// Time between two looks at the files.
const EVERY: &str = "2";
const TICK: Duration = Duration::from_millis(100);

#[derive(clap::Args)]
#[command(allow_negative_numbers = true, after_help = NOTES)]
pub struct Arguments {
    /// Files of samples (.nf); with --watch also folders, whose files of samples are joined as they arrive
    #[arg(required = true, value_name = "FILES")]
    files: Vec<PathBuf>,
    /// File to write: .exr or .png for the image, .nf for samples to be joined further; - for standard output
    #[arg(short, long)]
    output: PathBuf,
    /// Format of an image on standard output: png or exr
    #[arg(long, value_name = "FORMAT", value_parser = parse::format)]
    format: Option<Format>,
    /// Join the samples even if some in between are missing. The metadata of the image say so
    #[arg(long)]
    allow_gaps: bool,
    /// Fail unless the samples are 0..N
    #[arg(long, value_name = "N", value_parser = parse::samples)]
    until: Option<u32>,
    /// Wait for missing or incomplete files, and check them every SECONDS, until the samples are 0..N
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = EVERY, value_parser = parse::seconds,
          requires = "until", conflicts_with = "allow_gaps")]
    watch: Option<Duration>,
    #[command(flatten)]
    display: DisplayOptions,
    /// Print one line of JSON at the end; on standard error if the image goes to standard output
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let output = match Output::of(&arguments.output, arguments.format) {
        Ok(output) => output,
        Err(mistake) => return Ok(wrong_usage(&mistake)),
    };
    check(&output)?;
    let joined = match arguments.watch {
        Some(every) => arguments.watch(every)?,
        None => Some(arguments.join()?),
    };
    let Some(join) = joined else { return Ok(ExitCode::from(INTERRUPTED)) };
    let missing = join.samples().missing(arguments.until);
    if !missing.is_empty() && !arguments.allow_gaps && !is_sample_file(&output) {
        let advice = "render them, or add --allow-gaps, which the image records";
        return Err(format!("the samples {missing} are missing; there are {}: {advice}", join.samples()));
    }
    arguments.deliver(join, &output, missing)
}

/// Checks before the files are read that the output can be written.
fn check(output: &Output) -> Result<(), Failure> {
    match output.file() {
        Some(path) if is_sample_file(output) => file::check(path).map_err(|error| error.to_string()),
        Some(path) if Format::of(path).is_err() => {
            Err(format!("{}: the name must end in .exr, .png or .{EXTENSION}", path.display()))
        }
        Some(path) => image_file::check_target(path).map_err(|error| error.to_string()),
        None => output.check(),
    }
}

impl Arguments {
    /// Joins all files. Their headers are compared first, so that a mistake is found before any work.
    fn join(&self) -> Result<Join, Failure> {
        let open = |path: &PathBuf| SampleFile::open(path).map_err(|error| error.to_string());
        let first = self.files.first().ok_or("no files").map(open)??;
        let mut join = Join::begin(&first).map_err(|error| error.to_string())?;
        for path in &self.files {
            join.enter(&open(path)?).map_err(|error| error.to_string())?;
        }
        join.sources().iter().for_each(|(path, samples)| tell(&format!("{}: samples {samples}", quote::path(path))));
        for path in &self.files {
            join.add(open(path)?).map_err(|error| error.to_string())?;
        }
        Ok(join)
    }

    /// Joins files as they arrive until all samples are there. `None` after an interruption.
    fn watch(&self, every: Duration) -> Result<Option<Join>, Failure> {
        let stop = stop_signal("interrupted: nothing is written")?;
        let mut join: Option<Join> = None;
        loop {
            for path in self.present() {
                if join.as_ref().is_some_and(|join| join.has(&path)) {
                    continue;
                }
                // It may still be on its way: the next look tells.
                let Ok(file) = whole(&path) else { continue };
                let mut joined = match join.take() {
                    Some(join) => join,
                    None => Join::begin(&file).map_err(|error| error.to_string())?,
                };
                joined.enter(&file).and_then(|()| joined.add(file)).map_err(|error| error.to_string())?;
                let missing = joined.samples().missing(self.until);
                let left = if missing.is_empty() { "complete".to_owned() } else { format!("missing: {missing}") };
                tell(&format!("{}: joined; samples {}, {left}", quote::path(&path), joined.samples()));
                join = Some(joined);
            }
            let is_complete = |join: &Join| join.samples().missing(self.until).is_empty();
            if join.as_ref().is_some_and(is_complete) {
                return Ok(join);
            }
            if !wait(every, &stop) {
                return Ok(None);
            }
        }
    }

    /// The files that are there now, those in folders included.
    fn present(&self) -> BTreeSet<PathBuf> {
        let mut present = BTreeSet::new();
        for path in &self.files {
            match std::fs::read_dir(path) {
                Ok(entries) => present.extend(entries.flatten().map(|entry| entry.path()).filter(|path| self.is_source(path))),
                Err(_) => _ = present.insert(path.clone()),
            }
        }
        present
    }

    /// Whether a file of a folder is to be joined.
    fn is_source(&self, path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension == EXTENSION) && *path != self.output
    }

    fn deliver(&self, join: Join, output: &Output, missing: SampleRanges) -> Result<ExitCode, Failure> {
        let (header, samples) = (join.header().clone(), join.samples().clone());
        if let Some(path) = output.file().filter(|_| is_sample_file(output)) {
            let image =
                SplitImage { output, header: &header, samples: &samples, missing: SampleRanges::default(), json: self.json };
            write(path, &header, join.sums()).map_err(|error| error.to_string())?;
            return image.report(None).map(|()| ExitCode::SUCCESS);
        }
        let image = SplitImage { output, header: &header, samples: &samples, missing, json: self.json };
        let mut picture = image.picture()?;
        for sums in join.into_sums() {
            picture.add(&sums).map_err(|error| without_samples(output, &error))?;
        }
        let exposure = header.image.as_ref().map_or(0.0, |image| image.exposure);
        image.deliver(picture, self.display.display(exposure))
    }
}

/// Opens a file, if all of it is there.
fn whole(path: &Path) -> Result<SampleFile, SampleFileError> {
    SampleFile::open(path)?.read(|_, _| Ok::<(), SampleFileError>(()))?;
    SampleFile::open(path)
}

/// Waits; `false` if it was interrupted.
fn wait(time: Duration, stop: &AtomicBool) -> bool {
    let start = Instant::now();
    while start.elapsed() < time && !stop.load(Ordering::Relaxed) {
        sleep(TICK.min(time));
    }
    !stop.load(Ordering::Relaxed)
}
