//! Opens the file of a render, to continue it.
use std::{
    fs::File,
    io::BufReader,
    path::{Path, PathBuf},
    time::Duration,
};

use super::film_sections;
use crate::{
    render::{
        film::Film,
        pass::{PassCount, SampleId},
    },
    render_file::{Counters, Header, Kind, Reader, RenderFileError},
};
use noisefall_base::{declare::check, file::open_regular, memory::Reservation, quote};

/// Extension of render files.
pub const EXTENSION: &str = "nf";

/// Whether a path has the extension of render files.
pub fn is_checkpoint_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Error of opening a file.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}", quote::path(path))]
pub struct UnreadableFile {
    path: PathBuf,
    error: RenderFileError,
}

/// A file whose header is read.
pub struct CheckpointFile {
    path: PathBuf,
    reader: Reader<BufReader<File>>,
}

/// The state of a render, to continue from.
pub struct Checkpoint {
    state: CheckpointState,
    _memory: Reservation,
}

/// Film and figures of a render.
pub(in crate::render) struct CheckpointState {
    pub film: Film,
    pub count: PassCount,
    pub elapsed: Duration,
    /// Whether it has samples of several scenes or programs.
    pub is_mixed: bool,
}

impl Checkpoint {
    /// Render time so far.
    pub fn elapsed(&self) -> Duration {
        self.state.elapsed
    }

    /// Marks the render as one that continues with another scene or program.
    pub fn mixed(self) -> Checkpoint {
        Checkpoint { state: CheckpointState { is_mixed: true, ..self.state }, ..self }
    }

    /// The state. Its memory is no longer reserved.
    pub(in crate::render) fn into_state(self) -> CheckpointState {
        self.state
    }
}

impl CheckpointFile {
    /// Opens a file, and checks that its header can be used.
    pub fn open(path: &Path) -> Result<CheckpointFile, UnreadableFile> {
        let unreadable = |error| UnreadableFile { path: path.to_owned(), error };
        let file = open_regular(path).map_err(|error| unreadable(error.into()))?;
        let reader = Reader::new(BufReader::new(file)).map_err(unreadable)?;
        check_header(reader.header()).map_err(unreadable)?;
        Ok(CheckpointFile { path: path.to_owned(), reader })
    }

    /// Returns the file's metadata about its image.
    pub fn header(&self) -> &Header {
        self.reader.header()
    }

    /// Reads the state of the render.
    pub fn read(mut self) -> Result<Checkpoint, UnreadableFile> {
        let path = self.path.clone();
        self.read_state().map_err(|error| UnreadableFile { path, error })
    }

    fn read_state(&mut self) -> Result<Checkpoint, RenderFileError> {
        let Header { camera, counters, remarks, .. } = self.reader.header();
        let (counters, resolution, is_mixed) = (*counters, camera.resolution, !remarks.is_empty());
        // The worker reserves the memory of its films itself; until then it is this.
        let memory = Film::reserve_kept(resolution)?;
        let film = film_sections::read(&mut self.reader, resolution)?;
        let (count, elapsed) = figures(&counters)?;
        Ok(Checkpoint { state: CheckpointState { film, count, elapsed, is_mixed }, _memory: memory })
    }
}

/// The figures of a render as its file has them.
pub fn counters(count: &PassCount, elapsed: Duration) -> Counters {
    let &PassCount { rays, cut_paths, invalid, .. } = count;
    let first_invalid = invalid.map(|SampleId { pixel: [x, y], sample }| [x, y, sample]);
    Counters { seconds: elapsed.as_secs_f64(), rays, cut_paths, first_invalid }
}

/// The inverse.
fn figures(&Counters { seconds, rays, cut_paths, first_invalid }: &Counters) -> Result<(PassCount, Duration), RenderFileError> {
    let invalid = first_invalid.map(|[x, y, sample]| SampleId { pixel: [x, y], sample });
    let elapsed = Duration::try_from_secs_f64(seconds).map_err(|_| RenderFileError::contents("its time is out of range"))?;
    Ok((PassCount { rays, cut_paths, invalid, failure: None }, elapsed))
}

fn check_header(header: &Header) -> Result<(), RenderFileError> {
    if header.kind != Kind::Progress {
        return Err(RenderFileError::contents("it holds samples to be joined, not a render to be continued"));
    }
    let camera = header.camera.check();
    camera.map_err(|error| RenderFileError::contents(format!("its camera cannot be used: {error}")))?;
    match check(&mut header.settings.clone()).into_iter().next() {
        Some(problem) => Err(RenderFileError::contents(format!("a setting cannot be used: {}", problem.message))),
        None => Ok(()),
    }
}
