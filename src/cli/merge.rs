//! `noisefall merge`: joins files of samples, in any order and grouping, to the bits of one run.
use std::{
    path::PathBuf,
    process::ExitCode,
    sync::atomic::{AtomicBool, Ordering},
    thread::sleep,
    time::{Duration, Instant},
};

use noisefall_base::{file, quote};
use noisefall_render::render::{
    checkpoint::EXTENSION,
    image_file::{self, Format},
    split::{Join, SampleFile, SampleRanges, write},
};

use super::{
    messages::{Failure, tell, wrong_usage},
    options::{self as parse, DisplayOptions},
    output::Output,
    split_image::{SplitImage, is_sample_file, without_samples},
    stop::{INTERRUPTED, stop_signal},
    watched_files::Watch,
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
        Err(mistake) => return Ok(wrong_usage(&format!("{mistake}; or in .{EXTENSION}, for samples to be joined further"))),
    };
    check(&output)?;
    arguments.display.unused(output.format()).into_iter().for_each(tell);
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
        let mut watch = Watch::new(&self.files, &self.output);
        while !watch.look(self.until)? {
            if !wait(every, &stop) {
                return Ok(None);
            }
        }
        Ok(watch.into_join())
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

/// Waits; `false` if it was interrupted.
fn wait(time: Duration, stop: &AtomicBool) -> bool {
    let start = Instant::now();
    while start.elapsed() < time && !stop.load(Ordering::Relaxed) {
        sleep(TICK.min(time));
    }
    !stop.load(Ordering::Relaxed)
}
